#include "acus/io/vtk_files.h"

#include <gtest/gtest.h>

#include <cstring>
#include <pugixml.hpp>

namespace acus::io {
namespace {

// Base64 by the letter table of RFC 4648, independent of the writer's shifts.
std::vector<unsigned char> decoded(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<bool> bits;
  for (char c : text)
    if (c != '=')
      for (int bit = 5; bit >= 0; --bit)
        bits.push_back(((letters.find(c) >> static_cast<unsigned>(bit)) & 1U) != 0);
  std::vector<unsigned char> bytes(bits.size() / 8, 0);
  for (std::size_t i = 0; i < bytes.size() * 8; ++i)
    bytes[i / 8] = static_cast<unsigned char>(2 * bytes[i / 8] + (bits[i] ? 1 : 0));
  return bytes;
}

template <class Value>
std::vector<Value> array_of(const pugi::xml_node& parent, const char* name) {
  const auto array = parent.find_child_by_attribute("DataArray", "Name", name);
  EXPECT_TRUE(array) << name;
  EXPECT_STREQ(array.attribute("format").value(), "binary");
  const auto bytes = decoded(array.text().get());
  std::uint64_t size = 0;
  EXPECT_GE(bytes.size(), sizeof size);
  std::memcpy(&size, bytes.data(), sizeof size);
  EXPECT_EQ(size, bytes.size() - sizeof size) << name;
  std::vector<Value> values(size / sizeof(Value));
  std::memcpy(values.data(), bytes.data() + sizeof size, size);
  return values;
}

mesh::TetMesh two_tetrahedra() {
  return {.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}},
          .tets = {{0, 1, 2, 3}, {1, 2, 3, 4}},
          .region = {0, 7}};
}

TEST(VtkFiles, tissue_carries_every_field_of_every_node_and_tetrahedron) {
  const mesh::TetMesh rest = two_tetrahedra();
  std::vector<Vec3> positions = rest.nodes, velocities(5, Vec3(0.1, 0.2, 0.3));
  positions[4] += Vec3(0.0, 0.25, -0.5);
  const std::vector<double> von_mises = {1234.5, 1e-3};
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(tissue_vtu({rest, positions, velocities, von_mises}).c_str()));

  const auto file = document.child("VTKFile");
  EXPECT_STREQ(file.attribute("type").value(), "UnstructuredGrid");
  EXPECT_STREQ(file.attribute("header_type").value(), "UInt64");
  const auto piece = file.child("UnstructuredGrid").child("Piece");
  EXPECT_EQ(piece.attribute("NumberOfPoints").as_int(), 5);
  EXPECT_EQ(piece.attribute("NumberOfCells").as_int(), 2);
  EXPECT_EQ(array_of<double>(piece.child("CellData"), "von_mises"), von_mises);
  EXPECT_EQ(array_of<std::int32_t>(piece.child("CellData"), "region"), rest.region);
  EXPECT_EQ(array_of<std::int32_t>(piece.child("Cells"), "connectivity"),
            (std::vector<std::int32_t>{0, 1, 2, 3, 1, 2, 3, 4}));
  EXPECT_EQ(array_of<std::int32_t>(piece.child("Cells"), "offsets"), (std::vector<std::int32_t>{4, 8}));
  EXPECT_EQ(array_of<std::uint8_t>(piece.child("Cells"), "types"), (std::vector<std::uint8_t>{10, 10}));
  const auto points = array_of<double>(piece.child("Points"), "points");
  const auto moved = array_of<double>(piece.child("PointData"), "displacement");
  const auto speeds = array_of<double>(piece.child("PointData"), "velocity");
  ASSERT_EQ(points.size(), 15U);
  ASSERT_EQ(speeds.size(), 15U);
  EXPECT_EQ(std::vector<double>(points.end() - 3, points.end()), (std::vector<double>{1.0, 1.25, 0.5}));
  EXPECT_EQ(std::vector<double>(moved.end() - 3, moved.end()), (std::vector<double>{0.0, 0.25, -0.5}));
  EXPECT_EQ(moved.front(), 0.0);
  EXPECT_EQ(speeds[14], 0.3);
}

TEST(VtkFiles, needle_is_one_line_through_all_its_points) {
  const std::vector<Vec3> line = {{0, 0, 3}, {0.5, 0, 2}, {0, 0, 1}};
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(needle_vtp(line).c_str()));
  const auto piece = document.child("VTKFile").child("PolyData").child("Piece");
  EXPECT_EQ(piece.attribute("NumberOfPoints").as_int(), 3);
  EXPECT_EQ(piece.attribute("NumberOfLines").as_int(), 1);
  EXPECT_EQ(array_of<double>(piece.child("Points"), "points"),
            (std::vector<double>{0, 0, 3, 0.5, 0, 2, 0, 0, 1}));
  EXPECT_EQ(array_of<std::int32_t>(piece.child("Lines"), "connectivity"),
            (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(array_of<std::int32_t>(piece.child("Lines"), "offsets"), (std::vector<std::int32_t>{3}));
}

TEST(VtkFiles, collection_names_each_file_with_its_time) {
  const std::vector<TimedFile> files = {{0.0, 0, "frames/tissue_000000.vtu"},
                                        {0.1, 1, "frames/needle_000001.vtp"}};
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(pvd(files).c_str()));
  std::vector<std::string> seen;
  for (const auto& entry : document.child("VTKFile").child("Collection").children("DataSet"))
    seen.push_back(entry.attribute("timestep").value() + std::string(" ") + entry.attribute("file").value());
  EXPECT_EQ(seen, (std::vector<std::string>{"0 frames/tissue_000000.vtu", "0.1 frames/needle_000001.vtp"}));
}

}  // namespace
}  // namespace acus::io
