// Gmsh formats 1 and 2: one node or element a line.
#include <string>

#include "acus/io/gmsh_mesh.h"

namespace acus::io {
namespace {

// The count that begins a section is text even where the rest is binary.
std::int64_t read_count(MeshBytes& bytes, const std::string& what) {
  bytes.begin_record();
  const auto count = bytes.count(NumberType::int64, what);
  bytes.end_record();
  return count;
}

std::string nth(const std::string& what, std::int64_t i, std::int64_t count) {
  return what + " " + std::to_string(i + 1) + " of " + std::to_string(count);
}

}  // namespace

void read_gmsh_2_nodes(MeshBytes& bytes, Coding coding, MeshDraft& draft) {
  const auto count = read_count(bytes, "the number of nodes");
  if (coding != Coding::text) bytes.rest_of_line();
  bytes.set_coding(coding);
  for (std::int64_t i = 0; i < count && !bytes.failed(); ++i) {
    bytes.begin_record();
    DraftNode node;
    node.line = bytes.line();
    node.number = bytes.integer(NumberType::int32, "the number of " + nth("node", i, count));
    if (node.number < 1)
      bytes.fail("node number " + std::to_string(node.number) + " is not positive; Gmsh counts from 1");
    node.position = read_position(bytes, NumberType::float64, "node " + std::to_string(node.number));
    bytes.end_record();
    draft.nodes.push_back(node);
  }
  bytes.set_coding(Coding::text);
}

void read_gmsh_1_elements(MeshBytes& bytes, MeshDraft& draft) {
  const auto count = read_count(bytes, "the number of elements");
  for (std::int64_t i = 0; i < count && !bytes.failed(); ++i) {
    bytes.begin_record();
    GmshElement element;
    element.line = bytes.line();
    element.number = bytes.integer(NumberType::int32, "the number of " + nth("element", i, count));
    const std::string name = "element " + std::to_string(element.number);
    element.type = bytes.integer(NumberType::int32, "the type of " + name);
    element.region = bytes.integer(NumberType::int32, "the physical region of " + name);
    bytes.integer(NumberType::int32, "the elementary region of " + name);
    element.nodes = bytes.integer(NumberType::int32, "the number of nodes of " + name);
    read_gmsh_element_nodes(bytes, NumberType::int32, element, draft);
    bytes.end_record();
  }
}

namespace {

// The first tag is the physical one; the others do not matter here.
void read_tags(MeshBytes& bytes, std::int64_t tags, GmshElement& element) {
  for (std::int64_t i = 0; i < tags && !bytes.failed(); ++i) {
    const auto tag = bytes.integer(NumberType::int32, "a tag of element " + std::to_string(element.number));
    if (i == 0) element.region = tag;
  }
}

void read_text_elements(MeshBytes& bytes, std::int64_t count, MeshDraft& draft) {
  for (std::int64_t i = 0; i < count && !bytes.failed(); ++i) {
    bytes.begin_record();
    GmshElement element;
    element.line = bytes.line();
    element.number = bytes.integer(NumberType::int32, "the number of " + nth("element", i, count));
    const std::string name = "element " + std::to_string(element.number);
    element.type = bytes.integer(NumberType::int32, "the type of " + name);
    const auto tags = bytes.count(NumberType::int32, "the number of tags of " + name);
    read_tags(bytes, tags, element);
    read_gmsh_element_nodes(bytes, NumberType::int32, element, draft);
    bytes.end_record();
  }
}

// Blocks of elements of one type.
void read_binary_elements(MeshBytes& bytes, std::int64_t count, MeshDraft& draft) {
  for (std::int64_t done = 0; done < count && !bytes.failed();) {
    GmshElement element;
    element.type = bytes.integer(NumberType::int32, "the type of a block of elements");
    const auto in_block = bytes.count(NumberType::int32, "the number of elements of a block");
    const auto tags = bytes.count(NumberType::int32, "the number of tags of a block");
    if (in_block == 0)
      bytes.fail("a block of elements is empty, and " + std::to_string(count - done) + " are still to come");
    for (std::int64_t i = 0; i < in_block && !bytes.failed(); ++i, ++done) {
      element.number = bytes.integer(NumberType::int32, "the number of " + nth("element", done, count));
      element.region = 0;
      read_tags(bytes, tags, element);
      read_gmsh_element_nodes(bytes, NumberType::int32, element, draft);
    }
  }
}

}  // namespace

void read_gmsh_2_elements(MeshBytes& bytes, Coding coding, MeshDraft& draft) {
  const auto count = read_count(bytes, "the number of elements");
  if (coding != Coding::text) bytes.rest_of_line();
  bytes.set_coding(coding);
  (coding == Coding::text ? read_text_elements : read_binary_elements)(bytes, count, draft);
  bytes.set_coding(Coding::text);
}

}  // namespace acus::io
