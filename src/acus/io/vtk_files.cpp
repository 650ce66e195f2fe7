// Arrays are written as base64 inside the XML: a UInt64 with the number of bytes, then the bytes,
// little-endian.
#include "acus/io/vtk_files.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string_view>

#include "acus/base/decimal.h"

namespace acus::io {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say byte_order=\"LittleEndian\"");

constexpr int vtk_tetra = 10;  // the cell type's number in VTK

std::string joined(std::initializer_list<std::string_view> pieces) {
  std::string text;
  for (std::string_view piece : pieces) text += piece;
  return text;
}

std::string base64(const std::string& bytes) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t have = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = (word << 8U) | (k < have ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= have ? letters[(word >> (18 - 6 * k)) & 63U] : '=';
  }
  return text;
}

// One DataArray element; `type` names the C++ type Value in VTK's words.
template <class Value>
std::string data_array(const char* type, const char* name, int components, std::span<const Value> values) {
  const std::uint64_t bytes = values.size_bytes();
  std::string raw(sizeof bytes + bytes, '\0');
  std::memcpy(raw.data(), &bytes, sizeof bytes);
  if (bytes > 0) std::memcpy(raw.data() + sizeof bytes, values.data(), bytes);
  return joined({"<DataArray type=\"", type, "\" Name=\"", name, "\" NumberOfComponents=\"",
                 std::to_string(components), "\" format=\"binary\">", base64(raw), "</DataArray>\n"});
}

std::string numbers(const char* name, std::span<const double> values) {
  return data_array<double>("Float64", name, 1, values);
}
std::string vectors(const char* name, std::span<const Vec3> values) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const double* first = values.empty() ? nullptr : values.front().data();
  return data_array<double>("Float64", name, 3, {first, 3 * values.size()});
}
std::string integers(const char* name, std::span<const std::int32_t> values) {
  return data_array<std::int32_t>("Int32", name, 1, values);
}

std::string vtk_file(const char* type, const std::string& content) {
  return joined({"<?xml version=\"1.0\"?>\n<VTKFile type=\"", type,
                 "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<", type, ">\n",
                 content, "</", type, ">\n</VTKFile>\n"});
}

std::string tetrahedra(const std::vector<mesh::Tet>& tets) {
  std::vector<std::int32_t> nodes, ends;
  for (const mesh::Tet& tet : tets) {
    nodes.insert(nodes.end(), tet.begin(), tet.end());
    ends.push_back(static_cast<std::int32_t>(nodes.size()));
  }
  const std::vector<std::uint8_t> types(tets.size(), vtk_tetra);
  return "<Cells>\n" + integers("connectivity", nodes) + integers("offsets", ends) +
         data_array<std::uint8_t>("UInt8", "types", 1, types) + "</Cells>\n";
}

}  // namespace

std::string tissue_vtu(const TissueState& tissue) {
  std::vector<Vec3> displacements(tissue.positions.size());
  for (std::size_t i = 0; i < displacements.size(); ++i)
    displacements[i] = tissue.positions[i] - tissue.rest.nodes[i];
  return vtk_file(
      "UnstructuredGrid",
      joined({"<Piece NumberOfPoints=\"", std::to_string(tissue.positions.size()), "\" NumberOfCells=\"",
              std::to_string(tissue.rest.tets.size()), "\">\n<PointData Vectors=\"displacement\">\n",
              vectors("displacement", displacements), vectors("velocity", tissue.velocities),
              "</PointData>\n<CellData Scalars=\"von_mises\">\n", numbers("von_mises", tissue.von_mises),
              integers("region", tissue.rest.region), "</CellData>\n<Points>\n",
              vectors("points", tissue.positions), "</Points>\n", tetrahedra(tissue.rest.tets),
              "</Piece>\n"}));
}

std::string needle_vtp(std::span<const Vec3> line) {
  std::vector<std::int32_t> along(line.size());
  for (std::size_t i = 0; i < along.size(); ++i) along[i] = static_cast<std::int32_t>(i);
  const std::array<std::int32_t, 1> end = {static_cast<std::int32_t>(line.size())};
  return vtk_file(
      "PolyData",
      joined({"<Piece NumberOfPoints=\"", std::to_string(line.size()),
              "\" NumberOfVerts=\"0\" NumberOfLines=\"1\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
              "<Points>\n", vectors("points", line), "</Points>\n<Lines>\n", integers("connectivity", along),
              integers("offsets", end), "</Lines>\n</Piece>\n"}));
}

std::string pvd(std::span<const TimedFile> files) {
  std::string list;
  for (const TimedFile& entry : files)
    list += joined({"<DataSet timestep=\"", decimal_text(entry.time), "\" part=\"",
                    std::to_string(entry.part), "\" file=\"", entry.file, "\"/>\n"});
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n" + list +
         "</Collection>\n</VTKFile>\n";
}

}  // namespace acus::io
