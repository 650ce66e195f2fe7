#include <algorithm>
#include <cctype>
#include <string>

#include "acus/io/vtk_mesh.h"

namespace acus::io {
namespace {

NumberType read_type(MeshBytes& bytes) {
  const std::string name(bytes.word());
  std::string lower = name;
  std::transform(name.begin(), name.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto type = number_type(lower);
  if (!type)
    bytes.fail(quoted(name) +
               " is not a type of number that VTK files have; expected float, double, int or the like");
  return type.value_or(NumberType::int32);
}

class Legacy {
 public:
  explicit Legacy(MeshBytes& bytes) : bytes_(bytes) {}
  MeshDraft read();

 private:
  void read_head();
  void read_part(const std::string& keyword);
  void read_points();
  void read_cells();
  void read_rows(std::int64_t cells, std::int64_t entries);
  void read_offsets(std::int64_t offsets, std::int64_t entries);
  void read_types();
  void read_attribute(const std::string& keyword);
  void read_array(const std::string& name, NumberType type, std::int64_t components, std::int64_t tuples);
  void read_field();
  // Data begin on the next line, in the file's coding; `end_data` returns to words.
  void begin_data();
  void end_data() { bytes_.set_coding(Coding::text); }

  MeshBytes& bytes_;
  VtkGrid grid_;
  Coding coding_ = Coding::text;
  std::int64_t attribute_tuples_ = 0;
  bool in_cell_data_ = false, in_attributes_ = false;
};

void Legacy::read_head() {
  bytes_.rest_of_line();
  bytes_.rest_of_line();
  const std::string coding(bytes_.word());
  if (coding != "ASCII" && coding != "BINARY")
    bytes_.fail("found " + quoted(coding) + " where ASCII or BINARY should be");
  if (coding == "BINARY") coding_ = Coding::big_endian;
  bytes_.expect_word("DATASET");
  const std::string dataset(bytes_.word());
  if (dataset != "UNSTRUCTURED_GRID")
    bytes_.fail("the data set is " + quoted(dataset) + "; expected UNSTRUCTURED_GRID");
}

void Legacy::begin_data() {
  if (coding_ == Coding::text) return;
  bytes_.rest_of_line();
  bytes_.set_coding(coding_);
}

void Legacy::read_points() {
  const auto count = bytes_.count(NumberType::int64, "the number of points");
  const NumberType type = read_type(bytes_);
  begin_data();
  for (std::int64_t i = 0; i < count && !bytes_.failed(); ++i) {
    DraftNode point;
    point.number = i;
    point.position = read_position(bytes_, type, "point " + std::to_string(i));
    point.line = bytes_.line();
    grid_.points.push_back(point);
  }
  end_data();
}

// "CELLS cells entries": until version 4 rows "4 a b c d"; from version 5 on offsets and connectivity apart.
void Legacy::read_cells() {
  const auto first = bytes_.count(NumberType::int64, "the number of cells");
  const auto second = bytes_.count(NumberType::int64, "the number of entries of the cells");
  if (bytes_.peek_word() == "OFFSETS") {
    read_offsets(first, second);
  } else {
    read_rows(first, second);
  }
}

void Legacy::read_rows(std::int64_t cells, std::int64_t entries) {
  begin_data();
  for (std::int64_t c = 0; c < cells && !bytes_.failed(); ++c) {
    const std::string name = "cell " + std::to_string(c);
    const auto points = bytes_.count(NumberType::int32, "the number of points of " + name);
    grid_.lines.push_back(bytes_.line());
    for (std::int64_t i = 0; i < points && !bytes_.failed(); ++i) {
      grid_.connectivity.push_back(bytes_.integer(NumberType::int32, "a point of " + name));
    }
    grid_.ends.push_back(static_cast<std::int64_t>(grid_.connectivity.size()));
  }
  end_data();
  const auto found = static_cast<std::int64_t>(grid_.connectivity.size()) + cells;
  if (found != entries)
    bytes_.fail("CELLS has " + std::to_string(found) + " entries, but promises " + std::to_string(entries));
}

void Legacy::read_offsets(std::int64_t offsets, std::int64_t entries) {
  bytes_.expect_word("OFFSETS");
  const NumberType offset_type = read_type(bytes_);
  begin_data();
  for (std::int64_t i = 0; i < offsets && !bytes_.failed(); ++i) {
    const auto end = bytes_.integer(offset_type, "an offset of the cells");
    if (i > 0) grid_.ends.push_back(end);
  }
  end_data();
  bytes_.expect_word("CONNECTIVITY");
  const NumberType entry_type = read_type(bytes_);
  begin_data();
  std::vector<long> line_of_entry;
  for (std::int64_t i = 0; i < entries && !bytes_.failed(); ++i) {
    grid_.connectivity.push_back(bytes_.integer(entry_type, "a point of a cell"));
    line_of_entry.push_back(bytes_.line());
  }
  end_data();
  std::int64_t begin = 0;
  for (const auto end : grid_.ends) {
    const bool inside = begin >= 0 && begin < static_cast<std::int64_t>(line_of_entry.size());
    grid_.lines.push_back(inside ? line_of_entry[static_cast<std::size_t>(begin)] : 0);
    begin = end;
  }
}

void Legacy::read_types() {
  const auto count = bytes_.count(NumberType::int64, "the number of cell types");
  begin_data();
  for (std::int64_t i = 0; i < count && !bytes_.failed(); ++i) {
    grid_.types.push_back(bytes_.integer(NumberType::int32, "the type of cell " + std::to_string(i)));
  }
  end_data();
}

void Legacy::read_array(const std::string& name, NumberType type, std::int64_t components,
                        std::int64_t tuples) {
  const std::size_t rank = region_rank(name);
  const bool is_region = in_cell_data_ && components == 1 && rank < grid_.region_rank;
  if (is_region) {
    grid_.region.clear();
    grid_.region_rank = rank;
  }
  begin_data();
  for (std::int64_t t = 0; t < tuples && !bytes_.failed(); ++t) {
    for (std::int64_t c = 0; c < components && !bytes_.failed(); ++c) {
      const double value = bytes_.real(type, "a value of " + quoted(name));
      if (!is_region) continue;
      grid_.region.push_back(as_region(value, bytes_));
    }
  }
  end_data();
}

void Legacy::read_field() {
  bytes_.word();  // its name
  const auto arrays = bytes_.count(NumberType::int64, "the number of arrays");
  for (std::int64_t i = 0; i < arrays && !bytes_.failed(); ++i) {
    if (bytes_.peek_word() == "METADATA") read_part(std::string(bytes_.word()));
    const std::string name(bytes_.word());
    const auto components = bytes_.count(NumberType::int64, "the number of components of " + quoted(name));
    const auto tuples = bytes_.count(NumberType::int64, "the number of tuples of " + quoted(name));
    const NumberType type = read_type(bytes_);
    read_array(name, type, components, components == 0 ? 0 : tuples);
  }
}

void Legacy::read_attribute(const std::string& keyword) {
  if (keyword == "SCALARS") {
    const std::string name(bytes_.word());
    const NumberType type = read_type(bytes_);
    std::int64_t components = 1;
    if (bytes_.peek_word() != "LOOKUP_TABLE")
      components = bytes_.count(NumberType::int64, "the number of components");
    bytes_.expect_word("LOOKUP_TABLE");
    bytes_.word();
    read_array(name, type, components, components == 0 ? 0 : attribute_tuples_);
    return;
  }
  if (keyword == "VECTORS" || keyword == "NORMALS" || keyword == "TENSORS") {
    const std::string name(bytes_.word());
    const NumberType type = read_type(bytes_);
    read_array(name, type, keyword == "TENSORS" ? 9 : 3, attribute_tuples_);
    return;
  }
  if (keyword == "TEXTURE_COORDINATES") {
    const std::string name(bytes_.word());
    const auto components = bytes_.count(NumberType::int64, "the number of components");
    read_array(name, read_type(bytes_), components, components == 0 ? 0 : attribute_tuples_);
    return;
  }
  if (keyword == "COLOR_SCALARS" || keyword == "LOOKUP_TABLE") {  // floats in text, bytes in binary
    const std::string name(bytes_.word());
    const auto size = bytes_.count(NumberType::int64, "the size of " + quoted(name));
    const bool colors = keyword == "COLOR_SCALARS";
    read_array(name, NumberType::uint8, colors ? size : 4, colors ? attribute_tuples_ : size);
    return;
  }
  bytes_.fail("found " + quoted(keyword) + ", which is no attribute of a VTK file; save the mesh without it");
}

void Legacy::read_part(const std::string& keyword) {
  if (keyword == "POINTS") {
    read_points();
  } else if (keyword == "CELLS") {
    read_cells();
  } else if (keyword == "CELL_TYPES") {
    read_types();
  } else if (keyword == "METADATA") {
    bytes_.rest_of_line();
    while (!bytes_.failed() && !bytes_.rest_of_line().empty()) continue;  // ends with an empty line
  } else if (keyword == "FIELD") {
    read_field();
  } else if (keyword == "CELL_DATA" || keyword == "POINT_DATA") {
    in_attributes_ = true;
    in_cell_data_ = keyword == "CELL_DATA";
    attribute_tuples_ = bytes_.count(NumberType::int64, "the number of tuples");
  } else if (!in_attributes_) {
    bytes_.fail("found " + quoted(keyword) + " where POINTS, CELLS, CELL_TYPES or CELL_DATA should be");
  } else {
    read_attribute(keyword);
  }
}

MeshDraft Legacy::read() {
  read_head();
  for (std::string keyword(bytes_.word()); !keyword.empty(); keyword = bytes_.word()) read_part(keyword);
  return draft_of(grid_, bytes_);
}

}  // namespace

MeshDraft read_vtk_legacy(MeshBytes& bytes) { return Legacy(bytes).read(); }

}  // namespace acus::io
