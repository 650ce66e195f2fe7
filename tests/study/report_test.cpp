// The report of runs that were made by hand, so that every number in it is known.
#include "acus/study/report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <set>
#include <sstream>

#include "acus/study/runner.h"
#include "study_files.h"

namespace acus::study {
namespace {

namespace fs = std::filesystem;

const char* const trace_head =
    "time_s,hand_travel_m,hand_force_N,energy_force_N,tip_force_N,tip_depth_m,inserted_length_m,free_length_"
    "m,"
    "critical_load_N,deflection_m,stage,work_hand_J,energy_tissue_J,energy_needle_J,energy_kinetic_J,"
    "work_cutting_J,work_friction_J,work_damping_J,work_numerical_J,energy_residual_J,solver_iterations,"
    "energy_contact_J,work_snap_J,work_relaxation_J,tip_aside_m,shaft_force_N,hub_force_x_N,hub_force_y_N,"
    "hub_force_z_N,"
    "hub_moment_x_Nm,hub_moment_y_Nm,hub_moment_z_Nm\n";

// A row of a trace at a time, travel and force; of the work of the hand a quarter each went into tissue and
// needle and a half into cutting; the tip is a metre deep for each joule.
std::string trace_row(const std::string& time_travel_force, double work) {
  std::ostringstream row;
  row << time_travel_force << ",0,0," << work << ",0,0.2,0.3,0,contact," << work << ',' << work / 4 << ','
      << work / 4 << ",0," << work / 2 << ",0,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0\n";
  return row.str();
}

struct HandMade {
  std::string trace =
      trace_head + trace_row("0,0,0", 0.0) + trace_row("1,0.01,0.2", 0.004) + trace_row("2,0.02,0.5", 0.008);
  std::string events =
      "time_s,event,hand_travel_m,hand_force_N,free_length_m\n"
      "0.1,contact,0.001,0.02,0.2\n1.2,buckling,0.012,0.26,0.2\n1.8,puncture,0.018,0.44,0.19\n";
  std::string summary = R"({"outcome": "buckled_then_punctured", "completed": true, "health": "good",
    "steps": 2000, "simulated_time_s": 2.5, "peak_hand_force_N": 0.5, "peak_tip_force_N": 0.45, "peak_deflection_m": 0.0125,
    "peak_tip_depth_m": 0.003, "peak_tip_aside_m": 0.002, "peak_energy_force_gap_N": 0.01,
    "bucklings": [{"event": "buckling", "predicted_load_N": 0.3125}],
    "energy": {"work_hand_J": 0.008, "relative_residual": 0.00025},
    "mesh": {"nodes": 5, "tetrahedra": 1234}, "state_hash": "00ff00ff00ff00ff",
    "versions": {"acus": "9.9", "compiler": "hand", "build_type": "none", "eigen": "3"}})";
  std::string snapshots = "[]";
};

const HandMade whole;

HandMade broken_off() {
  HandMade run = whole;
  run.trace = trace_head + trace_row("0,0,0", 0.0) + trace_row("1,nan,inf", 0.0);
  run.summary = R"({"outcome": "never_punctured", "completed": false, "health": "not_finite", "steps": 1,
    "peak_hand_force_N": null, "energy": {"work_hand_J": null, "relative_residual": null}, "mesh": null,
    "bucklings": null, "state_hash": null, "versions": "?"})";
  return run;
}

// The records of a study of as many runs as there are folders, named a, b, ...
struct Read {
  Study study;
  std::vector<GroupRecords> groups;
};
Result<Read> read_hand_made(const std::vector<HandMade>& made, const std::string& more = {}) {
  const fs::path folder = fresh_folder();
  std::string text = "name = \"made\"\n[scene.needle]\nsupport = \"pinned_pinned\"\n";
  for (std::size_t i = 0; i < made.size(); ++i)
    text += std::string("[[run]]\nname = \"") + static_cast<char>('a' + i) + "\"\nneedle.length_mm = 200\n";
  Result<Study> study = read_study(write_text(folder / "made.toml", text + more), {});
  if (!study) return study.error();
  Read read{*study, {}};
  read.groups.push_back({&read.study.groups[0], {}});
  for (std::size_t i = 0; i < made.size(); ++i) {
    const auto& run = study->groups[0].runs[i];
    const fs::path at = run_folder((folder / "out").string(), study->groups[0], run);
    fs::create_directories(at);
    write_text(at / "trace.csv", made[i].trace);
    write_text(at / "events.csv", made[i].events);
    write_text(at / "summary.json", made[i].summary);
    write_text(at / "snapshots.json", made[i].snapshots);
    Result<RunRecord> record = read_run(at.string(), run);
    if (!record) return record.error();
    read.groups[0].runs.push_back(std::move(*record));
  }
  return read;
}

// The rows of all tables of a report: "cell|cell|cell".
std::set<std::string> table_rows(const Report& report) {
  std::set<std::string> rows;
  std::istringstream lines(report.html);
  for (std::string line, row; std::getline(lines, line); row.clear()) {
    const auto begin = line.find("<tr>"), end = line.find("</tr>");
    if (begin == std::string::npos || end == std::string::npos) continue;
    bool in_tag = false;
    for (std::size_t i = begin; i < end; ++i) {
      if (line.compare(i, 3, "</t") == 0) row += '|';
      if (line[i] == '<') in_tag = true;
      if (!in_tag) row += line[i];
      if (line[i] == '>') in_tag = false;
    }
    row.resize(row.empty() ? 0 : row.size() - 1);
    rows.insert(row);
  }
  return rows;
}

Report report_of(const Result<Read>& read) {
  std::vector<GroupRecords> groups = read->groups;
  groups[0].group = &read->study.groups[0];
  return build_report(read->study, groups);
}

const char* const everything = "[report]\nshow = [\"force\", \"loads\", \"energy\", \"felt\"]\n";

// Forces between rows lie on straight lines; the closed form is pi^2 E I / L^2 with Table I's 200 GPa, 0.3
// mm.
TEST(Report, its_numbers_are_those_of_the_files) {
  const Result<Read> read = read_hand_made({whole}, everything);
  ASSERT_TRUE(read) << read.error().sentence;
  const std::set<std::string> rows = table_rows(report_of(read));
  for (const char* row :
       {"0|0", "5|0.1", "10|0.2", "15|0.35", "20|0.5",                   // force against travel
        "a|contact|1|0.02|200|0.3139", "a|buckling|12|0.26|200|0.3139",  // events
        "a|puncture|18|0.44|190|0.3479",
        "a|buckled-then-punctured|0.3139|0.26|-17.2 %|0.44||||",  // closed form against simulated
        // felt: 4 mm/s for the 0.2 s of a reaction
        "a|buckled-then-punctured|1.2|0.26|1.8|0.44|0.8|0.5|2.5",
        "a|8|2|2|0|0|4|0|0|0|0|0|0.025 %|2 %",  // the ledger
        "made / a|buckled-then-punctured|good|0.5|1234|2000|00ff00ff00ff00ff"})
    EXPECT_TRUE(rows.count(row)) << row;
  EXPECT_NE(report_of(read).html.find("Made by acus 9.9, hand, none, Eigen 3."), std::string::npos);
}

TEST(Report, the_table_of_results_is_that_of_the_files) {
  const Result<Read> read = read_hand_made({whole, broken_off()});
  ASSERT_TRUE(read) << read.error().sentence;
  std::vector<GroupRecords> groups = read->groups;
  groups[0].group = &read->study.groups[0];
  EXPECT_EQ(
      results_csv(groups),
      "study,run,needle.length_mm,outcome,health,buckling_load_N,buckling_predicted_N,buckling_travel_m,"
      "puncture_force_N,puncture_travel_m,second_buckling_load_N,second_buckling_predicted_N,"
      "second_buckling_free_length_m,peak_hand_force_N,peak_tip_force_N,peak_deflection_m,peak_tip_depth_m,"
      "peak_tip_aside_m,work_hand_J,relative_energy_residual,peak_energy_force_gap_N,tetrahedra,simulated_"
      "time_s,steps,state_"
      "hash\n"
      "made,a,200,buckled_then_punctured,good,0.26,0.3125,0.012,0.44,0.018,,,,0.5,0.45,0.0125,0.003,0.002,0."
      "008,"
      "0.00025,0.01,1234,2.5,2000,00ff00ff00ff00ff\n"
      "made,b,200,never_punctured,not_finite,0.26,,0.012,0.44,0.018,,,,,,,,,,,,,,1,\n");
}

TEST(Report, a_run_that_ended_early_is_named_and_left_out_of_the_pictures) {
  const Result<Read> read = read_hand_made({whole, broken_off()}, everything),
                     alone = read_hand_made({broken_off()}, everything);
  ASSERT_TRUE(read) << read.error().sentence;
  const Report report = report_of(read);
  EXPECT_NE(report.html.find("Left out here, because they ended early: b (not-finite)."), std::string::npos);
  EXPECT_NE(report.html.find("1 run ended early"), std::string::npos);
  EXPECT_TRUE(table_rows(report).count("5|0.1"));
  EXPECT_TRUE(table_rows(report).count("made / b|ended early|not-finite|-|0|1|"));
  for (const PictureFile& picture : report.pictures)
    for (const char* none : {"nan ", "nan\"", "inf ", "inf\""})
      EXPECT_EQ(picture.svg.find(none), std::string::npos) << picture.name;
  ASSERT_TRUE(alone) << alone.error().sentence;
  EXPECT_TRUE(report_of(alone).pictures.empty());
}

// Out at 3 s: a travel of 5 mm comes twice, a time once.
TEST(Report, forces_of_a_hand_that_goes_back_are_told_against_time) {
  HandMade back = whole;
  back.trace += trace_row("4,0,-0.1", 0.006);
  const Result<Read> read = read_hand_made(
      {whole, back}, "[report]\nshow = [\"force\", \"energy\", \"convergence\", \"coupling\"]\n");
  ASSERT_TRUE(read) << read.error().sentence;
  const std::set<std::string> rows = table_rows(report_of(read));
  for (const char* row : {"time, s|a|b", "0.5|0.1|0.1", "2|0.5|0.5", "3|-|0.2", "4|-|-0.1",
                          "1234|0.26|0 %|0 %"})  // on the way in both are the same
    EXPECT_TRUE(rows.count(row)) << row;
}

TEST(Report, a_bare_column_that_is_let_go_again_is_measured_on_its_way_in) {
  HandMade back = whole;
  back.trace += trace_row("4,0,-0.1", 0.006);
  const std::string wish = "[report]\nshow = [\"column\"]\n";
  const Result<Read> in = read_hand_made({whole}, wish), out = read_hand_made({back}, wish);
  ASSERT_TRUE(in && out);
  EXPECT_EQ(table_rows(report_of(in)), table_rows(report_of(out)));
  EXPECT_GT(table_rows(report_of(in)).size(), 5u);  // the elastica up to 10 % of end shortening
}

TEST(Report, the_rows_of_the_traces_are_as_far_apart_as_the_scenes_say) {
  const Result<Read> read = read_hand_made({whole}, "[scene.run]\ntime_step_ms = 0.5\ntrace_stride = 5\n");
  ASSERT_TRUE(read) << read.error().sentence;
  EXPECT_NE(report_of(read).html.find("(one row every 2.5 ms)"), std::string::npos);
}

TEST(Report, a_map_of_words_is_refused_with_a_note) {
  const Result<Read> read =
      read_hand_made({whole}, "[axes]\nneedle.support = [\"pinned_pinned\"]\n[report]\nshow = [\"map\"]\n");
  ASSERT_TRUE(read) << read.error().sentence;
  EXPECT_NE(report_of(read).html.find("needle.support is not one"), std::string::npos);
  EXPECT_TRUE(report_of(read).pictures.empty());
}

// One cell of 1 N by 1 mm about 200 mm and 0.7 N, so from 0.2 to 1.2 N; pinned-pinned, the needle's critical
// load is 0.3139 N. It had done 4 mJ in the last row before its puncture.
TEST(Report, a_map_has_the_closed_forms_borders_over_its_cells) {
  const char* const axes =
      "[axes]\nneedle.length_mm = [200]\ncontact.rupture_force_N = [%]\n[report]\nshow = [\"map\"]\n";
  const auto report_at = [&](const std::string& rupture) {
    std::string more = axes;
    const Result<Read> read = read_hand_made({whole}, more.replace(more.find('%'), 1, rupture));
    EXPECT_TRUE(read) << read.error().sentence;
    return report_of(read);
  };
  const Report report = report_at("0.7");
  ASSERT_EQ(report.pictures.size(), 1u);
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(report.pictures[0].svg.c_str()));
  const auto cell = xml.select_node("//rect[contains(@class,'cell f1')]").node(),
             border = xml.select_node("//path[contains(@class,'solid')]").node();
  const double height = cell.attribute("height").as_double(),
               bottom = cell.attribute("y").as_double() + height;
  double x = 0.0, y = 0.0;
  ASSERT_TRUE(std::istringstream(border.attribute("d").value() + 1) >> x >> y);
  EXPECT_NEAR((bottom - y) / height, 0.3139 * (200.0 * 200.0) / (199.5 * 199.5) - 0.2, 5e-3);
  EXPECT_TRUE(xml.select_node("//text[text()='4']"));
  EXPECT_TRUE(xml.select_node("//text[text()='needle length, mm']"));
  // At 0.7 N a needle that carries 0.3139 N, and half as much again when bowed, never goes in.
  EXPECT_NE(report.html.find("0 of 1 insertions came out as the closed forms say"), std::string::npos);
  EXPECT_NE(report_at("0.32").html.find("1 of 1 insertions came out as the closed forms say"),
            std::string::npos);
}

TEST(Report, pictures_stay_in_their_folder_whatever_the_panels_are_called) {
  const Result<Read> read = read_hand_made({whole}, R"([axes]
tissue.mesh = ["../../up.msh"]
[report]
show = ["force"]
panel = "tissue.mesh"
)");
  ASSERT_TRUE(read) << read.error().sentence;
  ASSERT_EQ(report_of(read).pictures.size(), 1u);
  EXPECT_EQ(report_of(read).pictures[0].name.find('/'), std::string::npos);
}

TEST(Report, the_limits_name_the_element_that_the_runs_had) {
  const auto said = [](const char* scene) {
    const Result<Read> read = read_hand_made({whole}, scene);
    Study study = read->study;
    study.contradictions = true;
    std::vector<GroupRecords> groups = read->groups;
    groups[0].group = &study.groups[0];
    return build_report(study, groups).html;
  };
  const std::string linear = said("[scene.tissue]\nelement = \"linear\"\n"),
                    other = said("[scene.tissue]\nelement = \"nodal_pressure\"\n");
  EXPECT_NE(linear.find("These studies use the paper's linear tetrahedron"), std::string::npos);
  EXPECT_EQ(other.find("linear tetrahedron"), std::string::npos);
  EXPECT_NE(other.find("at most 1.14 times its critical load"), std::string::npos);
}

struct Damage {
  const char* name;
  std::string HandMade::*file;
  std::string text;
};
class DamagedRun : public ::testing::TestWithParam<Damage> {};

TEST_P(DamagedRun, is_refused_with_the_advice_to_run_it_again) {
  HandMade run = whole;
  run.*GetParam().file = GetParam().text;
  const Result<Read> read = read_hand_made({run});
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().sentence.find("run the study again without --resume"), std::string::npos)
      << read.error().sentence;
}

std::string snapshot(const std::string& moment, const std::string& polygons, const std::string& displacement,
                     const std::string& needle) {
  return R"([{"moment": )" + moment +
         R"(, "hand_travel_m": 0, "hand_force_N": 0, "deflection_m": 0, "tip_depth_m": 0,
    "needle_radius_m": 0.0003, "outline_um": [], "polygons_um": )" +
         polygons + R"(, "displacement_um": )" + displacement + R"(, "needle_um": )" + needle + "}]";
}
const char* const triangle = "[[0, 0, 5, 0, 0, 5]]";
const char* const straight = "[0, 9, 0, 0]";

INSTANTIATE_TEST_SUITE_P(
    Report, DamagedRun,
    ::testing::Values(
        Damage{"a_word_for_a_number", &HandMade::trace, trace_head + trace_row("0,0,high", 0.0)},
        Damage{"half_a_number", &HandMade::trace, trace_head + trace_row("0,0,1.5x", 0.0)},
        Damage{"an_empty_cell", &HandMade::trace, trace_head + trace_row("0,0,", 0.0)},
        Damage{"a_short_row", &HandMade::trace, std::string(trace_head) + "0,0,0\n"},
        Damage{"a_column_too_few", &HandMade::trace, "time_s,hand_travel_m\n0,0\n"},
        Damage{"no_rows", &HandMade::trace, trace_head}, Damage{"an_empty_trace", &HandMade::trace, ""},
        Damage{"a_word_in_an_event", &HandMade::events,
               "time_s,event,hand_travel_m,hand_force_N,free_length_m\n0,contact,0,soft,0\n"},
        Damage{"a_summary_that_is_a_list", &HandMade::summary, "[1]"},
        Damage{"a_summary_cut_off", &HandMade::summary, "{\"outcome\": \"ne"},
        Damage{"snapshots_that_are_no_list", &HandMade::snapshots, "{\"moment\": 1}"},
        Damage{"a_snapshot_that_is_a_number", &HandMade::snapshots, "[7]"},
        Damage{"an_unknown_moment", &HandMade::snapshots, snapshot("9", triangle, "[0]", straight)},
        Damage{"a_displacement_too_few", &HandMade::snapshots, snapshot("1", triangle, "[]", straight)},
        Damage{"a_polygon_of_two", &HandMade::snapshots, snapshot("1", "[[0, 0, 5, 0]]", "[0]", straight)},
        Damage{"a_polygon_of_five", &HandMade::snapshots,
               snapshot("1", "[[0, 0, 5, 0, 5, 5, 2, 7, 0, 5]]", "[0]", straight)},
        Damage{"no_needle", &HandMade::snapshots, snapshot("1", triangle, "[0]", "[]")},
        Damage{"a_null_among_coordinates", &HandMade::snapshots,
               snapshot("1", triangle, "[0]", "[0, null, 0, 0]")}),
    [](const auto& one) { return one.param.name; });

TEST(Report, an_undamaged_snapshot_is_read) {
  HandMade run = whole;
  run.snapshots = snapshot("1", triangle, "[0]", straight);
  const Result<Read> read = read_hand_made({run});
  ASSERT_TRUE(read) << read.error().sentence;
  EXPECT_EQ(read->groups[0].runs[0].snapshots.size(), 1u);
}

TEST(Report, a_snapshot_that_is_not_finite_is_not_kept) {
  Snapshot good;
  good.needle = {{0.0, 0.1}, {0.0, 0.0}};
  Snapshot bad = good;
  bad.needle[1][0] = std::nan("");
  EXPECT_EQ(to_json(std::vector<Snapshot>{good, bad}).size(), 1u);
}

}  // namespace
}  // namespace acus::study
