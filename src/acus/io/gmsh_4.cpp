// Gmsh format 4.1: nodes and elements in blocks, one for each entity of the geometry.
#include <string>

#include "acus/io/gmsh_mesh.h"

namespace acus::io {
namespace {

constexpr NumberType tag_type = NumberType::int32;
constexpr NumberType size_type = NumberType::uint64;  // size_t, 8 bytes
constexpr NumberType real_type = NumberType::float64;

void begin_section(MeshBytes& bytes, Coding coding) {
  if (coding != Coding::text) bytes.rest_of_line();
  bytes.set_coding(coding);
}

// Numbers of blocks, of things in them, and the range of their tags (which nothing here needs).
std::int64_t read_header(MeshBytes& bytes, const std::string& what) {
  bytes.begin_record();
  const auto blocks = bytes.count(size_type, "the number of blocks of " + what);
  bytes.count(size_type, "the number of " + what);
  bytes.integer(size_type, "the smallest tag of the " + what);
  bytes.integer(size_type, "the largest tag of the " + what);
  bytes.end_record();
  return blocks;
}

// One line of $Entities: tag, box, physical tags, and the tags of its boundary. Returns tag and first
// physical tag.
std::pair<std::int64_t, std::int64_t> read_entity(MeshBytes& bytes, bool is_point) {
  bytes.begin_record();
  const auto tag = bytes.integer(tag_type, "the tag of an entity");
  const std::string name = "entity " + std::to_string(tag);
  const int coordinates = is_point ? 3 : 6;
  for (int i = 0; i < coordinates; ++i) bytes.real(real_type, "the bounds of " + name);
  std::int64_t physical = 0;
  const auto tags = bytes.count(size_type, "the number of physical tags of " + name);
  for (std::int64_t i = 0; i < tags && !bytes.failed(); ++i) {
    const auto read = bytes.integer(tag_type, "a physical tag of " + name);
    if (i == 0) physical = read;
  }
  const auto bounding = is_point ? 0 : bytes.count(size_type, "the number of boundaries of " + name);
  for (std::int64_t i = 0; i < bounding && !bytes.failed(); ++i)
    bytes.integer(tag_type, "a boundary of " + name);
  bytes.end_record();
  return {tag, physical};
}

}  // namespace

PhysicalTags read_gmsh_4_entities(MeshBytes& bytes, Coding coding) {
  begin_section(bytes, coding);
  bytes.begin_record();
  std::array<std::int64_t, 4> counts{};  // points, curves, surfaces, volumes
  for (auto& count : counts) count = bytes.count(size_type, "the number of entities");
  bytes.end_record();
  PhysicalTags tags;
  for (std::size_t dimension = 0; dimension < counts.size(); ++dimension) {
    for (std::int64_t i = 0; i < counts[dimension] && !bytes.failed(); ++i) {
      const auto [tag, physical] = read_entity(bytes, dimension == 0);
      if (dimension == 3) tags[tag] = physical;
    }
  }
  bytes.set_coding(Coding::text);
  bytes.expect_word("$EndEntities");
  return tags;
}

void read_gmsh_4_nodes(MeshBytes& bytes, Coding coding, MeshDraft& draft) {
  begin_section(bytes, coding);
  const auto blocks = read_header(bytes, "nodes");
  for (std::int64_t block = 0; block < blocks && !bytes.failed(); ++block) {
    bytes.begin_record();
    const auto dimension = bytes.integer(tag_type, "the dimension of a block of nodes");
    bytes.integer(tag_type, "the entity of a block of nodes");
    const auto parametric = bytes.integer(tag_type, "0 or 1, whether a block of nodes has parameters");
    const auto count = bytes.count(size_type, "the number of nodes of a block");
    bytes.end_record();
    const std::size_t first = draft.nodes.size();
    for (std::int64_t i = 0; i < count && !bytes.failed(); ++i) {
      bytes.begin_record();
      DraftNode node;
      node.number = bytes.integer(size_type, "the number of a node");
      if (node.number < 1)
        bytes.fail("node number " + std::to_string(node.number) + " is not positive; Gmsh counts from 1");
      bytes.end_record();
      draft.nodes.push_back(node);
    }
    for (std::size_t i = first; i < draft.nodes.size() && !bytes.failed(); ++i) {
      bytes.begin_record();
      DraftNode& node = draft.nodes[i];
      node.line = bytes.line();
      node.position = read_position(bytes, real_type, "node " + std::to_string(node.number));
      for (std::int64_t k = 0; k < dimension && parametric != 0 && !bytes.failed(); ++k)
        bytes.real(real_type, "a parameter of a node");
      bytes.end_record();
    }
  }
  bytes.set_coding(Coding::text);
}

void read_gmsh_4_elements(MeshBytes& bytes, Coding coding, const PhysicalTags& tags, MeshDraft& draft) {
  begin_section(bytes, coding);
  const auto blocks = read_header(bytes, "elements");
  constexpr int volume = 3;
  for (std::int64_t block = 0; block < blocks && !bytes.failed(); ++block) {
    bytes.begin_record();
    const auto dimension = bytes.integer(tag_type, "the dimension of a block of elements");
    const auto entity = bytes.integer(tag_type, "the entity of a block of elements");
    GmshElement element;
    element.type = bytes.integer(tag_type, "the type of a block of elements");
    const auto count = bytes.count(size_type, "the number of elements of a block");
    bytes.end_record();
    const auto tag = tags.find(entity);
    if (dimension == volume && tag != tags.end()) element.region = tag->second;
    for (std::int64_t i = 0; i < count && !bytes.failed(); ++i) {
      bytes.begin_record();
      element.line = bytes.line();
      element.number = bytes.integer(size_type, "the number of an element");
      read_gmsh_element_nodes(bytes, size_type, element, draft);
      bytes.end_record();
    }
  }
  bytes.set_coding(Coding::text);
}

}  // namespace acus::io
