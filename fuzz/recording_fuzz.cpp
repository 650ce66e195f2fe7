// libFuzzer: whatever the bytes, reading a recording ends in a recording that hangs together or in a
// sentence. The checksums are set right first, lest nothing but them be tried.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "acus/io/recording_reader.h"

namespace {

// The bytes as payloads of blocks behind a sound head and scene: kind, length, payload, over and over.
std::string sealed(std::string_view bytes) {
  using namespace acus::io;
  std::string file = recording_head();
  std::uint32_t checksum = recording_head_checksum();
  file += block_bytes(RecordedScene{"", "{}", 0}, checksum);
  while (bytes.size() >= 2) {
    const auto kind = static_cast<unsigned char>(bytes[0]);
    const std::size_t size = static_cast<unsigned char>(bytes[1]);
    const auto block = block_of(kind, bytes.substr(2, size));
    if (block) file += block_bytes(*block, checksum);
    bytes.remove_prefix(std::min(bytes.size(), size + 2));
  }
  return file;
}

void read(const std::string& bytes) {
  std::istringstream file(bytes);
  const auto recording = acus::io::read_recording(file, "fuzz", acus::io::Ticks::read);
  if (!recording) {
    if (recording.error().sentence.empty()) std::abort();
    return;
  }
  if (!recording->whole && recording->loss.empty()) std::abort();
  std::uint64_t last = 0;
  for (const auto& hashed : recording->hashes) {
    if (hashed.step <= last || hashed.step > recording->travels.size()) std::abort();
    last = hashed.step;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  read(bytes);
  read(sealed(bytes));
  return 0;
}
