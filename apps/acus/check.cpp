// acus check: explains a scene before it is run.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "acus/base/units.h"
#include "acus/io/insertion.h"
#include "acus/io/scene_toml.h"
#include "acus/mesh/quality.h"
#include "acus/needle/buckling.h"
#include "acus/sim/hand.h"
#include "acus/sim/hill.h"
#include "acus/sim/names.h"
#include "acus/sim/prediction.h"
#include "acus/sim/summary.h"
#include "acus/sim/support.h"
#include "verbs.h"

namespace acus::app {
namespace {

constexpr double degrees = 57.29577951308232;  // per radian

void print_needle(const Scene& scene) {
  const needle::NeedleSpec& spec = scene.needle;
  std::printf("Needle   %g mm long, radius %g mm, bending rigidity %.4g N m^2, mass %.3g g\n",
              spec.length / units::mm, spec.radius / units::mm, needle::bending_rigidity(spec),
              1e3 * needle::mass(spec));
  const double front = in_front_of_hand(scene).length;
  if (scene.hand.grip > 0.0)
    std::printf("         held %g mm from its hub: %g mm are in front of the hand\n",
                scene.hand.grip / units::mm, front / units::mm);
  const GuideScene& guide = scene.guide;
  if (guide.length > 0.0)
    std::printf("         in a guide from %g to %g mm above the tissue\n", guide.gap / units::mm,
                (guide.gap + guide.length) / units::mm);
  std::printf("         buckles %s under",
              scene.hand.grip > 0.0 || guide.length > 0.0 ? "so" : "at its whole length");
  Scene other = scene;
  for (needle::Support support : needle::all_supports) {
    other.needle.support = support;
    std::printf("%s %.4f N (%s)", support == needle::all_supports.front() ? "" : ",", critical_load(other),
                name_of(support).c_str());
  }
  std::printf("\n");
}

void print_expectation(const Scene& scene, const Prediction& p) {
  std::printf("Expect   %s: %s\n", name_of(p.outcome).c_str(), in_words(scene, p).c_str());
  std::printf("Buckles  %s\n", buckling_in_words(scene, p).c_str());
  const char* head = p.critical_load < scene.contact.rupture_force ? "Helps " : "Margin";
  for (const std::string& sentence : remedies_in_words(scene, p)) {
    std::printf("%-8s %s\n", head, sentence.c_str());
    head = "";
  }
}

// A mesh read in a wrong unit runs all the same, and shows it only in strange forces.
void warn_of_size(const Scene& scene, const mesh::TetMesh& mesh) {
  Vec3 low = mesh.nodes.front(), high = low;
  for (const Vec3& x : mesh.nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double extent = (high - low).minCoeff();
  if (2.0 * scene.contact.contact_radius > extent || furthest_travel(scene.hand) > extent)
    std::printf(
        "         Note: the contact disc or the travel of the hand is larger than the tissue's smallest "
        "extent, %g mm; "
        "is %s right?\n",
        extent / units::mm, scene.tissue.mesh.empty() ? "tissue.size_mm" : "tissue.mesh_unit_mm");
}

void print_tissue(const Scene& scene, const Simulation& simulation, const Prediction& p) {
  if (scene.tissue.rigid) {
    std::printf("Tissue   none: a fixed stop\n");
    return;
  }
  const mesh::TetMesh& mesh = simulation.tissue();
  const mesh::Quality quality = mesh::quality(mesh);
  if (scene.tissue.mesh.empty())
    std::printf("Tissue   block of %g x %g x %g mm", scene.tissue.size.x() / units::mm,
                scene.tissue.size.y() / units::mm, scene.tissue.size.z() / units::mm);
  else
    std::printf("Tissue   %s", scene.tissue.mesh.c_str());
  std::printf(", Young's modulus %g kPa, Poisson's ratio %g\n", scene.tissue.youngs_modulus / units::kPa,
              scene.tissue.poisson_ratio);
  std::printf("         %zu tetrahedra, %zu nodes, edges of %.2f to %.2f mm\n", mesh.tets.size(),
              mesh.nodes.size(), quality.shortest_edge / units::mm, quality.longest_edge / units::mm);
  std::printf("         worst tetrahedron: smallest dihedral angle %.1f degrees, aspect ratio %.1f\n",
              quality.smallest_dihedral_angle * degrees, quality.largest_aspect_ratio);
  std::printf(
      "         the entry sinks about %.1f mm under the rupture force (half-space, contact disc of %g mm "
      "radius)\n",
      p.sink / units::mm, scene.contact.contact_radius / units::mm);
  warn_of_size(scene, mesh);
}

void print_hand(const HandScene& hand) {
  if (hand.kind != HandKind::person) {
    std::printf("Hand     goes %g mm in %g s\n", furthest_travel(hand) / units::mm, duration(hand));
    return;
  }
  std::printf(
      "Hand     a person who pushes %g mm far at %g mm/s without load, half as fast at %.3g N, and comes to "
      "a "
      "stand at %g N\n",
      hand.travel / units::mm, hand.speed / units::mm, hill_half_speed_load(hand.force_limit),
      hand.force_limit);
  if (hand.hesitation > 0.0)
    std::printf("         feels a change, reacts after %g s, and stands still for %g s\n", hand.reaction,
                hand.hesitation);
  std::printf("         shakes by %g mm rms at 8 to 12 Hz, %s, and gives up after %g s at most\n",
              hand.tremor / units::mm, hand.pulls_back ? "pulls back at the end" : "does not pull back",
              duration(hand));
  if (hand.stiffness == 0.0)
    std::printf("         holds the hub in a rigid grip; a real one gives way: see hand.stiffness_N_m\n");
}

// Steps the simulation for about a tenth of a second of wall time and says what a step costs, unless it
// fails. The first steps do not count: they set tissue at rest in motion.
void print_cost(const Scene& scene, Simulation& simulation) {
  using Clock = std::chrono::steady_clock;
  constexpr int unsettled = 20, fewest = 5, most = 500;  // steps
  constexpr double long_enough = 0.1;                    // s
  const int all = io::step_count(scene);
  Hand hand(scene.hand, scene.run.time_step);
  const auto advance = [&] {
    const std::optional<double> travel = hand.next(simulation.frame().hand_force);
    if (travel) simulation.step(*travel);
    return travel.has_value() && simulation.frame().health == Health::good;
  };
  for (int i = 0; i < std::min(unsettled, all / 2); ++i) advance();
  const auto start = Clock::now();
  double elapsed = 0.0;
  int steps = 0;
  while (steps < most && (steps < fewest || elapsed < long_enough) && advance()) {
    ++steps;
    elapsed = std::chrono::duration<double>(Clock::now() - start).count();
  }
  if (simulation.frame().health != Health::good) return;
  const double per_step = elapsed / steps;
  std::printf(
      "Cost     %.0f us per step of %g ms at first touch (%.1f times real time); %d steps, about %.1f s in "
      "all\n",
      1e6 * per_step, scene.run.time_step / units::ms, scene.run.time_step / per_step, all, all * per_step);
}

}  // namespace

int do_check(const CheckOptions& options) {
  if (options.keys) {
    std::fputs(io::scene_keys_page().c_str(), stdout);
    return done;
  }
  if (options.needles) {
    std::fputs(io::needles_json().c_str(), stdout);
    return done;
  }
  if (options.scene.empty())
    return refused("check needs a scene file, or --keys for the list of all keys", bad_input);
  const Result<Scene> scene = io::read_scene(options.scene, options.settings);
  if (!scene) return refused(scene.error().sentence, bad_input);
  Result<Simulation> simulation = io::build_simulation(*scene);
  if (!simulation) return refused(options.scene + ": " + simulation.error().sentence, bad_input);
  const Prediction prediction = predict(*scene);
  std::printf("Scene    %s makes sense\n", options.scene.c_str());
  print_needle(*scene);
  print_tissue(*scene, *simulation, prediction);
  print_expectation(*scene, prediction);
  print_hand(scene->hand);
  print_cost(*scene, *simulation);
  const Frame& reached = simulation->frame();
  if (reached.health != Health::good)
    return refused(options.scene + ": its first steps fail, at " + std::to_string(reached.time) +
                       " s: " + complaint(reached.health),
                   run_failed);
  return done;
}

}  // namespace acus::app
