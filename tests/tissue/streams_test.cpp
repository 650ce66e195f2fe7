// Streams are to change who adds up, and nothing else. What is added here are whole numbers, so that sums are
// exact in any order.
#include "acus/tissue/streams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "acus/mesh/block.h"
#include "acus/mesh/order.h"

namespace acus::tissue {
namespace {

mesh::TetMesh ordered(int tetrahedra) {
  return mesh::ordered_for_locality(mesh::build_graded_block({0.1, 0.1, 0.05}, tetrahedra).value());
}
mesh::TetMesh shuffled(int tetrahedra) {
  mesh::TetMesh mesh = ordered(tetrahedra);
  std::shuffle(mesh.tets.begin(), mesh.tets.end(), std::mt19937(7));
  return mesh;
}

// Every element adds its number and one to its corners, and so twice.
void expect_exact_sums(const mesh::TetMesh& mesh) {
  const Streams streams = build_streams(mesh.tets, mesh.nodes.size());
  const std::size_t size = numeric::node_stride * mesh.nodes.size();
  numeric::NodeVector expected(size, 0.0), found(size, 0.0);
  for (std::size_t e = 0; e < mesh.tets.size(); ++e)
    for (const int node : mesh.tets[e]) expected[numeric::node_stride * node] += 2.0 * (e + 1.0);
  for (const int threads : {1, 2, 5}) {
    const Team team(threads);
    numeric::NodeVector parts(streams.count() * size, 0.0);
    const auto add = [&](double* to, numeric::Range elements, int) {
      for (std::size_t e = elements.first; e < elements.last; ++e)
        for (const int node : mesh.tets[e]) to[numeric::node_stride * node] += e + 1.0;
    };
    streams.add(parts, team, add);
    streams.sum(parts, team, [](double*, numeric::Range, int) {});  // left to be added to
    streams.add(parts, team, add);
    streams.sum(parts, team, [&](double* sum, numeric::Range nodes, int) {
      for (std::size_t i = numeric::node_stride * nodes.first; i < numeric::node_stride * nodes.last; ++i)
        found[i] = std::exchange(sum[i], 0.0);
    });
    EXPECT_EQ(found, expected);
    EXPECT_EQ(std::count(parts.begin(), parts.end(), 0.0), static_cast<std::ptrdiff_t>(parts.size()));
  }
}

TEST(Streams, add_up_what_one_would_have_added) {
  EXPECT_EQ(build_streams(ordered(1000).tets, ordered(1000).nodes.size()).count(), 1);
  expect_exact_sums(ordered(1000));
  expect_exact_sums(ordered(20000));
  expect_exact_sums(shuffled(20000));
}

// What makes them cheap: in a mesh ordered for locality most nodes get something from few of them.
TEST(Streams, share_few_nodes) {
  const mesh::TetMesh mesh = ordered(40000);
  const Streams streams = build_streams(mesh.tets, mesh.nodes.size());
  EXPECT_EQ(streams.count(), most_streams);
  double added = 0.0;
  for (const Streams::Run& run : streams.runs)
    added += static_cast<double>(run.nodes.size()) * __builtin_popcount(run.adding);
  EXPECT_LT(added / static_cast<double>(mesh.nodes.size()), 2.5);
}

}  // namespace
}  // namespace acus::tissue
