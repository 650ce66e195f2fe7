// Gmsh's mesh files: format 1 ($NOD, $ELM), 2 (to 2.2) and 4.1, the latter two in text or binary.
// http://gmsh.info/doc/texinfo/gmsh.html, "File formats".
#pragma once

#include "acus/io/mesh_draft.h"

namespace acus::io {

// The tetrahedra, their nodes, and as region the first physical tag of each. Tetrahedra of higher order are
// taken by their corners. A failure is in `bytes`.
MeshDraft read_gmsh(MeshBytes& bytes);

// Parts of read_gmsh. Each begins behind the name of its section and reads to its end.
struct GmshElement {
  std::int64_t type = 0;  // Gmsh's number of the kind
  std::int64_t number = 0;
  std::int64_t region = 0;
  std::int64_t nodes = 0;  // how many the file says it has; 0 where the format leaves it to the type
  long line = 0;
};
// Reads the nodes of `element` and keeps it if it is a tetrahedron.
void read_gmsh_element_nodes(MeshBytes& bytes, NumberType node_type, const GmshElement& element,
                             MeshDraft& draft);
void read_gmsh_1_elements(MeshBytes& bytes, MeshDraft& draft);
void read_gmsh_2_nodes(MeshBytes& bytes, Coding coding, MeshDraft& draft);  // format 1 has the same
void read_gmsh_2_elements(MeshBytes& bytes, Coding coding, MeshDraft& draft);
// First physical tag of each volume that has one, by the volume's tag.
using PhysicalTags = std::map<std::int64_t, std::int64_t>;
PhysicalTags read_gmsh_4_entities(MeshBytes& bytes, Coding coding);
void read_gmsh_4_nodes(MeshBytes& bytes, Coding coding, MeshDraft& draft);
void read_gmsh_4_elements(MeshBytes& bytes, Coding coding, const PhysicalTags& tags, MeshDraft& draft);

}  // namespace acus::io
