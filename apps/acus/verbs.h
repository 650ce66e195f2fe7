// The verbs of the program: what each is told, and the work it does; the work returns the exit code.
#pragma once

#include <string>
#include <vector>

namespace acus::app {

enum ExitCode { done = 0, run_failed = 1, bad_input = 2 };

// "acus: sentence" on standard error; returns `code`.
int refused(const std::string& sentence, ExitCode code);

// What is kept and printed of one insertion.
struct OutputOptions {
  std::string out;  // folder
  bool out_given = false;
  int vtu_every = 0;  // steps; 0: never
  bool json = false, quiet = false;
};

struct RunOptions {
  std::string scene;
  std::vector<std::string> settings;  // key=value
  std::string record;                 // file
  bool record_given = false;
  int threads = 1;  // that share a step
  OutputOptions output;
};
int do_run(const RunOptions& options);

struct ReplayOptions {
  std::string recording;
  std::vector<std::string> settings;  // key=value
  OutputOptions output;
};
int do_replay(const ReplayOptions& options);

struct CheckOptions {
  std::string scene;
  std::vector<std::string> settings;
  bool keys = false, needles = false;
};
int do_check(const CheckOptions& options);

struct BenchOptions {
  std::vector<int> sizes = {1000, 3000, 10000, 40000};  // tetrahedra
  bool sizes_given = false;
  int steps = 100;
  bool steps_given = false;
  bool equal_given = false;
  std::string equal = "load";         // the measure of the residual in which the reference is met
  std::string element;                // as tissue.element; empty: the scene's own
  bool insertion = false;             // whole ones instead of single steps
  std::vector<std::string> settings;  // key=value, of an insertion
  int threads = 1;                    // that share a step of the engine
  bool json = false;
};
int do_bench(const BenchOptions& options);

struct StudyOptions {
  std::string study, out, figures;
  std::vector<std::string> settings;
  int jobs = 0;  // 0: one for each core
  bool resume = false, quiet = false;
};
int do_study(const StudyOptions& options);

struct ServeOptions {
  std::string scene;
  std::vector<std::string> settings;
  std::string device;         // empty: a page leads the hand
  int port = 8650;            // 0: any that is free
  bool opens_browser = true;  // where there is a desktop
  int threads = 1;            // that share a step
  double force_limit = 0.0;   // N; 0: the device's own
  double seconds = 0.0;       // 0: until it is interrupted
  std::string record;         // file
  bool record_given = false;
};
int do_serve(const ServeOptions& options);

struct EmulateHaplyOptions {
  int port = 10001;
  std::string service = "3.5";      // its version
  double speed = 10.0, way = 60.0;  // mm/s, mm, of the hand
  std::vector<std::string> faults;
  double seconds = 0.0;  // 0: until it is interrupted
};
int do_emulate_haply(const EmulateHaplyOptions& options);
int do_emulate_openhaptics();
int do_emulate_force_dimension();

int do_device_list();
int do_device_check(const std::string& name);

}  // namespace acus::app
