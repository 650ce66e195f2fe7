#include "acus/io/gmsh_mesh.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace acus::io {
namespace {

struct Kind {
  std::int64_t type;
  std::size_t nodes;
  const char* name;
};
constexpr Kind kinds[] = {
    {1, 2, "lines"},        {2, 3, "triangles"},    {3, 4, "quadrangles"},  {4, 4, "tetrahedra"},
    {5, 8, "hexahedra"},    {6, 6, "prisms"},       {7, 5, "pyramids"},     {8, 3, "lines"},
    {9, 6, "triangles"},    {10, 9, "quadrangles"}, {11, 10, "tetrahedra"}, {12, 27, "hexahedra"},
    {13, 18, "prisms"},     {14, 14, "pyramids"},   {15, 1, "points"},      {16, 8, "quadrangles"},
    {17, 20, "hexahedra"},  {18, 15, "prisms"},     {19, 13, "pyramids"},   {20, 9, "triangles"},
    {21, 10, "triangles"},  {22, 12, "triangles"},  {23, 15, "triangles"},  {24, 15, "triangles"},
    {25, 21, "triangles"},  {26, 4, "lines"},       {27, 5, "lines"},       {28, 6, "lines"},
    {29, 20, "tetrahedra"}, {30, 35, "tetrahedra"}, {31, 56, "tetrahedra"}, {92, 64, "hexahedra"},
    {93, 125, "hexahedra"}};

struct Format {
  int version = 0;  // 2 or 4; 0 before $MeshFormat
  Coding coding = Coding::text;
};

Format read_format(MeshBytes& bytes) {
  bytes.begin_record();
  const std::string version(bytes.word());
  const auto binary = bytes.integer(NumberType::int32, "0 for text or 1 for binary");
  const auto data_size = bytes.integer(NumberType::int32, "the size of a number, 8");
  bytes.end_record();
  Format format;
  if (version == "2" || version == "2.0" || version == "2.1" || version == "2.2") format.version = 2;
  if (version == "4.1") format.version = 4;
  if (format.version == 0) {
    bytes.fail("Gmsh format " + quoted(version) +
               " is not read; save as 2.2 or 4.1 (gmsh -save -format msh41)");
  }
  if (data_size != 8)
    bytes.fail("numbers of " + std::to_string(data_size) + " bytes are not read; Gmsh writes 8");
  if (binary != 0) {
    // A one in four bytes tells the order of the bytes.
    bytes.rest_of_line();
    bytes.set_coding(Coding::little_endian);
    const auto one = bytes.integer(NumberType::int32, "the number 1 that tells the order of bytes");
    constexpr std::int64_t one_reversed = 0x01000000;
    if (one != 1 && one != one_reversed) bytes.fail("the number 1 that tells the order of bytes is missing");
    format.coding = one == 1 ? Coding::little_endian : Coding::big_endian;
    bytes.set_coding(Coding::text);
  }
  bytes.expect_word("$EndMeshFormat");
  return format;
}

void skip_section(MeshBytes& bytes, const std::string& section) {
  const std::string end = "$End" + section.substr(1);
  if (!bytes.skip_past(end))
    bytes.fail("section " + quoted(section) + " does not end; expected " + quoted(end));
}

}  // namespace

void read_gmsh_element_nodes(MeshBytes& bytes, NumberType node_type, const GmshElement& element,
                             MeshDraft& draft) {
  const auto* kind =
      std::find_if(std::begin(kinds), std::end(kinds), [&](const Kind& k) { return k.type == element.type; });
  if (kind == std::end(kinds)) {
    bytes.fail("element " + std::to_string(element.number) + " is of type " + std::to_string(element.type) +
               ", which Gmsh does not have (a tetrahedron is of type 4)");
    return;
  }
  if (element.nodes != 0 && element.nodes != static_cast<std::int64_t>(kind->nodes)) {
    bytes.fail("element " + std::to_string(element.number) + " has " + std::to_string(element.nodes) +
               " nodes, but its type has " + std::to_string(kind->nodes));
  }
  const bool is_tet = std::string_view(kind->name) == "tetrahedra";
  DraftTet tet{element.number, {}, element.region, element.line};
  for (std::size_t i = 0; i < kind->nodes; ++i) {
    const auto node = bytes.integer(
        node_type, "node " + std::to_string(i + 1) + " of element " + std::to_string(element.number));
    if (i < 4) tet.nodes[i] = node;
  }
  if (is_tet) {
    draft.tets.push_back(tet);
  } else {
    ++draft.skipped[kind->name];
  }
}

MeshDraft read_gmsh(MeshBytes& bytes) {
  MeshDraft draft;
  Format format;
  PhysicalTags tags;
  for (std::string section(bytes.word()); !section.empty() && !bytes.failed(); section = bytes.word()) {
    const bool is_mesh = section == "$Nodes" || section == "$Elements" || section == "$Entities";
    if (section[0] != '$') {
      bytes.fail("found " + quoted(section) + " where a section like $Nodes should begin");
    } else if (section == "$MeshFormat") {
      format = read_format(bytes);
    } else if (section == "$NOD") {
      read_gmsh_2_nodes(bytes, Coding::text, draft);
      bytes.expect_word("$ENDNOD");
    } else if (section == "$ELM") {
      read_gmsh_1_elements(bytes, draft);
      bytes.expect_word("$ENDELM");
    } else if (is_mesh && format.version == 0) {
      bytes.fail(section + " comes before $MeshFormat, which must come first");
    } else if (section == "$Entities" && format.version == 4) {
      tags = read_gmsh_4_entities(bytes, format.coding);
    } else if (section == "$Nodes") {
      (format.version == 2 ? read_gmsh_2_nodes : read_gmsh_4_nodes)(bytes, format.coding, draft);
      bytes.expect_word("$EndNodes");
    } else if (section == "$Elements") {
      if (format.version == 2)
        read_gmsh_2_elements(bytes, format.coding, draft);
      else
        read_gmsh_4_elements(bytes, format.coding, tags, draft);
      bytes.expect_word("$EndElements");
    } else {
      skip_section(bytes, section);
    }
  }
  return draft;
}

}  // namespace acus::io
