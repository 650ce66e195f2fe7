// Pairs against what they must be: every tetrahedron once, its corners turned but not turned over, two of a
// pair on either side of a face that they share.
#include "acus/tissue/pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "acus/mesh/block.h"
#include "acus/mesh/order.h"
#include "acus/tissue/tissue_model.h"

namespace acus::tissue {
namespace {

mesh::TetMesh block(int tetrahedra) {
  return mesh::ordered_for_locality(mesh::build_graded_block({0.1, 0.1, 0.05}, tetrahedra).value());
}
mesh::TetMesh apart(int tetrahedra) {
  mesh::TetMesh mesh;
  for (int e = 0; e < tetrahedra; ++e) {
    mesh.nodes.insert(mesh.nodes.end(), {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()});
    mesh.tets.push_back({4 * e, 4 * e + 1, 4 * e + 2, 4 * e + 3});
  }
  return mesh;
}
std::set<int> nodes_of(const mesh::Tet& t) { return {t.begin(), t.end()}; }

// Returns how many tetrahedra have no partner.
int expect_sound(const mesh::TetMesh& mesh) {
  const Pairing pairing = pair_up(mesh.tets);
  EXPECT_EQ(pairing.corners.size() % batch_elements, 0U);
  EXPECT_EQ(pairing.element.size(), mesh.tets.size());
  std::set<int> elements;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const int e = pairing.element[t];
    elements.insert(e);
    EXPECT_EQ(pairing.tet[e], static_cast<int>(t));
    EXPECT_EQ(nodes_of(pairing.corners[e]), nodes_of(mesh.tets[t]));
    EXPECT_GT(mesh::signed_volume(mesh, pairing.corners[e]), 0.0);
  }
  EXPECT_EQ(elements.size(), mesh.tets.size());
  int alone = 0;
  for (std::size_t pair = 0; pair < pairing.corners.size() / 2; ++pair) {
    const std::size_t one = element_of_pair(pair, 0), other = element_of_pair(pair, 1);
    const mesh::Tet &a = pairing.corners[one], &b = pairing.corners[other];
    EXPECT_EQ((mesh::Tet{a[0], a[2], a[1]}), (mesh::Tet{b[0], b[1], b[2]}));
    const bool both = pairing.tet[one] != pairing.tet[other];
    EXPECT_EQ(both, a[3] != b[3]);
    if (!both && elements.count(static_cast<int>(one)) != 0) ++alone;
  }
  return alone;
}

TEST(Pairs, leave_few_tetrahedra_of_a_block_alone) {
  for (const int tetrahedra : {100, 1000, 10000, 40000}) {
    const mesh::TetMesh mesh = block(tetrahedra);
    EXPECT_LT(expect_sound(mesh), 2 + static_cast<int>(mesh.tets.size()) / 100) << tetrahedra;
  }
}

TEST(Pairs, stand_any_order_and_any_numbering) {
  mesh::TetMesh mesh = block(3000);
  std::shuffle(mesh.tets.begin(), mesh.tets.end(), std::mt19937(3));
  for (mesh::Tet& t : mesh.tets) t = {t[1], t[2], t[0], t[3]};
  EXPECT_LT(expect_sound(mesh), 30);
}

TEST(Pairs, of_what_has_no_neighbour_are_itself) {
  EXPECT_EQ(expect_sound(apart(1)), 1);
  EXPECT_EQ(expect_sound(apart(33)), 33);
}

// Such a mesh folds over itself: seen from their face both lie on the same side.
TEST(Pairs, are_not_made_across_a_fold) {
  mesh::TetMesh mesh;
  mesh.nodes = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), Vec3(0.2, 0.2, 2.0)};
  mesh.tets = {{0, 1, 2, 3}, {0, 1, 2, 4}};
  EXPECT_EQ(expect_sound(mesh), 2);
}

// Such a mesh is refused where it comes from a file, but nothing may break.
TEST(Pairs, stand_faces_that_many_share) {
  mesh::TetMesh mesh;
  mesh.nodes = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};
  for (int i = 0; i < 12; ++i) {
    const double up = i % 2 == 0 ? 1.0 + i : -1.0 - i;
    mesh.nodes.emplace_back(0.2, 0.2, up);
    mesh.tets.push_back(up > 0.0 ? mesh::Tet{0, 1, 2, 3 + i} : mesh::Tet{0, 2, 1, 3 + i});
  }
  expect_sound(mesh);
}

// What fills the batches has no volume.
TEST(Pairs, of_a_model_have_the_volume_of_the_mesh) {
  const Material soft{.youngs_modulus = 1e4, .poisson_ratio = 0.4, .density = 1e3};
  for (const mesh::TetMesh& mesh : {apart(1), apart(16), apart(33), block(1000), block(8000)}) {
    const auto model = build_tissue_model(mesh, std::vector<Material>(mesh.tets.size(), soft),
                                          ElementKind::nodal_pressure, static_cast<int>(mesh.nodes.size()));
    ASSERT_TRUE(model.ok());
    const double whole = mesh::total_volume(mesh);
    EXPECT_NEAR(std::accumulate(model->volume.begin(), model->volume.end(), 0.0), whole, 1e-12 * whole);
    EXPECT_NEAR(std::accumulate(model->exact.quarter_volume.begin(), model->exact.quarter_volume.end(), 0.0),
                0.25 * whole, 1e-12 * whole);
  }
}

// Adding to a node waits for who adds to it just before; dealt like cards, the pairs of a batch are apart.
TEST(Pairs, of_a_batch_share_few_nodes) {
  const mesh::TetMesh mesh = block(20000);
  const Pairing pairing = pair_up(mesh.tets);
  std::size_t all = 0, different = 0;
  for (std::size_t first = 0; first < pairing.corners.size(); first += batch_elements) {
    std::set<int> seen;
    for (std::size_t p = 0; p < batch_pairs; ++p) {
      std::set<int> of_pair = nodes_of(pairing.corners[first + p]);
      of_pair.merge(nodes_of(pairing.corners[first + batch_pairs + p]));
      all += of_pair.size();
      seen.merge(of_pair);
    }
    different += seen.size();
  }
  EXPECT_GT(static_cast<double>(different), 0.9 * static_cast<double>(all));  // neighbours: a quarter of them
}

}  // namespace
}  // namespace acus::tissue
