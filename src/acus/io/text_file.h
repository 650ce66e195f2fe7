// Whole files as text.
#pragma once

#include <string>

#include "acus/base/result.h"

namespace acus::io {

// The bytes of a regular file of at most `most_bytes`; else a sentence that names the file.
Result<std::string> read_text(const std::string& path, std::size_t most_bytes);

}  // namespace acus::io
