// A cursor over the bytes of a mesh file: words, and numbers in text or binary.
//
// The first failure stays: it keeps its sentence, and every later reading gives zero or an empty word, so
// that a reader is written as if nothing could fail and looks at failed() in its loops. Nothing is allocated
// on the word of a file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace acus::io {

enum class NumberType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

// The type by its name in VTK files ("Float32", "vtktypeint64", "unsigned_char", ...).
std::optional<NumberType> number_type(std::string_view name);

enum class Coding { text, little_endian, big_endian };

class MeshBytes {
 public:
  // `first_line` is the line of the file at which `bytes` begin. `bytes` must outlive the cursor.
  MeshBytes(std::string_view bytes, std::string file, long first_line = 1);

  bool failed() const { return !sentence_.empty(); }
  const std::string& sentence() const { return sentence_; }
  // Keeps "file:line: what" unless something failed before.
  void fail(const std::string& what);

  const std::string& file() const { return file_; }
  // Of the next byte, counted from 1; 0 once binary data was met, where lines mean nothing.
  long line() const { return all_text_ ? line_ : 0; }
  Coding coding() const { return coding_; }
  void set_coding(Coding coding);

  // True if nothing is left; in text, nothing but blanks.
  bool at_end() const;
  // Between begin_record and end_record text may not go on to the next line, and must fill its own. Nothing
  // in binary.
  void begin_record();
  void end_record();

  // The next word between blanks; empty at the end (no failure).
  std::string_view word();
  std::string_view peek_word() const;
  // Fails unless the next word is `expected`.
  void expect_word(std::string_view expected);
  // The rest of this line, without its end; the cursor goes to the next line.
  std::string_view rest_of_line();
  // Past the next place where `text` stands; false, and the cursor where it was, if it does not.
  bool skip_past(std::string_view text);

  // One number; `what` names it in the failure: "node 3 of 10".
  std::int64_t integer(NumberType type, const std::string& what);
  double real(NumberType type, const std::string& what);
  // A count: an integer from 0 up. No file has more things than bytes, so a greater count fails at once.
  std::int64_t count(NumberType type, const std::string& what);

 private:
  void skip_blanks();
  void advance(std::size_t bytes);
  std::string_view number_word(const std::string& what);
  std::uint64_t raw(NumberType type, const std::string& what);

  std::string_view bytes_;
  std::string file_;
  std::size_t at_ = 0;
  long line_;
  Coding coding_ = Coding::text;
  bool all_text_ = true;
  bool in_record_ = false;
  std::string sentence_;
};

// A word of a file as it may stand in a sentence: quoted, shortened, without control characters.
std::string quoted(std::string_view word);

// How a sentence begins: "file:line: ", or "file: " for line 0.
std::string place(const std::string& file, long line);

}  // namespace acus::io
