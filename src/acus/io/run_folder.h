// The folder a run writes: trace.csv and events.csv as it goes, frames for ParaView, summary.json at its end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "acus/io/insertion.h"
#include "acus/io/output_file.h"
#include "acus/io/vtk_files.h"

namespace acus::io {

class RunFolder {
 public:
  // Makes the folder where it is missing and begins its files; those of an earlier run are replaced. A
  // drawing of tissue and needle is kept every `vtu_every` steps, none when 0.
  static Result<RunFolder> create(const std::string& path, int vtu_every = 0);

  // Takes the state before the first step and after every step. False when something could not be written:
  // finish() says what.
  bool record(const Simulation& simulation);

  // Ends all files.
  std::optional<Error> finish(const Insertion& insertion, std::optional<double> wall_time = std::nullopt);

 private:
  RunFolder(std::string path, int vtu_every, OutputFile trace, OutputFile events)
      : path_(std::move(path)), vtu_every_(vtu_every), trace_(std::move(trace)), events_(std::move(events)) {}
  void write_row(const Frame& frame);
  std::optional<Error> write_drawing(const Simulation& simulation);

  std::string path_;
  int vtu_every_;
  OutputFile trace_, events_;
  int states_ = 0;  // recorded so far
  std::size_t events_written_ = 0;
  double last_row_time_ = -1.0;  // s
  std::vector<TimedFile> drawings_;
  std::optional<Error> failure_;
};

}  // namespace acus::io
