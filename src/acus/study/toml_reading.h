// Reading a TOML file that a person wrote: the first thing that is wrong is kept with its place, and the
// steps after it do no harm.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "acus/base/result.h"
#include "acus/io/toml.h"

namespace acus::study {

class TomlReading {
 public:
  explicit TomlReading(std::string file) : file_(std::move(file)) {}

 protected:
  const std::string& file() const { return file_; }
  std::string folder() const;
  std::string place(const toml::node& node) const;  // file:line:column

  bool failed() const { return error_.has_value(); }
  const Error& error() const { return *error_; }
  // Keeps `error`, or the sentence at the place of `node` (the file alone without one), unless one is kept.
  void fail(const Error& error);
  void fail(const toml::node* node, const std::string& sentence);

  // Fails at a key of `table`, which the file's reader calls `where`, that is none of these.
  void only_keys(const toml::table& table, const char* where, std::initializer_list<const char*> known);
  // The text of a key, or `otherwise`; the texts of a list, none when the key is absent.
  std::string word(const toml::table& table, const char* key, const std::string& otherwise);
  std::vector<std::string> words(const toml::table& table, const char* key);

 private:
  std::string file_;
  std::optional<Error> error_;
};

}  // namespace acus::study
