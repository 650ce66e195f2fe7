// A needle that is a rod: buckling, snapping straight and buckling again come out of its mechanics alone.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "acus/io/mesh_file.h"
#include "acus/mesh/block.h"
#include "insertion.h"

using namespace acus;
using namespace acus::physics;
using needle::Support;

namespace {

Scene in_testing_machine(Support support, double shortening_ratio) {
  Scene scene;
  scene.needle_model = NeedleModel::rod;
  scene.needle.support = support;
  scene.tissue.rigid = true;
  scene.contact.stiffness = 1e5;
  scene.hand.travel = shortening_ratio * scene.needle.length;
  return scene;
}

class Rod : public testing::TestWithParam<std::pair<Support, double>> {};
INSTANTIATE_TEST_SUITE_P(FourSupports, Rod, testing::ValuesIn(euler_factors));

TEST_P(Rod, southwell_plot_gives_euler_load) {
  const auto [support, factor] = GetParam();
  Scene scene = in_testing_machine(support, 0.002);
  scene.needle.imperfection = 0.2e-3;
  scene.hand.speed = 0.1e-3;  // the slowest of them swings five times a second
  const double least = support == Support::clamped_free ? 5e-3 : 0.5e-3;
  const double most = support == Support::clamped_free ? 10e-3 : 3e-3;
  const Insertion run = insert(scene);
  const double initial = run.frames.front().deflection;
  const double load = southwell_load(run, initial, least, most);
  EXPECT_NEAR(load, factor * pinned_pinned_load, 0.005 * factor * pinned_pinned_load);
}

// What buckles is neither the time step's doing nor the hand's speed.
TEST(RodInTissue, buckles_at_the_same_load_at_every_step_and_speed) {
  std::vector<double> loads;
  for (const auto& [step, speed] : {std::pair{0.25e-3, 10e-3}, std::pair{1e-3, 1e-3}, std::pair{1e-3, 10e-3},
                                    std::pair{2e-3, 10e-3}, std::pair{1e-3, 50e-3}}) {
    Scene scene = table_one(0.2, 14e-3, speed, 600);
    scene.needle_model = NeedleModel::rod;
    scene.run.time_step = step;
    const Insertion run = insert(scene);
    ASSERT_TRUE(run.first(EventKind::buckling)) << step << ' ' << speed;
    // Well after, when the bow has come to rest with the load: what it then carries.
    loads.push_back(run.frames.back().hand_force);
    EXPECT_NEAR(loads.back(), loads.front(), 0.02 * loads.front()) << step << ' ' << speed;
  }
  EXPECT_NEAR(loads.front(), 2.04575 * pinned_pinned_load, 0.03 * loads.front());
}

// Iterations of the solver per step, while the tip presses and while the needle goes in.
std::pair<double, double> iterations_of_needle(double youngs_modulus, double radius) {
  Scene scene = table_one(0.05, 15e-3, 20e-3, 1500);
  scene.needle_model = NeedleModel::rod;
  scene.needle.youngs_modulus = youngs_modulus;
  scene.needle.radius = radius;
  scene.contact.rupture_force = 0.03;  // the most slender of them carries 0.05 N
  scene.contact.fracture_toughness = 1.0;
  scene.contact.friction = 0.5;
  scene.hand.kind = HandKind::path;
  scene.hand.path = {{0.0, 0.0}, {0.3, 0.3e-3}, {1.0, 15e-3}};
  const Insertion run = insert(scene);
  EXPECT_GT(run.frames.back().inserted_length, 14e-3);
  double pressed = 0.0, inserted = 0.0, pressed_steps = 0.0, inserted_steps = 0.0;
  for (const Frame& f : run.frames) {
    if (f.stage == Stage::inserted) inserted += f.solver_iterations, ++inserted_steps;
    if (f.stage == Stage::contact) pressed += f.solver_iterations, ++pressed_steps;
  }
  return {pressed / pressed_steps, inserted / inserted_steps};
}

// The rod is eliminated exactly, so how stiff it is against the tissue is nothing to the solver: from a
// thread of nitinol to a bar of steel, twenty-seven thousand times as stiff in bending.
TEST(RodInTissue, takes_as_many_iterations_whatever_the_needle_is_made_of) {
  std::vector<double> pressed, inserted;
  for (const auto& [modulus, radius] :
       {std::pair{75e9, 0.1e-3}, std::pair{75e9, 0.2e-3}, std::pair{200e9, 0.5e-3}, std::pair{200e9, 1e-3}}) {
    const auto [before, after] = iterations_of_needle(modulus, radius);
    pressed.push_back(before), inserted.push_back(after);
  }
  for (const auto& counts : {pressed, inserted}) {
    const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
    EXPECT_LT(*most, 1.5 * *least);
  }
}

// Held still for a minute nothing creeps.
TEST(RodInTissue, rests_when_the_hand_rests) {
  Scene scene = table_one(0.15, 15e-3, 30e-3, 600);
  scene.needle_model = NeedleModel::rod;
  scene.run.time_step = 5e-3;
  scene.hand.kind = HandKind::path;
  scene.hand.path = {{0.0, 0.0}, {0.5, 15e-3}, {1.5, 15e-3}, {61.5, 15e-3}};
  const Insertion run = insert(scene);
  const auto at = [&](double time) {
    return run.frames[static_cast<std::size_t>(std::lround(time / 5e-3)) - 1];
  };
  EXPECT_GT(at(1.5).inserted_length, 5e-3);
  EXPECT_NEAR(at(61.5).tip_depth, at(1.5).tip_depth, 1e-6);
  EXPECT_EQ(at(61.5).ledger.work_cutting, at(1.5).ledger.work_cutting);
}

// Drawn back, friction turns round and cutting gives nothing back; pushed in again, the needle follows its
// channel.
TEST(RodInTissue, goes_out_and_in_again_through_its_channel) {
  Scene scene = table_one(0.15, 25e-3, 30e-3, 800);
  scene.needle_model = NeedleModel::rod;
  scene.hand.kind = HandKind::path;
  scene.hand.path = {{0.0, 0.0}, {1.0, 25e-3}, {1.5, 12e-3}, {2.1, 24e-3}};
  const Insertion run = insert(scene);
  const Frame& back = run.frames[1499];
  EXPECT_LT(back.hand_force, -0.1);
  EXPECT_EQ(back.ledger.work_cutting, run.frames[1020].ledger.work_cutting);
  // Nothing is cut before the tip is where it was.
  EXPECT_EQ(run.frames.back().ledger.work_cutting, back.ledger.work_cutting);
  EXPECT_GT(run.frames.back().hand_force, 0.1);
  EXPECT_EQ(std::count_if(run.events.begin(), run.events.end(),
                          [](const Event& e) { return e.kind == EventKind::puncture; }),
            1);
}

// Pushed through a thin slab and drawn out again: friction falls with what is inside, and nothing holds it at
// the end.
TEST(RodInTissue, comes_out_at_the_far_side_and_back) {
  Scene scene = table_one(0.15, 40e-3, 50e-3, 600);
  scene.needle_model = NeedleModel::rod;
  scene.tissue.size = {0.06, 0.06, 0.02};
  scene.contact.rupture_force = 0.3;
  scene.hand.kind = HandKind::path;
  scene.hand.path = {{0.0, 0.0}, {0.8, 40e-3}, {1.7, -5e-3}};
  const Insertion run = insert(scene);
  ASSERT_TRUE(run.first(EventKind::exit));
  EXPECT_LT(run.first(EventKind::exit)->time, 0.8);
  EXPECT_NEAR(run.at_travel(35e-3).inserted_length, 20e-3, 3e-3);
  EXPECT_EQ(run.frames.back().stage, Stage::withdrawn);
  EXPECT_EQ(run.frames.back().inserted_length, 0.0);
  EXPECT_NEAR(run.frames.back().hand_force, 0.0, 1e-3);
  double pulled = 0.0;
  for (const Frame& f : run.frames) pulled = std::min(pulled, f.hand_force);
  EXPECT_GT(pulled, -1.2 * scene.contact.friction * 20e-3);
}

// A bowed needle that breaks through a deep dent: the tissue under its tip is crumpled, and tells the cut to
// go back. The tip shoots in by centimetres and stays there.
TEST(RodInTissue, goes_in_through_crumpled_tissue) {
  Scene scene = table_one(0.2, 26e-3, 20e-3, 3000);
  scene.contact.rupture_force = 0.66;
  scene.contact.fracture_toughness = 76.0;
  scene.contact.friction = 20.0;
  const Insertion run = insert(scene);
  ASSERT_TRUE(run.first(EventKind::puncture));
  EXPECT_FALSE(run.first(EventKind::exit));
  EXPECT_GT(run.frames.back().inserted_length, 10e-3);
}

// A hub led aside and turned, against the beam clamped at the hub and pinned at the tip: an offset d asks for
// the force 3 EI d / L^3 and the moment 3 EI d / L^2, a turn by an angle for 3 EI angle / L^2 and 3 EI angle
// / L.
TEST(RodHub, feels_the_force_and_moment_of_a_beam) {
  Scene scene = in_testing_machine(Support::clamped_pinned, 0.1);
  scene.needle.imperfection = 0.0;
  const double L = scene.needle.length, EI = needle::bending_rigidity(scene.needle);
  for (const auto& [turned, grip] : {std::pair{false, 0.0}, std::pair{true, 0.0}, std::pair{false, 1e6}}) {
    scene.hand.stiffness = grip;  // gives way along the path alone
    auto simulation = Simulation::build(scene);
    ASSERT_TRUE(simulation.ok());
    needle::Pose hub = simulation->hub();
    hub.position += 0.05e-6 * simulation->direction();  // the tip rests on the stop
    simulation->step(hub);
    const Vec3 tangent = hub.tangent, aside = hub.director;
    const double most = turned ? 0.5e-3 : 0.05e-3;  // rad, m
    for (int i = 1; i <= 1500; ++i) {
      const double now = most * std::min(1.0, i / 500.0);
      needle::Pose led = hub;
      if (turned) {
        led.tangent = (tangent + now * aside).normalized();
        led.director = (aside - now * tangent).normalized();
      } else {
        led.position += now * aside;
      }
      simulation->step(led);
    }
    const Frame& f = simulation->frame();
    const double force = 3.0 * EI * most / (turned ? L * L : L * L * L),
                 moment = 3.0 * EI * most / (turned ? L : L * L);
    const double tilted =
        turned ? 0.0 : f.hand_force * most / L;  // what presses the tip down no longer points at it
    EXPECT_NEAR(f.hub_force.dot(aside) + tilted, force, 0.01 * force) << turned;
    EXPECT_NEAR(f.hub_moment.norm(), moment, 0.02 * moment) << turned;
    EXPECT_LT(std::abs(f.energy_residual), 1e-4 * f.ledger.work_hand);
    EXPECT_NEAR(f.ledger.energy_needle, 0.5 * (turned ? moment : force) * most, 0.03 * f.ledger.energy_needle)
        << turned;
  }
}

// Where the tip touches beside the entry, the channel begins there: nothing pulls the shaft aside.
TEST(RodHub, may_go_in_beside_the_entry) {
  Scene scene = table_one(0.1, 30e-3, 50e-3, 800);
  scene.needle_model = NeedleModel::rod;
  scene.needle.radius = 0.5e-3;
  scene.needle.imperfection = 0.0;
  scene.contact.rupture_force = 0.5;
  auto simulation = Simulation::build(scene);
  ASSERT_TRUE(simulation.ok());
  const needle::Pose start = simulation->hub();
  const double beside = 1.5e-3;
  needle::Pose hub = start;
  double numerical = 0.0, aside = 0.0;
  for (int i = 1; i <= 900; ++i) {
    const double travel = i <= 400 ? -3e-3 : -3e-3 + 50e-6 * (i - 400);  // lifted and led aside, then pushed
    hub.position =
        start.position + travel * start.tangent + beside * std::min(1.0, i / 300.0) * start.director;
    const Frame& f = simulation->step(hub);
    ASSERT_EQ(f.health, Health::good) << i;
    ASSERT_GT(f.ledger.work_numerical, numerical - 1e-7) << i;
    numerical = f.ledger.work_numerical;
    if (f.inserted_length > 0.0) aside = std::max(aside, std::abs(f.hub_force.dot(start.director)));
  }
  EXPECT_GT(simulation->frame().inserted_length, 10e-3);
  EXPECT_LT(aside, 0.02);  // N; the tissue beside the entry is not quite symmetric
}

// A path that is not along an axis: the grip gives way by its stiffness there too.
TEST(RodHub, grip_gives_way_along_an_oblique_path) {
  const auto block = mesh::build_graded_block({0.1, 0.1, 0.06}, 800);
  ASSERT_TRUE(block.ok());
  Scene scene = table_one(0.15, 10e-3);
  scene.needle_model = NeedleModel::rod;
  scene.tissue.mesh = "given";
  scene.tissue.target = {0.0, 0.0, 0.03};
  scene.tissue.direction = Vec3(0.3, -0.2, -1.0).normalized();
  scene.hand.stiffness = 350.0;
  auto simulation = Simulation::build(scene, &*block);
  ASSERT_TRUE(simulation.ok()) << simulation.error().sentence;
  for (int i = 1; i <= 100; ++i) {
    const Frame& f = simulation->step(30e-6 * i);
    ASSERT_EQ(f.health, Health::good) << i;
    ASSERT_NEAR(f.hand_travel, 30e-6 * i - f.hand_force / 350.0, 1e-9) << i;
  }
  EXPECT_GT(simulation->frame().hand_force, 0.05);
}

TEST(RodHub, takes_directions_of_any_length_and_refuses_none) {
  Scene scene = in_testing_machine(Support::clamped_pinned, 0.1);
  auto one = Simulation::build(scene), other = Simulation::build(scene);
  needle::Pose hub = one->hub();
  hub.position += 1e-5 * hub.tangent;
  one->step(hub);
  hub.director = 3.0 * hub.director + hub.tangent;
  hub.tangent *= 2.0;
  other->step(hub);
  EXPECT_EQ(other->state_hash(), one->state_hash());
  hub.tangent.setZero();
  EXPECT_EQ(one->step(hub).health, Health::not_finite);
}

// Second buckling loads of an independent program (../data: Euler-Bernoulli beam of 160 elements, lateral
// stiffness condensed from the tetrahedra of the mesh, near field with beta = 0.3). Nothing is cut; dry
// friction carries all of the load, so the axial force falls linearly along what is inside.
class EmbeddedNeedle : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(On, EmbeddedNeedle, testing::Values("block_2k", "graded_12k"));

TEST_P(EmbeddedNeedle, buckles_at_the_load_of_an_independent_program) {
  const char* given = std::getenv("ACUS_DATA");  // see CONTRIBUTING.md
  if (given == nullptr) GTEST_SKIP() << "ACUS_DATA names no folder of other programs' results";
  const auto folder = std::filesystem::path(given) / "embedded_needle";
  const auto all = nlohmann::json::parse(std::ifstream(folder / "loads.json"));
  const auto& table = all["with_subgrid_compliance_beta_0.3_N"][GetParam()];
  const auto expected = [&](double depth) {
    const double at[] = {10e-3, 20e-3, 30e-3, 45e-3};
    const auto load = [&](int i) { return table[std::to_string(std::lround(1e3 * at[i]))].get<double>(); };
    const int i = depth < at[1] ? 0 : depth < at[2] ? 1 : 2;
    return load(i) + (load(i + 1) - load(i)) * (depth - at[i]) / (at[i + 1] - at[i]);
  };
  const auto mesh = io::read_mesh((folder / (std::string(GetParam()) + ".msh")).string(), 1.0);
  ASSERT_TRUE(mesh.ok()) << mesh.error().sentence;
  for (const double depth : {10e-3, 20e-3, 45e-3}) {
    Scene scene = uncut_in_given_block(expected(depth) / depth);
    scene.tissue.element = Element::linear;
    auto simulation = Simulation::build(scene, &*mesh);
    ASSERT_TRUE(simulation.ok()) << simulation.error().sentence;
    // The deeper the more friction carries, until the needle gives way.
    double travel = 0.0;
    while (simulation->frame().deflection < 0.02 * simulation->frame().free_length && travel < 1.5 * depth) {
      const bool near = simulation->frame().inserted_length > 0.85 * depth;
      ASSERT_EQ(simulation->step(travel += near ? 5e-6 : 20e-6).health, Health::good);
    }
    const Frame& bent = simulation->frame();
    RecordProperty("depth_mm_" + std::to_string(std::lround(1e3 * depth)),
                   std::to_string(1e3 * bent.inserted_length));
    RecordProperty("load_N_" + std::to_string(std::lround(1e3 * depth)), std::to_string(bent.hand_force));
    EXPECT_NEAR(bent.hand_force, expected(bent.inserted_length), 0.05 * bent.hand_force)
        << "at a depth of " << 1e3 * bent.inserted_length << " mm";
  }
}

// The disc that spreads the tip load crosses elements, each deformed in its own way. It turns over its own
// radius, so that nothing leaps: a needle that goes in slowly feels friction grow, and no drops of a
// millinewton.
TEST(RodInTissue, cuts_on_evenly_from_element_to_element) {
  Scene scene;
  scene.needle.length = 0.12;
  scene.contact.rupture_force = 0.2;
  auto simulation = Simulation::build(scene);
  ASSERT_TRUE(simulation);
  double travel = 0.0;
  while (simulation->frame().inserted_length < 20e-3 && travel < 0.1) simulation->step(travel += 1e-4);
  double before = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double force = simulation->step(travel += 1e-5).hand_force;
    if (i > 50) {
      EXPECT_GT(force, before - 2e-4) << i;
    }
    before = force;
  }
}

}  // namespace
