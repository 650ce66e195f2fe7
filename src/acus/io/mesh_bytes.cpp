#include "acus/io/mesh_bytes.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <utility>

#include "acus/base/bits.h"

namespace acus::io {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

std::size_t width(NumberType type) {
  switch (type) {
    case NumberType::int8:
    case NumberType::uint8:
      return 1;
    case NumberType::int16:
    case NumberType::uint16:
      return 2;
    case NumberType::int32:
    case NumberType::uint32:
    case NumberType::float32:
      return 4;
    default:
      return 8;
  }
}

bool is_signed(NumberType type) {
  return type == NumberType::int8 || type == NumberType::int16 || type == NumberType::int32 ||
         type == NumberType::int64;
}

std::int64_t sign_extended(std::uint64_t bits, std::size_t bytes) {
  const auto shift = 64 - 8 * bytes;
  return static_cast<std::int64_t>(bits << shift) >> shift;
}

}  // namespace

std::optional<NumberType> number_type(std::string_view name) {
  static constexpr std::pair<std::string_view, NumberType> names[] = {
      {"Int8", NumberType::int8},          {"UInt8", NumberType::uint8},
      {"Int16", NumberType::int16},        {"UInt16", NumberType::uint16},
      {"Int32", NumberType::int32},        {"UInt32", NumberType::uint32},
      {"Int64", NumberType::int64},        {"UInt64", NumberType::uint64},
      {"Float32", NumberType::float32},    {"Float64", NumberType::float64},
      {"char", NumberType::int8},          {"unsigned_char", NumberType::uint8},
      {"short", NumberType::int16},        {"unsigned_short", NumberType::uint16},
      {"int", NumberType::int32},          {"unsigned_int", NumberType::uint32},
      {"long", NumberType::int64},         {"unsigned_long", NumberType::uint64},
      {"float", NumberType::float32},      {"double", NumberType::float64},
      {"vtktypeint64", NumberType::int64}, {"vtktypeuint64", NumberType::uint64},
      {"vtkidtype", NumberType::int32},
  };
  const auto* found =
      std::find_if(std::begin(names), std::end(names), [&](const auto& n) { return n.first == name; });
  if (found == std::end(names)) return std::nullopt;
  return found->second;
}

std::string place(const std::string& file, long line) {
  std::string text = file;
  if (line > 0) text.append(":").append(std::to_string(line));
  return text.append(": ");
}

std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text = "\"";
  for (char c : word.substr(0, longest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > longest ? "...\"" : "\"");
}

MeshBytes::MeshBytes(std::string_view bytes, std::string file, long first_line)
    : bytes_(bytes), file_(std::move(file)), line_(first_line) {}

void MeshBytes::fail(const std::string& what) {
  if (failed()) return;
  sentence_ = place(file_, line()) + what;
}

void MeshBytes::set_coding(Coding coding) {
  coding_ = coding;
  all_text_ = all_text_ && coding == Coding::text;
}

void MeshBytes::advance(std::size_t bytes) {
  line_ += std::count(bytes_.begin() + static_cast<std::ptrdiff_t>(at_),
                      bytes_.begin() + static_cast<std::ptrdiff_t>(at_ + bytes), '\n');
  at_ += bytes;
}

bool MeshBytes::at_end() const {
  const auto rest = bytes_.substr(at_);
  return coding_ == Coding::text ? std::all_of(rest.begin(), rest.end(), is_blank) : rest.empty();
}

void MeshBytes::skip_blanks() {
  while (at_ < bytes_.size() && is_blank(bytes_[at_]) && !(in_record_ && bytes_[at_] == '\n')) advance(1);
}

void MeshBytes::begin_record() {
  if (coding_ != Coding::text) return;
  in_record_ = false;
  skip_blanks();
  in_record_ = true;
}

void MeshBytes::end_record() {
  if (coding_ != Coding::text) return;
  if (const auto extra = word(); !extra.empty()) fail(quoted(extra) + " is more than belongs on this line");
  in_record_ = false;
}

std::string_view MeshBytes::peek_word() const {
  if (failed()) return {};
  MeshBytes ahead = *this;
  return ahead.word();
}

std::string_view MeshBytes::word() {
  if (failed()) return {};
  skip_blanks();
  const auto rest = bytes_.substr(at_);
  const auto end = std::find_if(rest.begin(), rest.end(), is_blank);
  const auto found = rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
  at_ += found.size();
  return found;
}

void MeshBytes::expect_word(std::string_view expected) {
  const Coding coding = std::exchange(coding_, Coding::text);
  const auto found = word();
  const std::string wanted(expected);
  if (found.empty()) {
    fail("the file is cut short; expected " + wanted);
  } else if (found != expected) {
    fail("found " + quoted(found) + " where " + wanted + " should be");
  }
  coding_ = coding;
}

std::string_view MeshBytes::rest_of_line() {
  if (failed()) return {};
  const auto rest = bytes_.substr(at_);
  const auto end = std::min(rest.find('\n'), rest.size());
  advance(std::min(end + 1, rest.size()));
  auto text = rest.substr(0, end);
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  return text;
}

bool MeshBytes::skip_past(std::string_view text) {
  const auto found = bytes_.find(text, at_);
  if (failed() || found == std::string_view::npos) return false;
  advance(found + text.size() - at_);
  return true;
}

std::string_view MeshBytes::number_word(const std::string& what) {
  const auto text = word();
  if (text.empty() && !failed()) {
    const bool at_end = at_ >= bytes_.size();
    fail(at_end ? "the file is cut short; expected " + what : "the line is too short; expected " + what);
  }
  return text;
}

std::uint64_t MeshBytes::raw(NumberType type, const std::string& what) {
  const std::size_t bytes = width(type);
  if (failed()) return 0;
  if (bytes_.size() - at_ < bytes) {
    fail("the file is cut short; expected " + what);
    return 0;
  }
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    const std::size_t from = coding_ == Coding::big_endian ? i : bytes - 1 - i;
    bits = bits << 8 | static_cast<unsigned char>(bytes_[at_ + from]);
  }
  at_ += bytes;
  return bits;
}

std::int64_t MeshBytes::integer(NumberType type, const std::string& what) {
  if (coding_ != Coding::text) {
    const std::uint64_t bits = raw(type, what);
    if (is_signed(type)) return sign_extended(bits, width(type));
    if (bits > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
      fail(what + " is too large");
    return failed() ? 0 : static_cast<std::int64_t>(bits);
  }
  const auto text = number_word(what);
  if (failed()) return 0;
  std::int64_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size()) {
    fail(quoted(text) +
         (problem == std::errc::result_out_of_range ? " is too large" : " is not a whole number") +
         "; expected " + what);
    return 0;
  }
  return value;
}

double MeshBytes::real(NumberType type, const std::string& what) {
  if (coding_ != Coding::text) {
    const std::uint64_t bits = raw(type, what);
    if (type == NumberType::float64) return bits_as<double>(bits);
    if (type == NumberType::float32) return bits_as<float>(static_cast<std::uint32_t>(bits));
    return is_signed(type) ? static_cast<double>(sign_extended(bits, width(type)))
                           : static_cast<double>(bits);
  }
  const auto text = number_word(what);
  if (failed()) return 0.0;
  // Not std::from_chars: libc++ 13 has none for floating point. The program never leaves the "C" locale.
  const std::string copy(text);
  char* end = nullptr;
  const double value = std::strtod(copy.c_str(), &end);
  if (end != copy.c_str() + copy.size()) fail(quoted(text) + " is not a number; expected " + what);
  return failed() ? 0.0 : value;
}

std::int64_t MeshBytes::count(NumberType type, const std::string& what) {
  const std::int64_t value = integer(type, what);
  if (value < 0) fail(what + " is " + std::to_string(value) + "; it cannot be negative");
  const auto left = static_cast<std::int64_t>(bytes_.size() - at_);
  if (!failed() && value > left) {
    fail(what + " is " + std::to_string(value) + ", but only " + std::to_string(left) + " bytes follow");
  }
  return failed() ? 0 : value;
}

}  // namespace acus::io
