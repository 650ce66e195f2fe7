// Stress relaxation against the closed forms of the standard linear solid.
#include "acus/tissue/relaxation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/tissue/irregular_block.h"
#include "tests/tissue/tissue_driver.h"

namespace acus::tissue {
namespace {

// Pulled along one axis, its sides free, a solid that relaxes in shear only is again one of the kind: the
// transform of its modulus is 9 K G(s) / (3 K + G(s)) with G(s) = G (1 + m s tau / (1 + s tau)).
struct Bar {
  double sudden = 0.0, lasting = 0.0;  // Pa, Young's moduli
  double relaxation_time = 0.0;        // s, at a held strain
  double creep_time = 0.0;             // s, under a held load

  Bar(const Material& of, const Relaxation& r) {
    const double G = shear_modulus(of), K = bulk_modulus(of), G0 = G / (1.0 - r.share);
    lasting = 9.0 * K * G / (3.0 * K + G);
    sudden = 9.0 * K * G0 / (3.0 * K + G0);
    relaxation_time = r.time * (3.0 * K + G0) / (3.0 * K + G);
    creep_time = relaxation_time * sudden / lasting;
  }
  double modulus(double t) const { return lasting + (sudden - lasting) * std::exp(-t / relaxation_time); }
  double compliance(double t) const {
    return 1.0 / lasting - (1.0 / lasting - 1.0 / sudden) * std::exp(-t / creep_time);
  }
};

constexpr double width = 0.03, breadth = 0.04, height = 0.03;  // m, of irregular_block
constexpr Relaxation half = {0.5, 0.2};

Material light(double poisson_ratio) { return {25e3, poisson_ratio, 1.0}; }  // without inertia, nearly

// A block that floats, pulled at top and bottom by one uniform stress.
class FloatingBar {
 public:
  BareTissue tissue;
  FloatingBar(ElementKind kind, const Material& material, const RelaxationStep& relaxation)
      : tissue(held_mesh(irregular_block(), nowhere), material, kind, relaxation), pull_(tissue.load) {
    const double small = 1e-6, nu = material.poisson_ratio;
    std::vector<Vec3> stretched = tissue.rest;
    for (Vec3& x : stretched) x = x.cwiseProduct(Vec3(1.0 - nu * small, 1.0 - nu * small, 1.0 + small));
    corotate_into(tissue.corotation, tissue.model, stretched);
    const double stress = material.youngs_modulus * small;
    for (std::size_t i = 0; i < pull_.size(); ++i) pull_[i] = -tissue.corotation.elastic_force[i] / stress;
    corotate_into(tissue.corotation, tissue.model, tissue.rest);
  }
  void step_under(double stress, double h) {
    for (std::size_t i = 0; i < pull_.size(); ++i) tissue.load[i] = stress * pull_[i];
    tissue.step(h);
  }
  // A step to a strain; returns the stress that it takes. What a step does is linear in the load.
  double step_to(double strain, double h) {
    FloatingBar free = *this, loaded = *this;
    const double stress = 1.0;
    free.step_under(0.0, h);
    loaded.step_under(stress, h);
    const double needed = (strain - free.strain()) / (loaded.strain() - free.strain()) * stress;
    step_under(needed, h);
    return needed;
  }
  double strain() const {
    double sum = 0.0;
    int ends = 0;
    for (std::size_t i = 0; i < tissue.rest.size(); ++i)
      if (const double z = tissue.rest[i].z(); z < 1e-9 || z > height - 1e-9) {
        sum += (tissue.position[i].z() - z) * (z > 0.5 * height ? 1.0 : -1.0);
        ++ends;
      }
    return 2.0 * sum / ends / height;
  }

 private:
  numeric::NodeVector pull_;  // m^2: load per stress
};

class Relaxing : public BothElements {};
ACUS_FOR_BOTH_ELEMENTS(Relaxing);

TEST_P(Relaxing, stretched_at_once_and_held_its_force_falls_as_the_closed_form_says) {
  for (double nu : {0.2, 0.48}) {
    const double h = 1e-2, strain = 1e-5;  // pressed, what floats turns over
    FloatingBar bar(GetParam(), light(nu), relaxation_step(half, h));
    const Bar exact(light(nu), half);
    for (int step = 1; step <= 100; ++step) {
      const double stress = bar.step_to(strain, h);
      if (step > 2) {
        ASSERT_NEAR(stress / strain, exact.modulus((step - 0.5) * h), 1e-3 * exact.lasting)
            << nu << ", " << step * h << " s";
      }
    }
    EXPECT_GT(exact.sudden, 1.5 * exact.lasting);
  }
}

TEST_P(Relaxing, under_a_load_it_creeps_as_the_closed_form_says) {
  for (double nu : {0.2, 0.48}) {
    const double h = 5e-3, stress = 0.2;  // Pa
    FloatingBar bar(GetParam(), light(nu), relaxation_step(half, h));
    const Bar exact(light(nu), half);
    for (int step = 1; step <= 300; ++step) {
      bar.step_under(stress, h);
      ASSERT_NEAR(bar.strain() / stress, exact.compliance((step - 0.5) * h),
                  1e-2 * exact.compliance(step * h))
          << nu << ", " << step * h << " s";
    }
  }
}

// To and fro in shear: a whole turn spends pi G'' times the amplitude squared per volume, with the loss
// modulus G'' = G m omega tau / (1 + omega^2 tau^2).
TEST_P(Relaxing, a_turn_of_shear_spends_what_the_loss_modulus_says) {
  const int steps = 400;  // a turn
  for (double omega_tau : {0.1, 1.0, 10.0}) {
    const double h = 2.0 * std::numbers::pi * half.time / omega_tau / steps, amplitude = 1e-4;
    BareTissue tissue(held_mesh(irregular_block(), nowhere), soft, GetParam(), relaxation_step(half, h));
    double spent = 0.0, least = 1.0;
    const int turns = 2 + static_cast<int>(2.0 * omega_tau);  // until the beginning is forgotten
    for (int step = 1; step <= turns * steps; ++step) {
      const double shear = amplitude * std::sin(2.0 * std::numbers::pi * step / steps);
      for (std::size_t i = 0; i < tissue.rest.size(); ++i)
        tissue.position[i] = tissue.rest[i] + Vec3(shear * tissue.rest[i].z(), 0.0, 0.0);
      corotate_into(tissue.corotation, tissue.branch, tissue.model, tissue.position);
      if (step > (turns - 1) * steps) spent += tissue.corotation.relaxed;
      least = std::min(least, tissue.corotation.relaxed);
    }
    const double m = half.share / (1.0 - half.share);
    const double loss = shear_modulus(soft) * m * omega_tau / (1.0 + omega_tau * omega_tau);
    const double turn = std::numbers::pi * loss * amplitude * amplitude * width * breadth * height;
    EXPECT_NEAR(spent, turn, 2e-3 * turn) << omega_tau;
    EXPECT_GE(least, 0.0);
  }
}

// The branch turns with the tissue: forces after a turn are the turned forces, and the turn itself spends
// nothing.
TEST_P(Relaxing, turning_it_does_not_strain_the_branch) {
  const RelaxationStep step = relaxation_step(half, 1e-2);
  const HeldMesh held = held_mesh(irregular_block(), nowhere);
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  BareTissue still(held, soft, GetParam(), step), turned(held, soft, GetParam(), step);
  const std::vector<Vec3> bent = jolted(still.rest, 1e-3, 3);
  std::vector<Vec3> bent_and_turned = bent;
  for (Vec3& x : bent_and_turned) x = turn * x;
  for (BareTissue* t : {&still, &turned}) corotate_into(t->corotation, t->branch, t->model, bent);
  const double sudden = still.corotation.energy;
  corotate_into(still.corotation, still.branch, still.model, bent);
  corotate_into(turned.corotation, turned.branch, turned.model, bent_and_turned);
  EXPECT_NEAR(turned.corotation.energy, still.corotation.energy, 1e-9 * sudden);
  EXPECT_NEAR(turned.corotation.relaxed, still.corotation.relaxed, 1e-9 * sudden);
  EXPECT_NEAR(sudden - still.corotation.energy, still.corotation.relaxed, 1e-9 * sudden);
  const double scale =
      std::sqrt(numeric::dot(still.corotation.elastic_force, still.corotation.elastic_force));
  for (int i = 0; i < still.model.nodes; ++i) {
    const Vec3 expected = turn * Vec3(numeric::at(still.corotation.elastic_force, i));
    EXPECT_LT((Vec3(numeric::at(turned.corotation.elastic_force, i)) - expected).norm(), 1e-9 * scale);
  }
}

// A branch that keeps what it has, bent first one way and then another, so that its stress and the stretch
// have different axes: all the same the forces are the gradient of the energy, and turn nothing.
TEST_P(Relaxing, forces_are_the_gradient_of_the_energy_whatever_the_history) {
  BareTissue tissue(held_mesh(irregular_block(), nowhere), soft, GetParam(),
                    relaxation_step({0.5, 1e9}, 1e-3));
  const std::vector<Vec3> bent = jolted(tissue.rest, 1e-3, 4);
  corotate_into(tissue.corotation, tissue.branch, tissue.model, jolted(tissue.rest, 2e-3, 3));
  for (double& q : tissue.branch.spring) q = -q;
  corotate_into(tissue.corotation, tissue.branch, tissue.model, bent);
  const numeric::NodeVector force = tissue.corotation.elastic_force;
  Vec3 moment = Vec3::Zero();
  double scale = 0.0;
  for (int i = 0; i < tissue.model.nodes; ++i) {
    const Vec3 one = bent[i].cross(Vec3(numeric::at(force, i)));
    moment += one;
    scale += one.norm();
  }
  EXPECT_LT(moment.norm(), 1e-6 * scale);
  const auto energy_at = [&](const std::vector<Vec3>& x) {
    MaxwellBranch branch = tissue.branch;
    corotate_into(tissue.corotation, branch, tissue.model, x);
    return tissue.corotation.energy;
  };
  const double small = 1e-7;
  const std::vector<Vec3> way = jolted(std::vector<Vec3>(bent.size(), Vec3::Zero()), 1.0, 5);
  std::vector<Vec3> ahead = bent, behind = bent;
  double work = 0.0;
  for (std::size_t i = 0; i < bent.size(); ++i) {
    ahead[i] += small * way[i];
    behind[i] -= small * way[i];
    work += 2.0 * small * way[i].dot(Vec3(numeric::at(force, static_cast<int>(i))));
  }
  EXPECT_NEAR(energy_at(behind) - energy_at(ahead), work, 1e-5 * std::abs(work));
}

// Against the C library and against the integral of |q|^2 / tau over a step, by Simpson's rule.
TEST(RelaxationStep, is_the_exact_solution_over_steps_of_every_length) {
  for (double x : {1e-12, 1e-6, 1e-3, 0.1, 0.25, 0.7, 1.0, 1.1, 5.0, 40.0, 1e3, 1e6}) {
    const RelaxationStep s = relaxation_step({0.4, 1.0 / x}, 1.0);
    EXPECT_NEAR(s.modulus, 2.0 / 3.0, 1e-15);
    EXPECT_NEAR(s.kept, std::exp(-x), 1e-14) << x;
    EXPECT_NEAR(s.taken, -std::expm1(-x) / x, 1e-13 * s.taken) << x;
    EXPECT_GE(s.rest, 0.0);
    if (x > 50.0) {  // the dashpot alone
      EXPECT_NEAR(s.rest * x, 1.0, 3.0 / x);
      continue;
    }
    for (double q0 : {0.0, 1.0, -0.6})
      for (double change : {0.0, 1.0, 0.3}) {
        const auto q = [&](double t) { return q0 * std::exp(-x * t) - change * std::expm1(-x * t) / x; };
        const int pieces = 4000;
        double sum = 0.0;
        for (int i = 0; i <= pieces; ++i) {
          const double weight = i == 0 || i == pieces ? 1.0 : i % 2 ? 4.0 : 2.0;
          const double at = q(static_cast<double>(i) / pieces);
          sum += weight * x * at * at / (3.0 * pieces);
        }
        const double mean = q0 + s.lead * change;
        EXPECT_NEAR(s.spent * mean * mean + s.rest * change * change, sum, 1e-7 * sum) << x;
      }
  }
}

TEST(RelaxationStep, without_a_share_is_nothing_at_all) {
  const RelaxationStep s = relaxation_step({0.0, 1e-3}, 1e-3);
  EXPECT_FALSE(s.relaxes());
  EXPECT_EQ(s.stiffening(), 0.0);
  const BareTissue tissue(held_mesh(irregular_block(), nowhere), soft, ElementKind::linear, s);
  EXPECT_EQ(tissue.model.step_shear, tissue.model.shear);
  EXPECT_EQ(tissue.model.step_lambda, tissue.model.local_lambda);
  EXPECT_TRUE(tissue.branch.spring.empty());
}

}  // namespace
}  // namespace acus::tissue
