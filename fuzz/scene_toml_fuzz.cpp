// libFuzzer: whatever the bytes, reading a scene ends in a scene that makes sense and survives being written
// and read again, or in a sentence.
#include <cstdint>
#include <cstdlib>

#include "acus/io/scene_toml.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto scene = acus::io::parse_scene(text, "fuzz.toml");
  if (!scene) {
    if (scene.error().sentence.empty()) std::abort();
    return 0;
  }
  const std::string written = acus::io::scene_toml(*scene);
  const auto again = acus::io::parse_scene(written, "fuzz.toml");
  if (!again || acus::io::scene_toml(*again) != written) std::abort();
  return 0;
}
