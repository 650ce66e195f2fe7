// Scenes as TOML and JSON. Every key, its unit and its range come from sim/scene_keys.h.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "acus/base/result.h"
#include "acus/sim/scene.h"

namespace acus::io {

// The scene in a file, with each of `settings` ("needle.length_mm=150") laid over it, checked as a whole.
// Errors are one sentence: file:line:column, the key, what is wrong and what would be right.
Result<Scene> read_scene(const std::string& path, const std::vector<std::string>& settings = {});

// The same from text. `name` stands for the file in errors; mesh files are looked for beside it.
Result<Scene> parse_scene(std::string_view text, const std::string& name,
                          const std::vector<std::string>& settings = {});

// `scene` with settings laid over it, checked as a whole. Names of files in them start from `folder`.
Result<Scene> with_settings(Scene scene, const std::vector<std::string>& settings,
                            const std::string& folder = "");

// Every key with its value: read back in the same folder, it is the same scene to the bit.
std::string scene_toml(const Scene& scene);
nlohmann::ordered_json scene_json(const Scene& scene);
// Text as a TOML string, quotes and all; what would end or break the line is escaped.
std::string toml_string(const std::string& text);

// The reference of all keys, in Markdown: name, default, what is allowed, meaning; and of the words for
// several of them.
std::string scene_keys_page();

// The gauges and materials of needle/gauges.h, for the page.
std::string needles_json();

}  // namespace acus::io
