#include <algorithm>
#include <functional>
#include <pugixml.hpp>
#include <string>

#include "acus/io/vtk_mesh.h"

namespace acus::io {
namespace {

constexpr std::string_view appended_tag = "<AppendedData";

// Bytes of base64 text. VTK may end one run with "=" and begin another behind it.
std::string base64_decoded(std::string_view text) {
  static constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int held = 0;  // bits of `bits` that are not written yet
  for (char c : text) {
    const auto digit = digits.find(c);
    if (digit == std::string_view::npos) {
      if (c == '=') bits = 0, held = 0;
      continue;
    }
    bits = (bits << 6 | static_cast<unsigned>(digit)) & 0xffffU;
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 0xffU);
  }
  return bytes;
}

class Vtu {
 public:
  Vtu(std::string_view bytes, const std::string& file);
  Result<MeshDraft> read();

 private:
  using Read = std::function<void(MeshBytes&, NumberType)>;

  void fail(const pugi::xml_node& node, const std::string& what);
  std::int64_t count(const pugi::xml_node& node, const char* attribute);
  void read_array(const pugi::xml_node& array, const Read& read);
  void read_encoded(const pugi::xml_node& array, NumberType type, const std::string& data, bool raw,
                    const Read& read);
  pugi::xml_node array_named(const pugi::xml_node& parent, const char* name);
  void read_points(const pugi::xml_node& piece);
  void read_cells(const pugi::xml_node& piece);
  void read_regions(const pugi::xml_node& piece);
  long line_at(std::ptrdiff_t offset) const;

  std::string_view bytes_;
  std::string file_;
  std::string_view appended_;  // behind its leading "_"
  pugi::xml_document document_;
  pugi::xml_node root_;
  VtkGrid grid_;
  std::string sentence_;  // of the first failure
};

// Raw appended data are no XML: the document ends before them.
Vtu::Vtu(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {
  const auto appended = bytes_.find(appended_tag);
  std::string xml(bytes_.substr(0, appended));
  if (appended != std::string_view::npos) {
    const auto start = std::min(bytes_.find('_', bytes_.find('>', appended)), bytes_.size() - 1);
    appended_ = bytes_.substr(start + 1);
    const auto head = bytes_.substr(appended, bytes_.find('>', appended) - appended);
    xml += std::string(head) + "/></VTKFile>";
  }
  const auto parsed = document_.load_buffer(xml.data(), xml.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!parsed) {
    sentence_ =
        file_ + ":" + std::to_string(line_at(parsed.offset)) + ": this is not XML: " + parsed.description();
  }
  root_ = document_.child("VTKFile");
}

long Vtu::line_at(std::ptrdiff_t offset) const {
  const auto end = std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(bytes_.size()));
  return 1 + std::count(bytes_.begin(), bytes_.begin() + end, '\n');
}

void Vtu::fail(const pugi::xml_node& node, const std::string& what) {
  if (!sentence_.empty()) return;
  sentence_ = file_ + ":" + std::to_string(line_at(node.offset_debug())) + ": " + what;
}

std::int64_t Vtu::count(const pugi::xml_node& node, const char* attribute) {
  const std::string text = node.attribute(attribute).value();
  MeshBytes bytes(text, file_, line_at(node.offset_debug()));
  const auto value = bytes.integer(NumberType::int64, attribute);
  if (value < 0) bytes.fail(std::string(attribute) + " is negative");
  if (bytes.failed() && sentence_.empty()) sentence_ = bytes.sentence();
  return value;
}

pugi::xml_node Vtu::array_named(const pugi::xml_node& parent, const char* name) {
  const auto array = parent.find_child_by_attribute("DataArray", "Name", name);
  if (!array) fail(parent, std::string("<") + parent.name() + "> has no DataArray " + quoted(name));
  return array;
}

// Hands the numbers of a DataArray to `read`, whatever they are written in.
void Vtu::read_array(const pugi::xml_node& array, const Read& read) {
  if (!sentence_.empty()) return;
  const std::string type_name = array.attribute("type").value();
  const auto type = number_type(type_name);
  if (!type)
    return fail(array,
                quoted(type_name) +
                    " is not a type of number that VTU files have; expected Float64, Int64 or the like");
  const std::string format = array.attribute("format").as_string("ascii");
  if (format == "binary") return read_encoded(array, *type, base64_decoded(array.child_value()), false, read);
  if (format == "appended") {
    const auto offset = static_cast<std::size_t>(count(array, "offset"));
    if (!sentence_.empty()) return;
    if (offset >= appended_.size())
      return fail(array,
                  "the data at offset " + std::to_string(offset) + " are missing; the file is cut short");
    const auto data = appended_.substr(offset);
    const bool raw = std::string_view(root_.child("AppendedData").attribute("encoding").value()) == "raw";
    // In base64 the next array begins without a mark; its bytes are beyond this one's count and do not
    // matter.
    return read_encoded(array, *type, raw ? std::string(data) : base64_decoded(data), true, read);
  }
  if (format != "ascii")
    return fail(array, "the format " + quoted(format) + " is not one of ascii, binary and appended");
  const auto text = array.first_child();
  MeshBytes bytes(text.value(), file_, line_at((text ? text : array).offset_debug()));
  read(bytes, *type);
  if (!bytes.at_end()) bytes.fail("the DataArray holds more numbers than its piece promises");
  if (bytes.failed()) sentence_ = bytes.sentence();
}

// A count of bytes, then the numbers.
void Vtu::read_encoded(const pugi::xml_node& array, NumberType type, const std::string& data,
                       bool more_follows, const Read& read) {
  const std::string_view order = root_.attribute("byte_order").as_string("LittleEndian");
  const Coding coding = order == "BigEndian" ? Coding::big_endian : Coding::little_endian;
  const bool wide = std::string_view(root_.attribute("header_type").value()) == "UInt64";
  MeshBytes head(data, file_);
  head.set_coding(coding);
  const auto size = head.count(wide ? NumberType::uint64 : NumberType::uint32, "the size of a DataArray");
  if (head.failed()) return fail(array, "the DataArray is cut short");
  const std::size_t begin = wide ? 8 : 4;
  if (data.size() - begin < static_cast<std::size_t>(size) ||
      (!more_follows && data.size() - begin > static_cast<std::size_t>(size))) {
    return fail(array, "the DataArray has " + std::to_string(data.size() - begin) + " bytes, but promises " +
                           std::to_string(size));
  }
  MeshBytes bytes(std::string_view(data).substr(begin, static_cast<std::size_t>(size)), file_);
  bytes.set_coding(coding);
  read(bytes, type);
  if (!bytes.at_end()) bytes.fail("the DataArray holds more numbers than its piece promises");
  if (bytes.failed()) fail(array, bytes.sentence().substr(file_.size() + 2));
}

void Vtu::read_points(const pugi::xml_node& piece) {
  const auto points = count(piece, "NumberOfPoints");
  const auto array = piece.child("Points").child("DataArray");
  if (!array) return fail(piece, "<Piece> has no <Points> with a DataArray");
  read_array(array, [&](MeshBytes& bytes, NumberType type) {
    for (std::int64_t i = 0; i < points && !bytes.failed(); ++i) {
      DraftNode point;
      point.number = i;
      point.position = read_position(bytes, type, "point " + std::to_string(i));
      point.line = bytes.line();
      grid_.points.push_back(point);
    }
  });
}

void Vtu::read_cells(const pugi::xml_node& piece) {
  const auto cells = count(piece, "NumberOfCells");
  const auto parent = piece.child("Cells");
  if (!parent) return fail(piece, "<Piece> has no <Cells>");
  const auto read_into = [&](const char* name, std::vector<std::int64_t>& values, std::vector<long>* lines) {
    read_array(array_named(parent, name), [&](MeshBytes& bytes, NumberType type) {
      const auto wanted = lines ? (grid_.ends.empty() ? 0 : grid_.ends.back()) : cells;
      for (std::int64_t i = 0; i < wanted && !bytes.failed(); ++i) {
        values.push_back(bytes.integer(type, "entry " + std::to_string(i) + " of the " + name));
        if (lines) lines->push_back(bytes.line());
      }
    });
  };
  read_into("offsets", grid_.ends, nullptr);
  read_into("types", grid_.types, nullptr);
  std::vector<long> lines;
  read_into("connectivity", grid_.connectivity, &lines);
  for (std::size_t c = 0; c < grid_.ends.size(); ++c) {
    const auto begin = c == 0 ? 0 : grid_.ends[c - 1];
    const bool inside = begin >= 0 && begin < static_cast<std::int64_t>(lines.size());
    grid_.lines.push_back(inside ? lines[static_cast<std::size_t>(begin)] : 0);
  }
}

void Vtu::read_regions(const pugi::xml_node& piece) {
  for (const auto& array : piece.child("CellData").children("DataArray")) {
    const std::size_t rank = region_rank(array.attribute("Name").value());
    if (rank >= grid_.region_rank || array.attribute("NumberOfComponents").as_int(1) != 1) continue;
    grid_.region_rank = rank;
    grid_.region.clear();
    read_array(array, [&](MeshBytes& bytes, NumberType type) {
      for (std::size_t i = 0; i < grid_.ends.size() && !bytes.failed(); ++i) {
        grid_.region.push_back(as_region(bytes.real(type, "a region"), bytes));
      }
    });
  }
}

Result<MeshDraft> Vtu::read() {
  const auto grid = root_.child("UnstructuredGrid");
  const auto piece = grid.child("Piece");
  if (!grid) {
    fail(root_, "expected <VTKFile type=\"UnstructuredGrid\"> with an <UnstructuredGrid>");
  } else if (root_.attribute("compressor")) {
    fail(root_, "the data are packed by " + quoted(root_.attribute("compressor").value()) +
                    "; save without compression, or convert with meshio (meshio decompress)");
  } else if (!piece || piece.next_sibling("Piece")) {
    fail(grid, "expected one <Piece>; merge the pieces into one mesh before saving");
  }
  if (sentence_.empty()) read_points(piece);
  if (sentence_.empty()) read_cells(piece);
  if (sentence_.empty()) read_regions(piece);
  if (!sentence_.empty()) return Error{sentence_};
  MeshBytes whole(bytes_, file_, line_at(piece.offset_debug()));
  const MeshDraft draft = draft_of(grid_, whole);
  if (whole.failed()) return Error{whole.sentence()};
  return draft;
}

}  // namespace

Result<MeshDraft> read_vtu(std::string_view bytes, const std::string& file) {
  return Vtu(bytes, file).read();
}

}  // namespace acus::io
