// Where the work of the load goes in a step of implicit Euler.
//
// With x1 = x0 + h v1 and M (v1 - v0) = h (f_ext + f_el(x0) - h K' v1 - D v1), multiplied by v1:
//   W_ext = (T1 - T0) + |v1 - v0|_M^2 / 2 + (dx . K' dx - f_el . dx) + h v1 . D v1.
// For a quadratic energy the third bracket is U1 - U0 + dx . K' dx / 2; the difference is what turning
// elements add.
#include <gtest/gtest.h>

#include "tests/tissue/irregular_block.h"
#include "tests/tissue/literal_tissue.h"
#include "tests/tissue/tissue_driver.h"

namespace acus::tissue {
namespace {

class StepEnergy : public BothElements {};
ACUS_FOR_BOTH_ELEMENTS(StepEnergy);

struct Lines {
  double work = 0.0, kinetic = 0.0, elastic = 0.0, damping = 0.0, numerical = 0.0, turning = 0.0;  // J
};

// One step, its lines computed with the dense matrices of the paper's equations.
Lines step_with_lines(BareTissue& tissue, const LiteralTissue& literal, double h, const Rayleigh& damping) {
  const auto size = 3 * static_cast<Eigen::Index>(tissue.model.free_nodes);
  const auto dense = [&](const numeric::NodeVector& v) {
    Eigen::VectorXd d(size);
    for (int i = 0; i < tissue.model.free_nodes; ++i) d.segment<3>(3 * i) = numeric::at(v, i);
    return d;
  };
  const auto response = literal.at(tissue.position);
  const Eigen::MatrixXd K = response.stiffness.topLeftCorner(size, size);
  const Eigen::VectorXd force = response.force.head(size), mass = literal.lumped_mass().head(size);
  const double before = tissue.corotation.energy;
  const Eigen::VectorXd v0 = dense(tissue.velocity);
  tissue.step(h, damping);
  const Eigen::VectorXd v1 = dense(tissue.velocity), dx = h * v1;
  const auto mass_norm = [&](const Eigen::VectorXd& v) { return v.dot(mass.cwiseProduct(v)); };
  Lines l;
  l.work = dense(tissue.load).dot(dx);
  l.kinetic = 0.5 * (mass_norm(v1) - mass_norm(v0));
  l.elastic = tissue.corotation.energy - before;
  l.damping = h * (damping.mass * mass_norm(v1) + damping.stiffness * v1.dot(K * v1));
  l.numerical = 0.5 * mass_norm(v1 - v0) + 0.5 * dx.dot(K * dx);
  l.turning = -force.dot(dx) + 0.5 * dx.dot(K * dx) - l.elastic;
  return l;
}

class Pushed {
 public:
  Pushed(ElementKind kind, double push)
      : held_(held_mesh(irregular_block(), at_bottom)),
        materials_(mixed_materials(held_.mesh.tets.size())),
        tissue(held_, materials_, kind),
        literal(held_.mesh, materials_, kind) {
    for (int i = 0; i < held_.free_nodes; ++i)
      if (tissue.rest[i].z() > 0.029) numeric::at(tissue.load, i) = push * Vec3(1.0, 0.4, -0.7);
  }

 private:
  HeldMesh held_;
  std::vector<Material> materials_;

 public:
  BareTissue tissue;
  LiteralTissue literal;
};

TEST_P(StepEnergy, is_all_accounted_for) {
  Pushed p(GetParam(), 0.05);
  for (int step = 0; step < 30; ++step) {
    const Lines l = step_with_lines(p.tissue, p.literal, 2e-3, {3.0, 1e-3});
    const double scale = std::abs(l.work) + std::abs(l.kinetic) + std::abs(l.elastic);
    EXPECT_NEAR(l.work, l.kinetic + l.elastic + l.damping + l.numerical + l.turning, 1e-12 * scale);
    EXPECT_GT(l.damping, 0.0);
    EXPECT_GT(l.numerical, 0.0);
  }
}

TEST_P(StepEnergy, closes_with_the_stored_energy_alone_in_small_motion) {
  Pushed p(GetParam(), 1e-5);  // N: strains of some 1e-5, and turning is of one order more
  double lost = 0.0, turned = 0.0;
  for (int step = 0; step < 30; ++step) {
    const Lines l = step_with_lines(p.tissue, p.literal, 2e-3, {3.0, 1e-3});
    lost += l.numerical;
    turned += std::abs(l.turning);
  }
  EXPECT_LT(turned, 1e-3 * lost);
}

}  // namespace
}  // namespace acus::tissue
