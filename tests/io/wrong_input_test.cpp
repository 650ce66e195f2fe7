// Bad input to the built program: one sentence that names the place, says what is wrong and what would be
// right.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "program.h"

namespace acus::io {
namespace {

struct Wrong {
  std::string name;
  std::string scene;                // text of scene.toml
  std::vector<std::string> place;   // where: file with line and column, or key
  std::vector<std::string> advice;  // what would be right
};

const std::vector<Wrong> wrong_scenes = {
    {"not_toml", "[needle\nlength_mm = 1", {"scene.toml:1:"}, {"is not TOML"}},
    {"bracket_question_mark", "[?", {"scene.toml:1:"}, {"is not TOML"}},
    {"value_left_out", "[needle]\nlength_mm =\n", {"scene.toml:2:"}, {"is not TOML"}},
    {"key_twice",
     "[needle]\nlength_mm = 1\nlength_mm = 2\n",
     {"scene.toml:3:"},
     {"is not TOML", "length_mm"}},
    {"table_twice", "[needle]\n[tissue]\n[needle]\n", {"scene.toml:3:"}, {"is not TOML", "needle"}},
    {"quote_left_open", "[needle]\nsupport = \"clamped\n", {"scene.toml:2:"}, {"is not TOML"}},
    {"bytes_not_utf8", "[needle]\nsupport = \"\xff\xfe\"", {"scene.toml:2:"}, {"is not TOML"}},
    {"letter_outside_quotes", "a \u00a1 = 1", {"scene.toml:1:"}, {"is not TOML"}},
    {"brackets_without_end", "a = " + std::string(5000, '['), {"scene.toml:1:"}, {"is not TOML"}},
    {"binary",
     std::string("\x7f"
                 "ELF\x00\x01\x02",
                 7),
     {"scene.toml:1:"},
     {"is not TOML"}},
    {"unknown_table",
     "[needel]\nlength_mm = 150",
     {"scene.toml:1:", "needel"},
     {"not a key", "did you mean needle?"}},
    {"misspelt_key",
     "[needle]\nlenght_mm = 150",
     {"scene.toml:2:", "needle.lenght_mm"},
     {"did you mean needle.length_mm?"}},
    {"unit_left_out",
     "[needle]\nlength = 150",
     {"scene.toml:2:", "needle.length"},
     {"did you mean needle.length_mm?"}},
    {"wrong_unit",
     "[tissue]\nyoungs_modulus_Pa = 25e3",
     {"scene.toml:2:"},
     {"did you mean tissue.youngs_modulus_kPa?"}},
    {"wrong_table",
     "[tissue]\nrupture_force_N = 1",
     {"scene.toml:2:"},
     {"did you mean contact.rupture_force_N?"}},
    {"nonsense_key", "[hand]\nqqqqqqqqqqqq = 1", {"scene.toml:2:"}, {"acus check --keys"}},
    {"key_below_a_key",
     "[needle.length_mm]\nx = 1",
     {"scene.toml:1:", "needle.length_mm"},
     {"must be a number"}},
    {"table_is_a_number", "needle = 3", {"scene.toml:1:"}, {"must be a table, as in [needle]"}},
    {"list_of_tables", "[[needle]]\nlength_mm = 150", {"scene.toml:1:", "needle"}, {"must be a table"}},
    {"text_for_a_number",
     "[needle]\nlength_mm = \"long\"",
     {"scene.toml:2:13", "needle.length_mm"},
     {"must be a number from 1 to 2000"}},
    {"switch_for_a_number",
     "[needle]\nradius_mm = true",
     {"needle.radius_mm"},
     {"must be a number", "is true"}},
    {"date_for_a_number", "[needle]\nradius_mm = 2020-01-01", {"needle.radius_mm"}, {"must be a number"}},
    {"number_for_a_word",
     "[contact]\ncrack = 1",
     {"scene.toml:2:9", "contact.crack"},
     {"\"ring\", \"slit\""}},
    {"number_for_a_switch", "[tissue]\nrigid = 1", {"tissue.rigid"}, {"true or false"}},
    {"number_for_a_file", "[tissue]\nmesh = 1", {"tissue.mesh"}, {"name of a file in quotes"}},
    {"length_negative", "[needle]\nlength_mm = -200", {"needle.length_mm"}, {"from 1 to 2000, but is -200"}},
    {"radius_zero", "[needle]\nradius_mm = 0", {"needle.radius_mm"}, {"from 0.01"}},
    {"radius_thick",
     "[needle]\nlength_mm = 50\nradius_mm = 5\n[hand]\ntravel_mm=1",
     {"scene.toml:3:", "needle.radius_mm"},
     {"1/20"}},
    {"bow_too_large", "[needle]\nimperfection_mm = 15", {"needle.imperfection_mm"}, {"at most 1/100"}},
    {"infinite",
     "[needle]\nyoungs_modulus_GPa = inf",
     {"needle.youngs_modulus_GPa"},
     {"from 0.001 to 1000, but is inf"}},
    {"not_a_number", "[tissue]\nyoungs_modulus_kPa = nan", {"tissue.youngs_modulus_kPa"}, {"but is nan"}},
    {"model_that_is_none",
     "[needle]\nmodel = \"beam\"",
     {"scene.toml:2:9", "needle.model"},
     {"one of \"column\", \"rod\"", "\"beam\""}},
    {"misspelt_choice",
     "[needle]\nsupport = \"clamped_pined\"",
     {"needle.support"},
     {"did you mean \"clamped_pinned\"?"}},
    {"unknown_choice",
     "[tissue]\nelement = \"quadratic\"",
     {"tissue.element"},
     {"\"linear\", \"nodal_pressure\""}},
    {"unknown_coupling",
     "[contact]\ncoupling = \"glue\"",
     {"contact.coupling"},
     {"\"embedded\", \"nearest_node\""}},
    {"incompressible",
     "[tissue]\npoisson_ratio = 0.5",
     {"scene.toml:2:17", "tissue.poisson_ratio"},
     {"from 0 to 0.4999"}},
    {"auxetic", "[tissue]\npoisson_ratio = -0.2", {"tissue.poisson_ratio"}, {"from 0 to 0.4999"}},
    {"tetrahedra_with_a_fraction", "[tissue]\ntetrahedra = 100.5", {"tissue.tetrahedra"}, {"whole number"}},
    {"tetrahedra_without_bound", "[tissue]\ntetrahedra = 9000000000", {"tissue.tetrahedra"}, {"to 2000000"}},
    {"integer_too_long_for_toml",
     "[tissue]\ntetrahedra = 99999999999999999999",
     {"scene.toml:2:"},
     {"is not TOML"}},
    {"size_of_two", "[tissue]\nsize_mm = [100, 100]", {"tissue.size_mm"}, {"a list of 3 numbers"}},
    {"size_of_words",
     "[tissue]\nsize_mm = [100, \"a\", 60]",
     {"tissue.size_mm"},
     {"a list of 3 numbers", "\"a\""}},
    {"size_flat", "[tissue]\nsize_mm = [100, 100, 0]", {"tissue.size_mm"}, {"from 1 to 5000"}},
    {"direction_nowhere", "[tissue]\ndirection = [0, 0, 0]", {"tissue.direction"}, {"[0, 0, -1]"}},
    {"mesh_absent", "[tissue]\nmesh = \"liver.msh\"", {"liver.msh"}, {"no such file"}},
    {"mesh_is_no_mesh", "[tissue]\nmesh = \"scene.toml\"", {"scene.toml"}, {"mesh"}},
    {"mesh_and_rigid",
     "[tissue]\nmesh = \"liver.msh\"\nrigid = true",
     {"scene.toml:2:", "tissue.mesh"},
     {"remove one of the two"}},
    {"disc_thinner_than_needle",
     "[contact]\ncontact_radius_mm = 0.1",
     {"contact.contact_radius_mm"},
     {"at least needle.radius_mm"}},
    {"disc_wider_than_block",
     "[contact]\ncontact_radius_mm = 50",
     {"contact.contact_radius_mm"},
     {"a quarter of the smallest side"}},
    {"friction_negative", "[contact]\nfriction_N_m = -1", {"contact.friction_N_m"}, {"from 0 to"}},
    {"speed_zero", "[hand]\nspeed_mm_s = 0", {"hand.speed_mm_s"}, {"from 0.001"}},
    {"travel_beyond_the_needle",
     "[hand]\ntravel_mm = 250",
     {"scene.toml:2:", "hand.travel_mm"},
     {"at most 197 mm", "reaches 250 mm"}},
    {"path_without_kind", "[hand]\npath = [[0, 0], [1, 5]]", {"hand.path"}, {"hand.kind = \"path\""}},
    {"kind_without_path", "[hand]\nkind = \"path\"", {"hand.path"}, {"at least two points"}},
    {"path_back_in_time",
     "[hand]\nkind = \"path\"\npath = [[0, 0], [2, 5], [1, 9]]",
     {"scene.toml:3:", "hand.path"},
     {"increasing times"}},
    {"path_of_triples",
     "[hand]\nkind = \"path\"\npath = [[0, 0, 0]]",
     {"hand.path"},
     {"[time in s, travel in mm]", "point 1"}},
    {"path_starts_late",
     "[hand]\nkind = \"path\"\npath = [[1, 0], [2, 5]]",
     {"hand.path"},
     {"begin at time 0"}},
    {"step_zero", "[run]\ntime_step_ms = 0", {"run.time_step_ms"}, {"from 0.01 to 20"}},
    {"step_too_long_for_the_speed",
     "[hand]\nspeed_mm_s = 1000\n[run]\ntime_step_ms = 10",
     {"scene.toml:4:", "run.time_step_ms"},
     {"at most contact.contact_radius_mm"}},
    {"tolerance_loose", "[run]\nsolver_tolerance = 1", {"run.solver_tolerance"}, {"to 0.01"}},
    {"stride_zero", "[run]\ntrace_stride = 0", {"run.trace_stride"}, {"from 1 to 1000000, but is 0"}},
};

void expect_one_sentence(const ProgramRun& run, const std::vector<std::string>& parts,
                         const std::string& name) {
  EXPECT_EQ(run.exit_code, 2) << name << ": " << run.err;
  EXPECT_EQ(run.out, "") << name;
  EXPECT_EQ(run.err.find("acus: "), 0U) << name << ": " << run.err;
  for (const std::string& part : parts)
    EXPECT_NE(run.err.find(part), std::string::npos) << name << ": no \"" << part << "\" in: " << run.err;
}

TEST(WrongInput, every_wrong_scene_is_refused_with_place_and_advice) {
  const std::string folder = fresh_folder("wrong_scenes");
  for (const Wrong& wrong : wrong_scenes) {
    std::ofstream(folder + "/scene.toml", std::ios::binary) << wrong.scene;
    const ProgramRun run = run_program({"run", "scene.toml", "--json"}, folder);
    std::vector<std::string> parts = wrong.place;
    parts.insert(parts.end(), wrong.advice.begin(), wrong.advice.end());
    expect_one_sentence(run, parts, wrong.name);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << wrong.name << ": " << run.err;
  }
  std::filesystem::remove_all(folder);
}

struct WrongWords {
  std::vector<std::string> words;
  std::vector<std::string> parts;
};

TEST(WrongInput, every_wrong_command_is_refused_with_advice) {
  const std::string folder = fresh_folder("wrong_words");
  std::ofstream(folder + "/ok.toml") << "[tissue]\nrigid = true\n";
  std::ofstream(folder + "/file") << "";
  const std::vector<WrongWords> all = {
      {{}, {"--help"}},
      {{"rnu", "ok.toml"}, {"rnu is not a verb", "did you mean `acus run`?"}},
      {{"run"}, {"SCENE", "--help"}},
      {{"run", "absent.toml"}, {"absent.toml", "no such file"}},
      {{"run", "."}, {"is a folder"}},
      {{"run", "/dev/zero"}, {"/dev/zero", "not a regular file"}},
      {{"run", "ok.toml", "--frobnicate"}, {"--frobnicate", "--help"}},
      {{"run", "ok.toml", "extra.toml"}, {"extra.toml", "--help"}},
      {{"run", "ok.toml", "--set"}, {"--set"}},
      {{"run", "ok.toml", "--set", "needle.length_mm"}, {"--set needle.length_mm", "key=value"}},
      {{"run", "ok.toml", "--set", "=3"}, {"key=value"}},
      {{"run", "ok.toml", "--set", "needle.lenght_mm=3"}, {"did you mean needle.length_mm?"}},
      {{"run", "ok.toml", "--set", "needle.length_mm=long"},
       {"--set needle.length_mm=long", "cannot be read as a value"}},
      {{"run", "ok.toml", "--set", "needle.length_mm=1\n[x]"}, {"cannot be read as a value"}},
      {{"run", "ok.toml", "--set", "needle.length_mm=-5"}, {"from 1 to 2000, but is -5"}},
      {{"run", "ok.toml", "--set", "needle.support=glued"}, {"needle.support", "pinned_pinned"}},
      {{"run", "ok.toml", "--set", "hand.travel_mm=199"}, {"--set hand.travel_mm=199", "at most 197 mm"}},
      {{"run", "ok.toml", "--vtu-every", "10"}, {"--vtu-every", "add --out DIR"}},
      {{"run", "ok.toml", "--out", "o", "--vtu-every", "0"}, {"--vtu-every"}},
      {{"run", "ok.toml", "--out", "o", "--vtu-every", "often"}, {"--vtu-every"}},
      {{"run", "ok.toml", "--threads", "0"}, {"--threads", "1 to 64"}},
      {{"bench", "--threads", "65"}, {"--threads", "1 to 64"}},
      {{"serve", "ok.toml", "--threads", "all"}, {"--threads", "1 to 64"}},
      {{"run", "ok.toml", "--out", "file"}, {"file: is a file", "name a folder"}},
      {{"run", "ok.toml", "--out", "file/below"}, {"file/below"}},
      {{"run", "ok.toml", "--out", "/proc/acus"}, {"/proc/acus"}},
      {{"check"}, {"check needs a scene file"}},
      {{"check", "absent.toml"}, {"no such file"}},
      {{"device"}, {"--help"}},
      {{"device", "check"}, {"NAME", "--help"}},
      {{"device", "check", "nothing"}, {"there is no device 'nothing'", "acus device list"}},
      {{"device", "check", "simulted"}, {"did you mean 'simulated'?"}},
      {{"device", "check", "simulated:phantom"}, {"no device 'phantom' to simulate", "touch"}},
      {{"device", "check", "openhaptics"}, {"libHD.so", "ACUS_LIBHD"}},
      {{"serve", "ok.toml", "--port", "70000"}, {"--port", "65535"}},
      {{"serve", "absent.toml"}, {"no such file"}},
      {{"serve", "ok.toml", "--device", "force_dimension"}, {"libdhd.so", "ACUS_LIBDHD"}},
      {{"serve", "ok.toml", "--force-limit", "-1"}, {"--force-limit"}},
      {{"serve", "ok.toml", "--force-limit", "nan"}, {"--force-limit", "nan is no number"}},
      {{"serve", "ok.toml", "--seconds", "-nan"}, {"--seconds", "-nan is no number"}},
      {{"serve", "ok.toml", "--device", "haply:x"}, {"'x' is no port"}},
      {{"serve", "ok.toml", "--device", "haply:1"}, {"port 1 cannot be reached", "start it"}},
      {{"serve", "ok.toml", "--device", "recorded"}, {"recorded:hand.acusrec"}},
      {{"serve", "ok.toml", "--device", "recorded:absent"}, {"absent", "no such file"}},
      {{"serve", "ok.toml", "--device", "simulated", "--record", "ok.toml"}, {"is no recording", "--record"}},
      {{"serve", "ok.toml", "--record", "new"}, {"--record needs a --device"}},
      {{"emulate"}, {"--help"}},
      {{"emulate", "haply", "--service", "2.0"}, {"--service", "3.5"}},
      {{"emulate", "haply", "--port", "70000"}, {"--port", "65535"}},
      {{"emulate", "haply", "--fault", "tired@1"}, {"'tired@1' is no fault", "unplugged"}},
  };
  for (const WrongWords& wrong : all) {
    std::string name = "acus";
    for (const std::string& word : wrong.words) name += " " + word;
    expect_one_sentence(run_program(wrong.words, folder), wrong.parts, name);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace acus::io
