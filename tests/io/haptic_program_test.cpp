// The verbs of haptics, run as a user runs them.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "program.h"

namespace acus::io {
namespace {

TEST(HapticProgram, lists_devices_with_what_is_missing_and_what_they_were_tested_with) {
  const std::string folder = fresh_folder("devices");
  const ProgramRun run = run_program({"device", "list"}, folder);
  EXPECT_EQ(run.exit_code, 0);
  for (const char* said : {"simulated", "recorded", "haply", "openhaptics", "ACUS_LIBHD", "force_dimension",
                           "ACUS_LIBDHD", "tested against an emulator only", "not a medical device"})
    EXPECT_NE(run.out.find(said), std::string::npos) << said;
  std::filesystem::remove_all(folder);
}

TEST(HapticProgram, serves_a_scene_under_a_simulated_hand_and_says_how_it_went) {
  const std::string folder = fresh_folder("serve");
  const ProgramRun run = run_program({"serve", ACUS_SOURCE_DIR "/scenes/bare_column.toml", "--device",
                                      "simulated", "--port", "0", "--seconds", "1", "--force-limit", "2"},
                                     folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* said : {"not a medical device", "Ticks", "Load", "Gate"})
    EXPECT_NE(run.out.find(said), std::string::npos) << said << run.out;
  std::filesystem::remove_all(folder);
}

// `acus emulate haply` as a process of its own, until it ends by itself.
class EmulatedService {
 public:
  explicit EmulatedService(const std::string& options)
      : said_(popen((ACUS_BUILD_DIR "/acus emulate haply --port 0 " + options).c_str(), "r")) {
    char line[256];
    constexpr const char* before = "--device haply:";
    while (port_.empty() && std::fgets(line, sizeof line, said_) != nullptr)
      if (const std::string text = line; text.find(before) != std::string::npos)
        port_ = text.substr(text.find(before) + std::string(before).size(), text.size());
    port_.erase(port_.find_last_not_of("\n") + 1);
  }
  ~EmulatedService() {
    while (std::fgetc(said_) != EOF) {
    }
    EXPECT_EQ(pclose(said_), 0);
  }
  const std::string& port() const { return port_; }

 private:
  std::FILE* said_;
  std::string port_;
};

// The browser outlives us, so that whatever it inherited would stay open.
TEST(HapticProgram, opens_a_browser_that_gets_the_address_and_nothing_else_of_ours) {
  const std::string folder = fresh_folder("browser"), program = folder + "/xdg-open";
  std::ofstream(program)
      << "#!/bin/sh\necho \"$1\" $$ $(cut -d' ' -f6 /proc/$$/stat) $(ls -l /proc/$$/fd | grep -c socket) "
         "> opened.txt.part\nmv opened.txt.part opened.txt\n";
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder + ":" + path).c_str(), 1);
  setenv("DISPLAY", ":9", 1);
  const EmulatedService service("--seconds 4");
  const ProgramRun run = run_program({"serve", ACUS_SOURCE_DIR "/scenes/bare_column.toml", "--device",
                                      "haply:" + service.port(), "--port", "0", "--seconds", "2"},
                                     folder);
  setenv("PATH", path.c_str(), 1);
  unsetenv("DISPLAY");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  std::istringstream opened(file_text(folder + "/opened.txt"));
  std::string address;
  long process = 0, session = -1, sockets = -1;
  opened >> address >> process >> session >> sockets;
  EXPECT_NE(run.out.find(address + "\n"), std::string::npos) << address;
  EXPECT_NE(address.find("/?token="), std::string::npos) << address;
  EXPECT_EQ(session, process);  // one of its own: Ctrl-C in our terminal is not for it
  EXPECT_EQ(sockets, 0);
  std::filesystem::remove_all(folder);
}

TEST(HapticProgram, records_a_hand_at_the_end_of_a_wire_and_replays_it_to_the_same_bits) {
  const std::string folder = fresh_folder("wire");
  {
    const EmulatedService service("--service 3.1 --speed 20 --way 30 --seconds 5");
    ASSERT_FALSE(service.port().empty());
    const ProgramRun served =
        run_program({"serve", ACUS_SOURCE_DIR "/scenes/bare_column.toml", "--device",
                     "haply:" + service.port(), "--port", "0", "--seconds", "3", "--record", "hand.acusrec"},
                    folder);
    EXPECT_EQ(served.exit_code, 0) << served.err;
    EXPECT_NE(served.out.find("Haply Inverse3 (tested against an emulator only)"), std::string::npos)
        << served.out;
  }
  const ProgramRun replayed = run_program({"replay", "hand.acusrec"}, folder);
  EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
  EXPECT_NE(replayed.out.find("The same bits"), std::string::npos) << replayed.out;
  const ProgramRun again = run_program({"serve", ACUS_SOURCE_DIR "/scenes/bare_column.toml", "--device",
                                        "recorded:hand.acusrec", "--port", "0", "--seconds", "1"},
                                       folder);
  EXPECT_EQ(again.exit_code, 0) << again.err;
  std::filesystem::remove_all(folder);
}

TEST(HapticProgram, says_that_a_device_was_lost) {
  const std::string folder = fresh_folder("lost");
  const EmulatedService service("--fault unplugged@0.5:60 --seconds 4");
  const ProgramRun served = run_program({"serve", ACUS_SOURCE_DIR "/scenes/bare_column.toml", "--device",
                                         "haply:" + service.port(), "--port", "0", "--seconds", "20"},
                                        folder);
  EXPECT_EQ(served.exit_code, 1);
  EXPECT_NE(served.err.find("the device was lost"), std::string::npos) << served.err;
  std::filesystem::remove_all(folder);
}

TEST(HapticProgram, tells_how_to_use_an_emulated_driver) {
  const std::string folder = fresh_folder("drivers");
  for (const auto& [verb, variable] :
       {std::pair{"openhaptics", "ACUS_LIBHD"}, std::pair{"force_dimension", "ACUS_LIBDHD"}}) {
    const ProgramRun told = run_program({"emulate", verb}, folder);
    EXPECT_EQ(told.exit_code, 0) << told.err;
    const std::string marker = "export " + std::string(variable) + "=";
    const std::size_t at = told.out.find(marker);
    ASSERT_NE(at, std::string::npos) << told.out;
    const std::size_t from = at + marker.size();
    EXPECT_TRUE(std::filesystem::exists(told.out.substr(from, told.out.find('\n', from) - from))) << told.out;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace acus::io
