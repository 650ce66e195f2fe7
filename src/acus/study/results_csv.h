// results.csv: one row a run, in the order of the study; SI, empty where a thing did not happen.
#pragma once

#include <string>
#include <vector>

#include "acus/study/run_record.h"
#include "acus/study/study.h"

namespace acus::study {

struct GroupRecords {
  const Group* group;
  std::vector<RunRecord> runs;
};

// The columns: study, run, every key that varies (as written in the study), outcome, health, buckling and
// puncture with the closed form's prediction beside them, peaks, energy, mesh and the hash of the final
// state.
std::string results_csv(const std::vector<GroupRecords>& groups);

}  // namespace acus::study
