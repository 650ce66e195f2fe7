// Tissue against the closed forms of elasticity: uniaxial compression, vibrating bars, a bent cantilever.
#include <gtest/gtest.h>

#include <numbers>

#include "acus/mesh/surface.h"
#include "tests/tissue/irregular_block.h"
#include "tests/tissue/tissue_driver.h"

namespace acus::tissue {
namespace {

class ClosedForms : public BothElements {};
ACUS_FOR_BOTH_ELEMENTS(ClosedForms);

// Compressed by a stress at top and bottom with free sides, every point moves by
// (-nu e x, -nu e y, e z), e = stress / E. The nodal forces are a third of each loaded triangle's.
TEST_P(ClosedForms, block_compressed_between_smooth_plates_shrinks_and_bulges_as_hooke_says) {
  for (const Material& material : {soft, firm}) {
    const HeldMesh held = held_mesh(irregular_block(), nowhere);
    BareTissue tissue(held, material, GetParam());
    const double strain = -1e-3, stress = material.youngs_modulus * strain;
    for (const mesh::Triangle& t : mesh::boundary_triangles(held.mesh)) {
      const Vec3 &a = tissue.rest[t[0]], &b = tissue.rest[t[1]], &c = tissue.rest[t[2]];
      const Vec3 area = 0.5 * (b - a).cross(c - a);
      if (std::abs(area.z()) < 1e-9 * area.norm()) continue;
      for (int node : t) numeric::at(tissue.load, node).z() += stress * area.z() / 3.0;
    }
    // Nothing is held, so the motion is known up to a rigid one: take differences and their symmetric part.
    const numeric::NodeVector u = tissue.linear_answer(tissue.load);
    const Vec3 expected = strain * Vec3(-material.poisson_ratio, -material.poisson_ratio, 1.0);
    for (const mesh::Tet& t : held.mesh.tets) {
      Mat3 edges, moved;
      for (int i = 0; i < 3; ++i) {
        edges.col(i) = tissue.rest[t[i + 1]] - tissue.rest[t[0]];
        moved.col(i) = numeric::at(u, t[i + 1]) - numeric::at(u, t[0]);
      }
      const Mat3 gradient = moved * edges.inverse();
      const Mat3 sym = 0.5 * (gradient + gradient.transpose());
      EXPECT_LT((sym - Mat3(expected.asDiagonal())).norm(), 1e-9 * std::abs(strain));
    }
  }
}

// A bar along z, held at z = 0, of `cells` boxes.
HeldMesh bar(const Vec3& size, const std::array<int, 3>& cells) {
  return held_mesh(mesh::build_block(size, cells), at_bottom);
}

// Angular frequency of the vibration that starts from `shape` times `amplitude`, timed by the first five
// sign changes of its projection on the shape.
double frequency(BareTissue& tissue, const std::function<Vec3(const Vec3&)>& shape, double amplitude,
                 double h) {
  const auto project = [&] {
    double sum = 0.0;
    for (int i = 0; i < tissue.model.free_nodes; ++i)
      sum += tissue.model.node_mass[i] * shape(tissue.rest[i]).dot(tissue.position[i] - tissue.rest[i]);
    return sum;
  };
  for (int i = 0; i < tissue.model.free_nodes; ++i) tissue.position[i] += amplitude * shape(tissue.rest[i]);
  corotate_into(tissue.corotation, tissue.model, tissue.position);
  tissue.relative_residual = 1e-8;
  std::vector<double> crossings;
  double before = project();
  for (int step = 1; crossings.size() < 5 && step < 4000; ++step) {
    tissue.step(h);
    const double now = project();
    if (before * now < 0.0) crossings.push_back(h * (step - now / (now - before)));
    before = now;
  }
  EXPECT_EQ(crossings.size(), 5U);
  return 4.0 * std::numbers::pi / (crossings.back() - crossings.front());
}

constexpr Material corklike = {25e3, 0.0, 1000.0};
constexpr double bar_length = 0.1;  // m

TEST_P(ClosedForms, bar_vibrates_along_its_axis_at_its_first_mode) {
  const double exact = 0.5 * std::numbers::pi / bar_length * std::sqrt(25e3 / 1000.0);  // rad/s, c pi / (2 L)
  const double h = 2.0 * std::numbers::pi / exact / 200.0;
  BareTissue tissue(bar(Vec3(0.01, 0.01, bar_length), {2, 2, 20}), corklike, GetParam());
  const auto shape = [](const Vec3& x) {
    return Vec3(0.0, 0.0, std::sin(0.5 * std::numbers::pi * x.z() / bar_length));
  };
  EXPECT_NEAR(frequency(tissue, shape, 1e-5, h) / exact, 1.0, 2e-3);
}

// The frequency of the mode nearest to `shape`: Rayleigh's quotient after two inverse iterations.
double mode_frequency(BareTissue& tissue, const std::function<Vec3(const Vec3&)>& shape) {
  tissue.relative_residual = 1e-8;
  const auto times_mass = [&](numeric::NodeVector v) {
    for (int i = 0; i < tissue.model.free_nodes; ++i) numeric::at(v, i) *= tissue.model.node_mass[i];
    return v;
  };
  numeric::NodeVector mode(tissue.velocity.size(), 0.0);
  for (int i = 0; i < tissue.model.free_nodes; ++i) numeric::at(mode, i) = shape(tissue.rest[i]);
  for (int i = 0; i < 2; ++i) mode = tissue.linear_answer(times_mass(mode));
  return std::sqrt(numeric::dot(mode, tissue.times_matrix(mode)) / numeric::dot(mode, times_mass(mode)));
}

// Torsion of a square bar: c = sqrt(G J / (rho I_p)) with J = 0.140577 a^4 (Saint-Venant; Timoshenko and
// Goodier, Theory of Elasticity, art. 109) and I_p = a^4 / 6.
TEST_P(ClosedForms, bar_twists_at_its_first_shear_mode) {
  const double c = std::sqrt(12.5e3 / 1000.0 * 0.140577 * 6.0);  // m/s
  const double exact = 0.5 * std::numbers::pi / bar_length * c;
  const auto shape = [](const Vec3& x) {
    return Vec3(std::sin(0.5 * std::numbers::pi * x.z() / bar_length) * Vec3(-x.y(), x.x(), 0.0));
  };
  double error_before = 0.0;
  for (int across : {2, 4, 8}) {
    BareTissue tissue(bar(Vec3(0.01, 0.01, bar_length), {across, across, 10 * across}), corklike, GetParam());
    const double error = mode_frequency(tissue, shape) / exact - 1.0;
    if (across > 2) {
      EXPECT_LT(std::abs(error), 0.5 * std::abs(error_before));
    }
    error_before = error;
  }
  EXPECT_LT(std::abs(error_before), 0.04);  // eight boxes across
}

// Tip of a cantilever under a dead transverse load P = 3 EI / L^2 at its end, from the elastica: moved across
// and along by these shares of its length (Mattiasson 1981, Int. J. Numer. Methods Eng. 17, 145-153).
constexpr double elastica_load = 3.0, elastica_transverse = 0.60325, elastica_shortening = 0.25442;

struct Tip {
  double transverse = 0.0, shortening = 0.0;  // of the length
};
// A strip ten times as long as thick and half as wide, so that it does not fall over sideways; brought to
// rest by heavy damping.
Tip bent_tip(ElementKind kind, int across) {
  const double thickness = 0.005, width = 0.5 * thickness, length = 0.05;
  BareTissue tissue(bar(Vec3(thickness, width, length), {across, across / 2, 10 * across}), corklike, kind);
  const double rigidity = corklike.youngs_modulus * width * std::pow(thickness, 3) / 12.0;
  const auto at_end = [&](int i) { return tissue.rest[i].z() > length - 1e-9; };
  double end_mass = 0.0;
  for (int i = 0; i < tissue.model.free_nodes; ++i)
    if (at_end(i)) end_mass += tissue.model.node_mass[i];
  const double force = elastica_load * rigidity / (length * length);
  for (int i = 0; i < tissue.model.free_nodes; ++i)
    if (at_end(i)) numeric::at(tissue.load, i).x() = force * tissue.model.node_mass[i] / end_mass;
  tissue.relative_residual = 1e-5;
  for (int step = 0; step < 100; ++step) tissue.step(1e-2, {20.0, 0.0});  // some ten decay times
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < tissue.model.free_nodes; ++i)
    if (at_end(i)) mean += tissue.model.node_mass[i] / end_mass * (tissue.position[i] - tissue.rest[i]);
  return {mean.x() / length, -mean.z() / length};
}

TEST_P(ClosedForms, cantilever_bends_far_over_as_the_elastica) {
  double error_before = 0.0;
  for (int across : {2, 4, 6}) {
    const Tip tip = bent_tip(GetParam(), across);
    const double error =
        std::hypot(tip.transverse - elastica_transverse, tip.shortening - elastica_shortening);
    if (across > 2) {
      EXPECT_LT(error, 0.6 * error_before);
    }
    error_before = error;
  }
  EXPECT_LT(error_before, 0.04);  // of the length, with six boxes through the thickness
}

}  // namespace
}  // namespace acus::tissue
