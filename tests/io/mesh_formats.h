// One small mesh in every format that is read, written here byte by byte after the formats' own descriptions.
#pragma once

#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "acus/mesh/tet_mesh.h"

namespace acus::io {

// Two tetrahedra on a common face, in millimetres, in regions 3 and 4; every coordinate is a short binary
// fraction.
inline mesh::TetMesh two_tets() {
  return {{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 8}, {7.5, 7.25, -6.125}},
          {{0, 1, 2, 3}, {4, 2, 1, 3}},
          {3, 4}};
}

// Bytes of numbers, in either order.
struct Packed {
  bool big_endian = false;
  std::string bytes = {};
  template <class T>
  Packed& add(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes += raw[big_endian ? sizeof(T) - 1 - i : i];
    return *this;
  }
};

inline std::string gmsh_1() {
  return "$NOD\n5\n1 0 0 0\n2 8 0 0\n3 0 8 0\n4 0 0 8\n5 7.5 7.25 -6.125\n$ENDNOD\n"
         "$ELM\n3\n1 2 9 9 3 1 2 3\n2 4 3 1 4 1 2 3 4\n3 4 4 1 4 5 3 2 4\n$ENDELM\n";
}

inline std::string gmsh_2() {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 3 \"tissue\"\n$EndPhysicalNames\n"
         "$Nodes\n5\n1 0 0 0\n2 8 0 0\n3 0 8 0\n4 0 0 8\n5 7.5 7.25 -6.125\n$EndNodes\n"
         "$Elements\n3\n1 2 2 9 9 1 2 3\n2 4 2 3 1 1 2 3 4\n3 4 2 4 1 5 3 2 4\n$EndElements\n";
}

inline std::string gmsh_2_binary(bool big_endian) {
  Packed one{big_endian}, nodes{big_endian}, elements{big_endian};
  one.add(1);
  const mesh::TetMesh mesh = two_tets();
  for (int n = 0; n < 5; ++n) {
    const Vec3& x = mesh.nodes[static_cast<std::size_t>(n)];
    nodes.add(n + 1).add(x.x()).add(x.y()).add(x.z());
  }
  for (int i :
       {2, 1, 2, /**/ 1, 9, 9, 1, 2, 3, /**/ 4, 2, 2, /**/ 2, 3, 1, 1, 2, 3, 4, /**/ 3, 4, 1, 5, 3, 2, 4})
    elements.add(i);
  return "$MeshFormat\n2.2 1 8\n" + one.bytes + "\n$EndMeshFormat\n$Nodes\n5\n" + nodes.bytes +
         "\n$EndNodes\n$Elements\n3\n" + elements.bytes + "\n$EndElements\n";
}

inline std::string gmsh_4() {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
         "$Entities\n1 0 0 2\n1 0 0 0 0\n1 0 0 0 8 8 8 1 3 0\n2 0 0 -7 8 8 8 2 4 5 1 -1\n$EndEntities\n"
         "$Nodes\n2 5 1 5\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n8 0 0\n0 8 0\n0 0 8\n3 2 1 1\n5\n7.5 7.25 -6.125 0.5 "
         "0.5 0.5\n$EndNodes\n"
         "$Elements\n3 3 1 3\n2 1 2 1\n1 1 2 3\n3 1 4 1\n2 1 2 3 4\n3 2 4 1\n3 5 3 2 4\n$EndElements\n";
}

inline std::string gmsh_4_binary() {
  using Size = std::uint64_t;
  Packed one, entities, nodes, elements;
  one.add(1);
  for (Size n : {0, 0, 0, 2}) entities.add(n);
  for (int volume : {1, 2}) {
    entities.add(volume);
    for (int i = 0; i < 6; ++i) entities.add(0.5);
    entities.add(Size{1}).add(volume + 2).add(Size{0});
  }
  for (Size n : {2, 5, 1, 5}) nodes.add(n);
  const mesh::TetMesh mesh = two_tets();
  const auto block = [&](int entity, Size first, Size count) {
    nodes.add(3).add(entity).add(0).add(count);
    for (Size n = first; n < first + count; ++n) nodes.add(n + 1);
    for (Size n = first; n < first + count; ++n)
      nodes.add(mesh.nodes[n].x()).add(mesh.nodes[n].y()).add(mesh.nodes[n].z());
  };
  block(1, 0, 4);
  block(2, 4, 1);
  for (Size n : {2, 2, 2, 3}) elements.add(n);
  elements.add(3).add(1).add(4).add(Size{1});
  for (Size n : {2, 1, 2, 3, 4}) elements.add(n);
  elements.add(3).add(2).add(4).add(Size{1});
  for (Size n : {3, 5, 3, 2, 4}) elements.add(n);
  return "$MeshFormat\n4.1 1 8\n" + one.bytes + "\n$EndMeshFormat\n$Entities\n" + entities.bytes +
         "\n$EndEntities\n$Nodes\n" + nodes.bytes + "\n$EndNodes\n$Elements\n" + elements.bytes +
         "\n$EndElements\n";
}

inline std::string vtk_text() {
  return "# vtk DataFile Version 3.0\ntwo tetrahedra\nASCII\nDATASET UNSTRUCTURED_GRID\n"
         "POINTS 5 double\n0 0 0 8 0 0\n0 8 0 0 0 8\n7.5 7.25 -6.125\n"
         "CELLS 3 14\n3 0 1 2\n4 0 1 2 3\n4 4 2 1 3\nCELL_TYPES 3\n5\n10\n10\n"
         "POINT_DATA 5\nSCALARS heat float 1\nLOOKUP_TABLE default\n1 2 3 4 5\n"
         "CELL_DATA 3\nVECTORS flow float\n0 0 0 0 0 0 0 0 0\nSCALARS region int\nLOOKUP_TABLE default\n9 3 "
         "4\n";
}

inline std::string vtk_binary() {
  Packed points{true}, cells{true}, types{true}, region{true};
  for (const Vec3& x : two_tets().nodes) points.add(float(x.x())).add(float(x.y())).add(float(x.z()));
  for (int i : {4, 0, 1, 2, 3, 4, 4, 2, 1, 3}) cells.add(i);
  types.add(10).add(10);
  region.add(3).add(4);
  return "# vtk DataFile Version 3.0\ntwo tetrahedra\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n" +
         points.bytes + "\nCELLS 2 10\n" + cells.bytes + "\nCELL_TYPES 2\n" + types.bytes +
         "\nCELL_DATA 2\nFIELD FieldData 1\nregion 1 2 int\n" + region.bytes + "\n";
}

inline std::string vtk_5() {
  return "# vtk DataFile Version 5.1\ntwo tetrahedra\nASCII\nDATASET UNSTRUCTURED_GRID\n"
         "POINTS 5 double\n0 0 0 8 0 0 0 8 0 0 0 8 7.5 7.25 -6.125\nMETADATA\nINFORMATION 0\n\n"
         "CELLS 3 8\nOFFSETS vtktypeint64\n0 4 8\nCONNECTIVITY vtktypeint64\n0 1 2 3\n4 2 1 3\nCELL_TYPES "
         "2\n10\n10\n"
         "CELL_DATA 2\nSCALARS region double\nLOOKUP_TABLE default\n3.0 4.0\n";
}

inline std::string base64(const std::string& bytes) {
  static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63U];
  }
  return text;
}

enum class Vtu { text, base64, base64_apart, appended_base64, appended_raw };

inline std::string vtu(Vtu kind, bool wide = false) {
  std::string appended;
  const auto array = [&](const char* type, const char* name, const std::string& text,
                         const std::string& packed) {
    std::string out = std::string("<DataArray type=\"") + type + "\" Name=\"" + name +
                      "\" NumberOfComponents=\"" + (std::string(name) == "Points" ? "3" : "1") +
                      "\" format=\"";
    Packed head;
    if (wide)
      head.add(static_cast<std::uint64_t>(packed.size()));
    else
      head.add(static_cast<std::uint32_t>(packed.size()));
    const std::string joined = base64(head.bytes + packed);
    if (kind == Vtu::text) return out + "ascii\">\n" + text + "\n</DataArray>\n";
    if (kind == Vtu::base64) return out + "binary\">\n   " + joined + "\n</DataArray>\n";
    if (kind == Vtu::base64_apart)
      return out + "binary\">" + base64(head.bytes) + base64(packed) + "</DataArray>\n";
    out += "appended\" offset=\"" + std::to_string(appended.size()) + "\"/>\n";
    appended += kind == Vtu::appended_raw ? head.bytes + packed : joined;
    return out;
  };
  Packed points, connectivity, offsets, types, region;
  for (const Vec3& x : two_tets().nodes) points.add(x.x()).add(x.y()).add(x.z());
  for (std::int64_t i : {0, 1, 2, 3, 4, 2, 1, 3}) connectivity.add(i);
  offsets.add(std::int32_t{4}).add(std::int32_t{8});
  types.add(std::uint8_t{10}).add(std::uint8_t{10});
  region.add(std::int32_t{3}).add(std::int32_t{4});
  std::string file = std::string(
                         "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                         "byte_order=\"LittleEndian\" ") +
                     (wide ? "header_type=\"UInt64\"" : "") +
                     ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n";
  file += "<CellData>\n" + array("Int32", "region", "3 4", region.bytes) + "</CellData>\n";
  file += "<Points>\n" +
          array("Float64", "Points", "0 0 0\n8 0 0\n0 8 0\n0 0 8\n7.5 7.25 -6.125", points.bytes) +
          "</Points>\n<Cells>\n";
  file += array("Int64", "connectivity", "0 1 2 3\n4 2 1 3", connectivity.bytes) +
          array("Int32", "offsets", "4 8", offsets.bytes) + array("UInt8", "types", "10 10", types.bytes) +
          "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  if (!appended.empty()) {
    file += std::string("<AppendedData encoding=\"") + (kind == Vtu::appended_raw ? "raw" : "base64") +
            "\">\n_" + appended + "\n</AppendedData>\n";
  }
  return file + "</VTKFile>\n";
}

}  // namespace acus::io
