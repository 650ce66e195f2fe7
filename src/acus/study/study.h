// Study: a table of insertions as a person wrote it down, every scene built and checked.
//
//   name = "fig7a"                         # folder of its runs
//   title = "..."  text = "..."            # what the report says of it
//   base = "scene.toml"                    # a scene file beside the study, and/or
//   [scene]                                # keys of a scene laid over it; tissue.mesh is beside the study
//   [[run]]                                # named runs: name = "..." and keys of a scene
//   [axes]                                 # key = [values]: all combinations, the first axis varies slowest
//   [sample]                               # instead of axes: count, seed and [sample.range] key = [low,
//   high] [report]                               # show = [...], panel = key, curve = key
//   until = "puncture"                     # a run ends with its first event of that kind
// or, instead of runs of its own, include = ["fig6.toml", ...]: several studies in one report, and
// contradictions = true: where the paper contradicts itself, at its end.
#pragma once

#include <string>
#include <vector>

#include "acus/base/result.h"
#include "acus/sim/scene.h"
#include "acus/study/expansion.h"

namespace acus::study {

// What a report can show of a group of runs.
enum class Exhibit {
  force,
  energy,
  stages,
  mesh,
  loads,
  column,
  shapes,
  coupling,
  convergence,
  exactness,
  felt,
  map,
  depth,
  track
};

struct ReportWish {
  std::vector<Exhibit> show{Exhibit::force, Exhibit::energy, Exhibit::loads};
  std::string panel;  // scene key: one plot for each of its values; empty for one plot
  std::string curve;  // scene key that names the curves; empty for the names of the runs
};

struct Run {
  Case chosen;
  Scene scene;
  std::string until;  // the event that ends it; empty for the end of the hand's movement
};

struct Group {
  std::string name, title, text;
  std::vector<std::string> varied;  // scene keys that differ between runs, in order
  std::vector<Run> runs;
  ReportWish report;
};

struct Study {
  std::string name, title, text;
  std::vector<Group> groups;
  bool contradictions = false;  // end the report with what the paper contradicts itself in
};

// `settings` ("tissue.tetrahedra=1000") change the base scene of every group; runs, axes and samples go
// before them, and a setting that no run would feel is refused. Errors are one sentence: file:line:column,
// the key, what is wrong and what would be right.
Result<Study> read_study(const std::string& path, const std::vector<std::string>& settings);

// The value of `key` in `choices` as TOML text, quotes taken off; empty when it is not among them.
std::string chosen_value(const Case& chosen, const std::string& key);

inline constexpr int most_runs = 100000;  // more is a slip of the hand

}  // namespace acus::study
