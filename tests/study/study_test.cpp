#include "acus/study/study.h"

#include <gtest/gtest.h>

#include "study_files.h"

namespace acus::study {
namespace {

Result<Study> read_text_as_study(const std::string& text) {
  return read_study(write_text(fresh_folder() / "study.toml", text), {});
}

TEST(StudyFile, axes_times_named_runs_give_every_scene) {
  const Result<Study> study = read_text_as_study(R"(
name = "lengths"
[scene.tissue]
rigid = true
[[run]]
name = "thin"
needle.radius_mm = 0.25
[[run]]
name = "thick"
needle.radius_mm = 0.4
[axes]
needle.support = ["pinned_pinned", "clamped_free"]
needle.length_mm = [150, 200.5]
)");
  ASSERT_TRUE(study) << study.error().sentence;
  ASSERT_EQ(study->groups.size(), 1u);
  const auto& runs = study->groups[0].runs;
  ASSERT_EQ(runs.size(), 8u);
  EXPECT_EQ(runs[0].chosen.name, "thin-pinned_pinned-length_mm_150");
  EXPECT_EQ(runs[7].chosen.name, "thick-clamped_free-length_mm_200.5");
  EXPECT_EQ(runs[7].scene.needle.length, 0.2005);
  EXPECT_EQ(runs[7].scene.needle.radius, 0.4e-3);
  EXPECT_EQ(runs[7].scene.needle.support, needle::Support::clamped_free);
  EXPECT_TRUE(runs[7].scene.tissue.rigid);
}

// The axes stand in the order of the file, although needle.support comes after needle.length_mm in the
// alphabet.
TEST(StudyFile, a_setting_changes_the_base_scene_and_leaves_the_axes) {
  const std::string path = write_text(fresh_folder() / "s.toml", "[axes]\nneedle.length_mm = [150, 200]\n");
  const Result<Study> study = read_study(path, {"needle.radius_mm=0.5"});
  ASSERT_TRUE(study) << study.error().sentence;
  EXPECT_EQ(study->groups[0].runs[1].scene.needle.radius, 0.5e-3);
  EXPECT_EQ(study->groups[0].runs[1].scene.needle.length, 0.2);
}

TEST(StudyFile, a_setting_that_no_run_would_feel_is_refused) {
  const auto folder = fresh_folder();
  const std::string varied = write_text(folder / "varied.toml", "[axes]\nneedle.length_mm = [150, 200]\n");
  const Result<Study> refused = read_study(varied, {"needle.length_mm=100"});
  ASSERT_FALSE(refused);
  EXPECT_EQ(
      refused.error().sentence,
      "--set needle.length_mm=100: every run of this study has its own needle.length_mm; change it in " +
          varied);
  // Where one group of several feels it, it is meant for that one.
  write_text(folder / "fixed.toml", "[axes]\nneedle.radius_mm = [0.3, 0.4]\n");
  const std::string both = write_text(folder / "both.toml", "include = [\"varied.toml\", \"fixed.toml\"]\n");
  EXPECT_TRUE(read_study(both, {"needle.length_mm=100"}));
}

TEST(StudyFile, a_base_scene_and_included_studies_are_found_beside_the_file) {
  const auto folder = fresh_folder();
  write_text(folder / "needle.toml", "[needle]\nlength_mm = 170\n");
  write_text(folder / "one.toml", "base = \"needle.toml\"\n[axes]\nneedle.radius_mm = [0.2, 0.3]\n");
  write_text(folder / "two.toml",
             "[sample]\ncount = 3\nseed = 5\n[sample.range]\nneedle.radius_mm = [0.2, 0.3]\n");
  const std::string all =
      write_text(folder / "all.toml", "include = [\"one.toml\", \"two.toml\"]\ncontradictions = true\n");
  const Result<Study> study = read_study(all, {});
  ASSERT_TRUE(study) << study.error().sentence;
  ASSERT_EQ(study->groups.size(), 2u);
  EXPECT_EQ(study->groups[0].name, "one");
  EXPECT_EQ(study->groups[0].runs[1].scene.needle.length, 0.17);
  EXPECT_EQ(study->groups[1].runs.size(), 3u);
}

struct Wrong {
  const char* text;
  const char* said;  // what the sentence must hold
};

class WrongStudy : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongStudy, is_refused_in_one_sentence_that_names_the_place) {
  const auto folder = fresh_folder();
  const Result<Study> study = read_study(write_text(folder / "study.toml", GetParam().text), {});
  ASSERT_FALSE(study);
  const std::string& sentence = study.error().sentence;
  EXPECT_NE(sentence.find(GetParam().said), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("study.toml"), std::string::npos) << sentence;
  EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
}

INSTANTIATE_TEST_SUITE_P(
    StudyFile, WrongStudy,
    ::testing::Values(
        Wrong{"name = ", "study.toml:1"}, Wrong{"[?", "is not TOML"},
        Wrong{"axis = 3\n", "did you mean axes"}, Wrong{"[axes]\nneedle.length_mm = 200\n", "study.toml:2"},
        Wrong{"[axes]\nneedle.length_mm = []\n", "at least one value"},
        Wrong{"[axes]\nneedle.lenght_mm = [200]\n", "did you mean needle.length_mm"},
        Wrong{"[axes]\nneedle.length_mm = [200, -5]\n", "study.toml:2:26: needle.length_mm must be"},
        Wrong{"[axes]\nneedle.length_mm = [200, 200]\n", "two runs are named"},
        Wrong{"axes = 4\n", "axes must be a table"},
        Wrong{"[axes]\nneedle.support = [\"pinned\"]\n", "needle.support must be one of"},
        Wrong{"[scene.needle]\nradius_mm = \"thin\"\n", "study.toml:2:13: needle.radius_mm must be a number"},
        Wrong{"scene = 1\n", "scene must be a table"}, Wrong{"base = \"missing.toml\"\n", "missing.toml"},
        Wrong{"base = 3\n", "base must be text"}, Wrong{"[[run]]\nneedle.radius_mm = 0.3\n", "needs a name"},
        Wrong{"[[run]]\nname = \"../up\"\n", "letters, digits"}, Wrong{"[run]\nname = \"a\"\n", "[[run]]"},
        Wrong{"[sample]\ncount = 0\nseed = 1\n[sample.range]\nneedle.radius_mm = [0.2, 0.3]\n",
              "sample.count must be"},
        Wrong{"[sample]\ncount = 3\n[sample.range]\nneedle.radius_mm = [0.2, 0.3]\n", "sample.seed must be"},
        Wrong{"[sample]\ncount = 3\nseed = 1\n", "sample.range must name"},
        Wrong{"[sample]\ncount = 3\nseed = 1\n[sample.range]\nneedle.radius_mm = [0.3, 0.2]\n",
              "low below high"},
        Wrong{"[sample]\ncount = 1\nseed = 1\n[sample.range]\nneedle.radius_mm = [1, "
              "2]\n[axes]\nneedle.length_mm = [1]\n",
              "not both"},
        Wrong{"[report]\nshow = [\"forces\"]\n", "it knows force"},
        Wrong{"until = \"pucture\"\n", "until does not know the event \"pucture\"; it knows contact"},
        Wrong{"[report]\npanel = \"needle.support\"\n", "does not vary"},
        Wrong{"include = [\"study.toml\"]\n", "too deeply, or in a circle"},
        Wrong{"include = []\n", "at least one"},
        Wrong{"include = [\"other.toml\"]\n[axes]\nneedle.length_mm = [100]\n", "has no axes of its own"},
        Wrong{"name = \"a/b\"\n", "letters, digits"}, Wrong{"name = \"\"\n", "at least one"},
        Wrong{"[scene.hand]\nkind = \"path\"\n", "hand.path must hold at least two points"},
        Wrong{"name = \"../up\"\ninclude = [\"other.toml\"]\n", "letters, digits"},
        Wrong{"name = \"figures\"\n", "is what a part of the report is called"},
        Wrong{"name = \"results.csv\"\n", "is what a part of the report is called"},
        Wrong{"[[run]]\nname = \"a\"\n[[run]]\nname = \"b\"\n[sample]\ncount = 60000\nseed = 1\n"
              "[sample.range]\nneedle.radius_mm = [0.2, 0.3]\n",
              "more than 100000 runs"},
        Wrong{"[scene.hand]\nspeed_mm_s = 0.001\n[[run]]\nname = \"slow\"\n",
              "run slow: run.trace_stride must be at least"}));

TEST(StudyFile, the_advised_trace_stride_is_accepted) {
  const std::string text = "[scene.hand]\nspeed_mm_s = 0.001\n[scene.run]\ntrace_stride = ";
  const Result<Study> refused = read_text_as_study(text + "1\n");
  ASSERT_FALSE(refused);
  const std::string& sentence = refused.error().sentence;
  const std::string advised = sentence.substr(sentence.find("at least ") + 9);
  EXPECT_TRUE(read_text_as_study(text + advised.substr(0, advised.find(' ')) + "\n")) << sentence;
}

TEST(StudyFile, a_mesh_is_beside_the_study_and_one_of_a_setting_is_where_the_user_is) {
  const auto folder = fresh_folder();
  const std::string path =
      write_text(folder / "s.toml",
                 "[[run]]\nname = \"far\"\ntissue.mesh = \"far.msh\"\n[axes]\nneedle.length_mm = [150]\n");
  const std::string axis = write_text(
      folder / "a.toml", "[scene.tissue]\nmesh_unit_mm = 1.0\n[axes]\ntissue.mesh = [\"o'neil.msh\"]\n");
  const std::string base = write_text(folder / "b.toml", "[scene.tissue]\nmesh = \"near.msh\"\n");
  const auto mesh_of = [](const std::string& file, const std::vector<std::string>& settings) {
    const Result<Study> study = read_study(file, settings);
    EXPECT_TRUE(study) << study.error().sentence;
    return study->groups[0].runs[0].scene.tissue.mesh;
  };
  EXPECT_EQ(mesh_of(path, {}), (folder / "far.msh").string());
  EXPECT_EQ(mesh_of(axis, {}), (folder / "o'neil.msh").string());
  EXPECT_EQ(mesh_of(base, {}), (folder / "near.msh").string());
  EXPECT_EQ(mesh_of(base, {"tissue.mesh=mine.msh"}), "mine.msh");
}

TEST(StudyFile, words_with_quotes_and_new_lines_stay_what_they_are) {
  const auto folder = fresh_folder();
  const std::string file = write_text(folder / "s.toml", R"(
[axes]
tissue.mesh = ["o'neil.msh", "two\nlines \"quoted\" back\\slash.msh"]
)");
  const Result<Study> study = read_study(file, {});
  ASSERT_TRUE(study) << study.error().sentence;
  const auto& runs = study->groups[0].runs;
  EXPECT_EQ(chosen_value(runs[0].chosen, "tissue.mesh"), "o'neil.msh");
  EXPECT_EQ(chosen_value(runs[1].chosen, "tissue.mesh"), "two\nlines \"quoted\" back\\slash.msh");
  EXPECT_EQ(runs[1].scene.tissue.mesh, (folder / "two\nlines \"quoted\" back\\slash.msh").string());
}

TEST(StudyFile, names_of_runs_are_names_of_folders_however_long_their_values) {
  std::string path = "[[0, 0]";
  for (int i = 1; i <= 100; ++i) path += ", [" + std::to_string(i) + ", " + std::to_string(0.1 * i) + "]";
  const Result<Study> study =
      read_text_as_study("[scene.hand]\nkind = \"path\"\npath = [[0, 0], [1, 1]]\n[axes]\nhand.path = [" +
                         path + "], " + path + ", [101, 20.0]]]\n");
  ASSERT_TRUE(study) << study.error().sentence;
  const auto& runs = study->groups[0].runs;
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_NE(runs[0].chosen.name, runs[1].chosen.name);
  EXPECT_EQ(runs[1].scene.hand.path.size(), 102u);
  for (const auto& run : runs) EXPECT_LE(run.chosen.name.size(), 255u);
}

TEST(StudyFile, every_shipped_study_can_be_read) {
  int studies = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(ACUS_SOURCE_DIR) / "studies")) {
    const Result<Study> study = read_study(file.path().string(), {});
    EXPECT_TRUE(study) << study.error().sentence;
    ++studies;
  }
  EXPECT_GE(studies, 6);
}

}  // namespace
}  // namespace acus::study
