#include "acus/io/mesh_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "tests/io/mesh_formats.h"

namespace acus::io {
namespace {

struct Format {
  const char* name;
  std::string bytes;
};

void PrintTo(const Format& format, std::ostream* out) { *out << format.name; }

std::vector<Format> formats() {
  return {{"gmsh_1", gmsh_1()},
          {"gmsh_2", gmsh_2()},
          {"gmsh_2_little_endian", gmsh_2_binary(false)},
          {"gmsh_2_big_endian", gmsh_2_binary(true)},
          {"gmsh_4", gmsh_4()},
          {"gmsh_4_binary", gmsh_4_binary()},
          {"vtk_text", vtk_text()},
          {"vtk_binary", vtk_binary()},
          {"vtk_5", vtk_5()},
          {"vtu_text", vtu(Vtu::text)},
          {"vtu_base64", vtu(Vtu::base64)},
          {"vtu_base64_wide_header", vtu(Vtu::base64, true)},
          {"vtu_base64_apart", vtu(Vtu::base64_apart)},
          {"vtu_appended_base64", vtu(Vtu::appended_base64)},
          {"vtu_appended_raw", vtu(Vtu::appended_raw, true)}};
}

class MeshFormat : public ::testing::TestWithParam<Format> {};

TEST_P(MeshFormat, gives_the_mesh_that_was_written) {
  const auto read = read_mesh_bytes(GetParam().bytes, "two_tets", 1.0);
  ASSERT_TRUE(read) << read.error().sentence;
  const mesh::TetMesh written = two_tets();
  EXPECT_EQ(read->nodes, written.nodes);
  EXPECT_EQ(read->tets, written.tets);
  EXPECT_EQ(read->region, written.region);
}

TEST_P(MeshFormat, comes_in_the_unit_of_the_file) {
  const auto read = read_mesh_bytes(GetParam().bytes, "two_tets", 1e-3);
  ASSERT_TRUE(read) << read.error().sentence;
  EXPECT_EQ(read->nodes[1], Vec3(8e-3, 0, 0));
}

// Every beginning of every format is either refused with a sentence, or so long that nothing of the mesh is
// missing.
TEST_P(MeshFormat, cut_short_anywhere_is_refused_with_a_sentence) {
  const std::string& bytes = GetParam().bytes;
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const auto read = read_mesh_bytes(std::string_view(bytes).substr(0, length), "cut", 1.0);
    if (read) {
      EXPECT_EQ(read->tets, two_tets().tets) << length;
      EXPECT_EQ(read->nodes, two_tets().nodes) << length;
    } else {
      EXPECT_EQ(read.error().sentence.rfind("cut:", 0), 0U) << read.error().sentence;
      EXPECT_LT(read.error().sentence.size(), 300U);
    }
  }
}

// One byte changed at a time: a mesh that passes is a sound one, everything else is a sentence.
TEST_P(MeshFormat, with_any_byte_changed_is_read_or_refused_but_never_unsound) {
  for (std::size_t i = 0; i < GetParam().bytes.size(); ++i) {
    for (char wrong : {'\0', ' ', '-', '9', '\n', '\xff'}) {
      std::string bytes = GetParam().bytes;
      bytes[i] = wrong;
      const auto read = read_mesh_bytes(bytes, "changed", 1.0);
      if (!read) {
        EXPECT_FALSE(read.error().sentence.empty());
        continue;
      }
      EXPECT_EQ(read->region.size(), read->tets.size());
      for (const mesh::Tet& t : read->tets) EXPECT_GT(signed_volume(*read, t), 0.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, MeshFormat, ::testing::ValuesIn(formats()),
                         [](const auto& param) { return std::string(param.param.name); });

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto found = text.find(what);
  EXPECT_NE(found, std::string::npos) << what;
  return text.replace(found, what.size(), by);
}

TEST(MeshFile, may_have_the_line_ends_of_windows) {
  for (std::string text : {gmsh_1(), gmsh_2(), gmsh_4(), vtk_text(), vtk_5(), vtu(Vtu::text)}) {
    for (std::size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n', i + 2))
      text.insert(i, 1, '\r');
    const auto read = read_mesh_bytes(text, "windows", 1.0);
    ASSERT_TRUE(read) << read.error().sentence;
    EXPECT_EQ(read->tets, two_tets().tets);
  }
}

TEST(MeshFile, may_begin_with_a_byte_order_mark_and_hold_sections_of_other_programs) {
  EXPECT_TRUE(read_mesh_bytes("\xEF\xBB\xBF" + gmsh_2(), "marked", 1.0));
  EXPECT_TRUE(read_mesh_bytes("$Comments\nby hand\n$EndComments\n" + gmsh_2(), "commented", 1.0));
}

TEST(MeshFile, turns_tetrahedra_round_and_drops_unused_nodes) {
  std::string text = replaced(gmsh_2(), "1 2 3 4\n3", "2 1 3 4\n3");
  text = replaced(replaced(text, "$Nodes\n5", "$Nodes\n6"), "5 7.5", "77 1 1 1\n5 7.5");
  const auto read = read_mesh_bytes(text, "mended", 1.0);
  ASSERT_TRUE(read) << read.error().sentence;
  EXPECT_EQ(read->nodes, two_tets().nodes);
  EXPECT_GT(signed_volume(*read, read->tets[0]), 0.0);
}

TEST(MeshFile, takes_quadratic_tetrahedra_by_their_corners) {
  const std::string quadratic =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n1 0 0 0\n2 2 0 0\n3 0 2 0\n4 0 0 2\n5 1 0 0\n6 1 1 "
      "0\n7 0 1 0\n"
      "8 0 0 1\n9 0 1 1\n10 1 0 1\n$EndNodes\n$Elements\n1\n1 11 2 1 1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n";
  const auto read = read_mesh_bytes(quadratic, "quadratic", 1.0);
  ASSERT_TRUE(read) << read.error().sentence;
  EXPECT_EQ(read->nodes.size(), 4U);
  EXPECT_DOUBLE_EQ(total_volume(*read), 8.0 / 6.0);
}

// Files that Gmsh 4.8 and meshio 5.0 wrote of one mesh: a box of 10 x 10 x 10 in region 7 under one of 10 x
// 10 x 5 in 8.
TEST(MeshFile, written_by_gmsh_and_meshio_is_the_same_mesh_in_every_format) {
  const std::string folder = ACUS_SOURCE_DIR "/tests/fixtures/meshes/";
  const auto first = read_mesh(folder + "gmsh_41.msh", 1e-3);
  ASSERT_TRUE(first) << first.error().sentence;
  for (const char* name : {"gmsh_1.msh", "gmsh_22.msh", "gmsh_22_binary.msh", "gmsh_41_binary.msh",
                           "gmsh.vtk", "gmsh_binary.vtk", "meshio_42_binary.vtk", "meshio_51.vtk",
                           "meshio_51_binary.vtk", "meshio.vtu", "meshio_base64.vtu"}) {
    const auto read = read_mesh(folder + name, 1e-3);
    ASSERT_TRUE(read) << read.error().sentence;
    EXPECT_EQ(read->tets, first->tets) << name;
    EXPECT_EQ(read->region, first->region) << name;
    ASSERT_EQ(read->nodes.size(), first->nodes.size()) << name;
    for (std::size_t n = 0; n < read->nodes.size(); ++n)
      EXPECT_LT((read->nodes[n] - first->nodes[n]).norm(), 1e-15) << name;
    double volume[2] = {0.0, 0.0};
    for (std::size_t t = 0; t < read->tets.size(); ++t)
      volume[read->region[t] - 7] += signed_volume(*read, read->tets[t]);
    EXPECT_NEAR(volume[0], 1e-6, 1e-18) << name;
    EXPECT_NEAR(volume[1], 0.5e-6, 1e-18) << name;
  }
  const auto packed = read_mesh(folder + "meshio_packed.vtu", 1e-3);
  ASSERT_FALSE(packed);
  EXPECT_NE(packed.error().sentence.find("packed by \"vtkZLibDataCompressor\""), std::string::npos)
      << packed.error().sentence;
}

struct Known {
  const char* file;
  std::size_t nodes, tets;
  double volume;  // cubic units of the file; 0 where nothing outside says it
};

TEST(MeshFile, from_other_projects_is_read_whole) {
  const char* given = std::getenv("ACUS_DATA");  // see CONTRIBUTING.md
  if (given == nullptr) GTEST_SKIP() << "ACUS_DATA names no folder of other projects' meshes";
  const std::string folder = given;
  // Counts as the files themselves state them; volumes of boxes from their sides.
  const Known known[] = {{"meshes/liver.msh", 181, 596, 0.0},
                         {"meshes/liver2.msh", 507, 1493, 0.0},
                         {"meshes/msh4_cube.msh", 14, 24, 1.0},
                         {"meshes/Armadillo_Tetra_4406.vtu", 1446, 4406, 0.0},
                         {"peer_block/block_1k.msh", 320, 980, 0.0006},
                         {"peer_block/block_5k.msh", 1352, 5040, 0.0006},
                         {"embedded_needle/block_2k.msh", 567, 1920, 0.0006},
                         {"embedded_needle/graded_12k.msh", 2925, 11760, 0.0006}};
  for (const Known& k : known) {
    const auto read = read_mesh(folder + "/" + k.file, 1.0);
    ASSERT_TRUE(read) << read.error().sentence;
    EXPECT_EQ(read->nodes.size(), k.nodes) << k.file;
    EXPECT_EQ(read->tets.size(), k.tets) << k.file;
    if (k.volume > 0.0) {
      EXPECT_NEAR(total_volume(*read), k.volume, 1e-12 * k.volume) << k.file;
    }
  }
  const auto hexahedra = read_mesh(folder + "/meshes/nine_hexa.msh", 1.0);
  ASSERT_FALSE(hexahedra);
  EXPECT_NE(hexahedra.error().sentence.find("no tetrahedra, only 9 hexahedra"), std::string::npos);
  const auto hinged = read_mesh(folder + "/meshes/6_tetra_bad.msh", 1.0);
  ASSERT_FALSE(hinged);
  EXPECT_NE(hinged.error().sentence.find("6_tetra_bad.msh:27: element 44 and 4 more share no face"),
            std::string::npos)
      << hinged.error().sentence;
}

struct Wrong {
  std::string bytes;
  std::vector<const char*> words;
};

// Each sentence: where, what is wrong, what would be right.
std::vector<Wrong> wrong_files() {
  const std::string vtu_text = vtu(Vtu::text);
  return {
      {"", {"wrong.msh: the file is empty", "expected Gmsh"}},
      {"solid cube\nfacet normal 0 0 1\n", {"no mesh that can be read", "\"solid\"", "meshio"}},
      {std::string("\xFF\xFE$\0M\0", 6), {"UTF-16", "UTF-8"}},
      {std::string("\0\0\0\0\0\0", 6), {"no mesh that can be read", "\"??????\""}},
      {"$Bogus\n1\n", {"wrong.msh:1: section \"$Bogus\" does not end", "\"$EndBogus\""}},
      {replaced(gmsh_2(), "2.2 0 8", "4.0 0 8"), {"wrong.msh:2", "format \"4.0\" is not read", "2.2 or 4.1"}},
      {replaced(gmsh_2(), "2.2 0 8", "2.2 0 4"), {"wrong.msh:2", "numbers of 4 bytes"}},
      {replaced(gmsh_2(), "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", ""), {"$Nodes comes before $MeshFormat"}},
      {replaced(gmsh_2(), "$Nodes\n5", "$Nodes\n99999999999"),
       {"wrong.msh:9", "the number of nodes is 99999999999, but only"}},
      {replaced(gmsh_2(), "$Nodes\n5", "$Nodes\n99999999999999999999999"), {"wrong.msh:9", "is too large"}},
      {replaced(gmsh_2(), "$Nodes\n5", "$Nodes\n-5"), {"wrong.msh:9", "is -5; it cannot be negative"}},
      {replaced(gmsh_2(), "$Nodes\n5", "$Nodes\n6"),
       {"wrong.msh:15", "\"$EndNodes\"", "the number of node 6 of 6"}},
      {replaced(gmsh_2(), "$Nodes\n5", "$Nodes\n4"),
       {"wrong.msh:14", "found \"5\" where $EndNodes should be"}},
      {replaced(gmsh_2(), "3 0 8 0", "3 0 nan 0"),
       {"wrong.msh:12", "node 3 has a coordinate that is not a finite number"}},
      {replaced(gmsh_2(), "3 0 8 0", "3 0 1e999 0"),
       {"wrong.msh:12", "node 3 has a coordinate that is not a finite number"}},
      {replaced(gmsh_2(), "3 0 8 0", "3 0 8"),
       {"wrong.msh:12", "the line is too short", "the z coordinate of node 3"}},
      {replaced(gmsh_2(), "3 0 8 0", "3 0 8,0 0"),
       {"wrong.msh:12", "\"8,0\" is not a number", "the y coordinate of node 3"}},
      {replaced(gmsh_2(), "3 0 8 0", "3 0 8 0 7"),
       {"wrong.msh:12", "\"7\" is more than belongs on this line"}},
      {replaced(gmsh_2(), "3 0 8 0", "2 0 8 0"), {"wrong.msh:12", "node number 2 is given twice"}},
      {replaced(gmsh_2(), "3 0 8 0", "-3 0 8 0"), {"wrong.msh:12", "node number -3 is not positive"}},
      {replaced(gmsh_2(), "3 0 8 0", "3 0 1e30 0"), {"wrong.msh:12", "node 3 lies more than 1e6 m", "unit"}},
      {replaced(gmsh_2(), "$Elements\n3", "$Elements\n4"),
       {"wrong.msh:21", "\"$EndElements\"", "element 4 of 4"}},
      {replaced(gmsh_2(), "$EndElements\n", ""), {"cut short", "expected $EndElements"}},
      {replaced(gmsh_2(), "5 3 2 4", "5 3 2 9"),
       {"wrong.msh:20", "element 3 uses node 9, which the file does not have"}},
      {replaced(gmsh_2(), "5 3 2 4", "5 3 2 2"),
       {"wrong.msh:20", "element 3 has the same node at two corners"}},
      {replaced(gmsh_2(), "5 3 2 4", "5 3 2"),
       {"wrong.msh:20", "the line is too short", "node 4 of element 3"}},
      {replaced(gmsh_2(), "5 3 2 4", "5 3 2 4 1"),
       {"wrong.msh:20", "\"1\" is more than belongs on this line"}},
      {replaced(gmsh_2(), "3 4 2 4 1 5", "3 99 2 4 1 5"),
       {"wrong.msh:20", "element 3 is of type 99", "type 4"}},
      {replaced(gmsh_2(), "3 4 2 4 1 5", "3 4 99999999999 4 1 5"),
       {"wrong.msh:20", "the number of tags of element 3 is 99999999999"}},
      {replaced(gmsh_2(), "3 4 2 4 1 5", "3 4 2 99999999999 1 5"),
       {"wrong.msh:20", "region 99999999999, which is too large"}},
      {replaced(gmsh_2(), "3 4 2 4 1 5", "3 4 2 -9223372036854775808 1 5"),
       {"wrong.msh:20", "region -9223372036854775808, which is too large"}},
      {replaced(gmsh_2(), "5 7.5 7.25 -6.125", "5 4 4 0"), {"wrong.msh:20", "element 3 is flat"}},
      {replaced(gmsh_2(), "5 7.5 7.25 -6.125", "5 1 1 1"),
       {"wrong.msh:20: element 3 overlaps wrong.msh:19: element 2"}},
      {replaced(gmsh_2(), "3\n1 2 2 9 9 1 2 3\n2 4 2 3 1 1 2 3 4\n3 4 2 4 1 5 3 2 4", "1\n1 2 2 9 9 1 2 3"),
       {"wrong.msh: the mesh has no tetrahedra, only 1 triangles", "Mesh, 3D"}},
      {replaced(gmsh_1(), "$ENDNOD\n", ""), {"wrong.msh:8", "found \"$ELM\" where $ENDNOD should be"}},
      {replaced(gmsh_1(), "3 4 4 1 4 5", "3 4 4 1 3 5"),
       {"wrong.msh:13", "element 3 has 3 nodes", "its type has 4"}},
      {replaced(gmsh_4(), "$Nodes\n2 5 1 5", "$Nodes\n3 5 1 5"),
       {"wrong.msh:24", "\"$EndNodes\"", "dimension of a block of nodes"}},
      {replaced(gmsh_4(), "3 1 0 4", "3 1 0 4000000"),
       {"wrong.msh:12", "the number of nodes of a block is 4000000"}},
      {replaced(gmsh_4(), "2 1 2 3 4", "2 1 2 3 40"), {"wrong.msh:30: element 2 uses node 40"}},
      {replaced(gmsh_2_binary(false), "2.2 1 8\n\x01", "2.2 1 8\n\x02"),
       {"wrong.msh: the number 1 that tells the order of bytes"}},
      {replaced(vtk_text(), "UNSTRUCTURED_GRID", "STRUCTURED_POINTS"),
       {"wrong.msh:4", "\"STRUCTURED_POINTS\"", "expected UNSTRUCTURED_GRID"}},
      {replaced(vtk_text(), "ASCII", "EBCDIC"), {"wrong.msh:3", "\"EBCDIC\" where ASCII or BINARY"}},
      {replaced(vtk_text(), "VECTORS flow float", "GLYPHS flow float"),
       {"found \"GLYPHS\", which is no attribute of a VTK file"}},
      {replaced(vtk_text(), "POINTS 5 double", "POINTS 5 complex"),
       {"wrong.msh:5", "\"complex\" is not a type of number"}},
      {replaced(vtk_text(), "POINTS 5 double", "POINTS 6 double"),
       {"wrong.msh:9", "\"CELLS\" is not a number", "point 5"}},
      {replaced(vtk_text(), "CELLS 3 14", "CELLS 3 15"), {"CELLS has 14 entries, but promises 15"}},
      {replaced(vtk_text(), "CELL_TYPES 3\n5\n", "CELL_TYPES 2\n"), {"3 cells, but 2 cell types"}},
      {replaced(vtk_text(), "4 4 2 1 3", "4 4 2 1 5"), {"wrong.msh:12: cell 2 uses point 5"}},
      {replaced(vtk_text(), "9 3 4", "9 3 4.5"), {"wrong.msh:26", "region number is not whole"}},
      {replaced(vtk_text(), "CELLS 3", "CELS 3"), {"wrong.msh:9", "\"CELS\" where POINTS, CELLS"}},
      {replaced(vtk_5(), "0 4 8\n", "0 4 9\n"), {"cell 1 ends at entry 9 of the connectivity, which has 8"}},
      {replaced(vtk_5(), "0 4 8\n", "0 -4 8\n"), {"cell 0 ends at entry -4"}},
      {replaced(vtk_5(), "10\n10\n", "10\n14\n"), {"cell 1 of type 14 (pyramids) has 4 points; it needs 5"}},
      {replaced(vtu_text, "</Piece>", ""), {"wrong.msh:", "this is not XML"}},
      {replaced(vtu_text, "<UnstructuredGrid>", "<PolyData>"), {"wrong.msh:", "this is not XML"}},
      {replaced(vtu_text, "byte_order", "compressor=\"vtkZLibDataCompressor\" byte_order"),
       {"wrong.msh:2", "packed by \"vtkZLibDataCompressor\"", "meshio"}},
      {replaced(vtu_text, "NumberOfPoints=\"5\"", "NumberOfPoints=\"6\""),
       {"wrong.msh:17", "cut short", "the x coordinate of point 5"}},
      {replaced(vtu_text, "NumberOfPoints=\"5\"", "NumberOfPoints=\"4\""),
       {"wrong.msh:15", "more numbers than its piece promises"}},
      {replaced(vtu_text, "NumberOfPoints=\"5\"", "NumberOfPoints=\"many\""),
       {"wrong.msh:4", "\"many\" is not a whole number", "NumberOfPoints"}},
      {replaced(vtu_text, "\"connectivity\"", "\"links\""),
       {"wrong.msh:19", "<Cells> has no DataArray \"connectivity\""}},
      {replaced(vtu_text, "Float64", "Float128"), {"wrong.msh:11", "\"Float128\" is not a type of number"}},
      {replaced(vtu_text, "8 0 0", "8 inf 0"),
       {"wrong.msh:13", "point 1 has a coordinate that is not a finite number"}},
      {replaced(vtu_text, "4 2 1 3", "4 2 1 -3"), {"cell 1 uses point -3"}},
      {replaced(vtu(Vtu::base64), "NumberOfPoints=\"5\"", "NumberOfPoints=\"7\""),
       {"wrong.msh:11", "cut short", "point 5"}},
      {replaced(vtu(Vtu::appended_raw), "offset=\"12\"", "offset=\"99999\""),
       {"the data at offset 99999 are missing"}},
  };
}

TEST(WrongMeshFile, is_refused_with_a_sentence_that_says_where_and_why) {
  const auto files = wrong_files();
  EXPECT_GE(files.size(), 25U);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto read = read_mesh_bytes(files[i].bytes, "wrong.msh", 1.0);
    ASSERT_FALSE(read) << i << '\n' << files[i].bytes;
    EXPECT_EQ(read.error().sentence.find('\n'), std::string::npos) << "one line";
    for (const char* words : files[i].words) {
      EXPECT_NE(read.error().sentence.find(words), std::string::npos)
          << i << ": " << words << "\n  not in: " << read.error().sentence;
    }
  }
}

TEST(WrongMeshFile, need_not_exist) {
  const auto none = read_mesh("/nowhere/liver.msh", 1.0);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().sentence.find("/nowhere/liver.msh: there is no such file"), std::string::npos);
  EXPECT_FALSE(read_mesh(ACUS_SOURCE_DIR, 1.0));
  EXPECT_FALSE(read_mesh("/dev/zero", 1.0));
}

TEST(WrongMeshFile, has_no_unit_of_zero_or_nan) {
  for (double unit : {0.0, -1.0, std::nan("")}) EXPECT_FALSE(read_mesh_bytes(gmsh_2(), "unit", unit));
}

}  // namespace
}  // namespace acus::io
