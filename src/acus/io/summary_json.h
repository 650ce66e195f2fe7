// summary.json: an insertion in one page that programs read.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "acus/io/insertion.h"

namespace acus::io {

// `wall_time` [s] of the steps gives the real-time factor; without it the text depends on
// scene and versions alone.
nlohmann::ordered_json summary_json(const Insertion& insertion,
                                    std::optional<double> wall_time = std::nullopt);

// The versions of acus, compiler, build type and Eigen.
nlohmann::ordered_json versions_json();

// As text, indented, with a new line at the end; bytes that are not UTF-8 are replaced.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace acus::io
