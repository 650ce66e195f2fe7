// libFuzzer: whatever the bytes, reading a mesh ends in a sound mesh or in a sentence.
#include <cstdint>
#include <cstdlib>

#include "acus/io/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto mesh = acus::io::read_mesh_bytes(bytes, "fuzz", 1e-3);
  if (!mesh) return 0;
  for (const auto& tet : mesh->tets) {
    if (!(signed_volume(*mesh, tet) > 0.0)) std::abort();
  }
  return 0;
}
