#include "acus/sim/scene_keys.h"

#include <algorithm>
#include <type_traits>

#include "acus/base/decimal.h"
#include "acus/sim/names.h"

namespace acus {
namespace {

#define ACUS_AT(member) \
  [](Scene & s) -> auto& { return s.member; }
#define ACUS_CHOICE(member, ...)                                                             \
  ChoiceField {                                                                              \
    {__VA_ARGS__}, [](const Scene& s) { return static_cast<int>(s.member); },                \
        [](Scene& s, int i) { s.member = static_cast<std::decay_t<decltype(s.member)>>(i); } \
  }

using needle::Support;
constexpr int milli = -3, kilo = 3, mega = 6, giga = 9, one = 0;

std::vector<SceneKey> needle_keys() {
  return {
      {"needle.model", ACUS_CHOICE(needle_model, "column", "rod"),
       "how the needle bends: column is the paper's closed forms and straight inside, rod bends everywhere"},
      {"needle.length_mm", NumberField{ACUS_AT(needle.length), milli, {1.0, 2000.0}}, "hub to tip, unloaded"},
      {"needle.radius_mm", NumberField{ACUS_AT(needle.radius), milli, {0.01, 10.0}},
       "outer, of a round section"},
      {"needle.inner_radius_mm", NumberField{ACUS_AT(needle.inner_radius), milli, {0.0, 10.0}},
       "of the bore; 0 for a solid needle"},
      {"needle.youngs_modulus_GPa", NumberField{ACUS_AT(needle.youngs_modulus), giga, {0.001, 1000.0}},
       "of the needle's material; steel 200"},
      {"needle.density_kg_m3", NumberField{ACUS_AT(needle.density), one, {1.0, 30000.0}},
       "of the needle's material; steel 7850"},
      {"needle.support",
       ACUS_CHOICE(needle.support, name_of(Support::pinned_pinned), name_of(Support::clamped_pinned),
                   name_of(Support::clamped_clamped), name_of(Support::clamped_free)),
       "ends of the free part, hub first; the paper's Eq. 10 is pinned_pinned"},
      {"needle.imperfection_mm", NumberField{ACUS_AT(needle.imperfection), milli, {0.0, 20.0}},
       "amplitude of the initial bow, which seeds buckling"},
      {"needle.bevel_deg", NumberField{ACUS_AT(needle.bevel_degrees), one, {0.0, 90.0}},
       "between the face of the tip and the axis; 0 for a tip without a side; a rod's alone"},
      {"needle.bevel_turn_deg", NumberField{ACUS_AT(needle.bevel_turn_degrees), one, {-360.0, 360.0}},
       "about the axis, from the plane of the bow to the side that the bevel steers to"},
  };
}

std::vector<SceneKey> tissue_keys() {
  return {
      {"tissue.rigid", SwitchField{ACUS_AT(tissue.rigid)},
       "true puts a fixed stop in place of tissue: the bare column in a testing machine"},
      {"tissue.youngs_modulus_kPa", NumberField{ACUS_AT(tissue.youngs_modulus), kilo, {0.01, 1e6}},
       "stiffness of the tissue; where it relaxes, the long-term one"},
      {"tissue.poisson_ratio", NumberField{ACUS_AT(tissue.poisson_ratio), one, {0.0, 0.4999}},
       "towards 0.5 the tissue keeps its volume"},
      {"tissue.density_kg_m3", NumberField{ACUS_AT(tissue.density), one, {1.0, 30000.0}},
       "mass density of the tissue"},
      {"tissue.element", ACUS_CHOICE(tissue.element, "linear", "nodal_pressure"),
       "linear is the paper's tetrahedron; nodal_pressure does not lock near Poisson's ratio 0.5"},
      {"tissue.damping_mass_1_s", NumberField{ACUS_AT(tissue.damping_mass), one, {0.0, 1e5}},
       "Rayleigh damping proportional to mass"},
      {"tissue.damping_stiffness_ms", NumberField{ACUS_AT(tissue.damping_stiffness), milli, {0.0, 1e5}},
       "Rayleigh damping proportional to stiffness"},
      {"tissue.relaxation_share", NumberField{ACUS_AT(tissue.relaxation_share), one, {0.0, 0.99}},
       "of the stiffness in shear that a sudden load meets: what is gone again after the relaxation time"},
      {"tissue.relaxation_time_s", NumberField{ACUS_AT(tissue.relaxation_time), one, {1e-6, 1e6}},
       "in which a force that is held relaxes, to 37 % of what it has to"},
      {"tissue.size_mm", VectorField{ACUS_AT(tissue.size), milli, {1.0, 5000.0}},
       "width, breadth and depth of the block; bottom fixed, top free, entry at the centre of the top"},
      {"tissue.tetrahedra", IntegerField{ACUS_AT(tissue.tetrahedra), {100.0, 2e6}},
       "number of tetrahedra aimed at in the block, graded towards the path"},
      {"tissue.mesh", FileField{ACUS_AT(tissue.mesh)},
       "mesh file used instead of the block, relative to the scene file; empty for the block"},
      {"tissue.mesh_unit_mm", NumberField{ACUS_AT(tissue.mesh_unit), milli, {1e-6, 1e6}},
       "length of the unit of that file"},
      {"tissue.target_mm", VectorField{ACUS_AT(tissue.target), milli, {-1e5, 1e5}},
       "point of a mesh that the needle is aimed at"},
      {"tissue.direction", VectorField{ACUS_AT(tissue.direction), one, {-1e3, 1e3}},
       "in which the needle comes to a mesh; any length but zero"},
      {"tissue.fixed_fraction", NumberField{ACUS_AT(tissue.fixed_fraction), one, {0.001, 0.9}},
       "of a mesh's extent along the direction: the far part that is held fixed"},
  };
}

std::vector<SceneKey> contact_keys() {
  return {
      {"contact.rupture_force_N", NumberField{ACUS_AT(contact.rupture_force), one, {1e-6, 1000.0}},
       "tip force at which the tissue gives way"},
      {"contact.fracture_toughness_J_m2", NumberField{ACUS_AT(contact.fracture_toughness), one, {0.0, 1e6}},
       "work of cutting per crack area; it holds only with the crack it was measured with"},
      {"contact.crack", ACUS_CHOICE(contact.crack, "ring", "slit"),
       "crack area per depth: ring is 2 pi r (Eq. 16), slit is 2 r"},
      {"contact.friction_N_m", NumberField{ACUS_AT(contact.friction), one, {0.0, 1e5}},
       "dry friction per inserted length"},
      {"contact.contact_radius_mm", NumberField{ACUS_AT(contact.contact_radius), milli, {0.01, 100.0}},
       "radius of the disc over which a tip load is spread"},
      {"contact.stiffness_N_m", NumberField{ACUS_AT(contact.stiffness), one, {1.0, 1e9}},
       "spring between needle and tissue, k of Eq. 8"},
      {"contact.near_field", SwitchField{ACUS_AT(contact.near_field)},
       "whether the tissue close to the needle, under its tip and along the shaft of a rod, gives way by "
       "what the mesh cannot; false for the mesh alone"},
      {"contact.bevel_share", NumberField{ACUS_AT(contact.bevel_share), one, {0.0, 1.0}},
       "how far from the axis the point of a bevel cuts, as a share of radius cos(bevel), its geometry's"},
      {"contact.coupling", ACUS_CHOICE(contact.coupling, "embedded", "nearest_node"),
       "embedded acts inside the tetrahedra and converges; nearest_node is the paper's Eq. 8-9"},
  };
}

std::vector<SceneKey> hand_keys() {
  return {
      {"hand.kind", ACUS_CHOICE(hand.kind, "steady", "path", "person"),
       "steady pushes at one speed; path follows hand.path; person feels the needle, as the keys from "
       "hand.force_limit_N on say"},
      {"hand.speed_mm_s", NumberField{ACUS_AT(hand.speed), milli, {0.001, 10000.0}},
       "of the hand, when steady; of a person without load"},
      {"hand.travel_mm", NumberField{ACUS_AT(hand.travel), milli, {0.001, 2000.0}},
       "how far the hand goes from first touch, unless it follows hand.path"},
      {"hand.grip_mm", NumberField{ACUS_AT(hand.grip), milli, {0.0, 2000.0}},
       "from the hub to where the hand holds the needle; what is behind the hand hangs free"},
      {"hand.stiffness_N_m", NumberField{ACUS_AT(hand.stiffness), one, {0.0, 1e9}},
       "of the grip between hand and needle; 0 for a needle that goes where the hand goes"},
      {"hand.path", HandPathField{ACUS_AT(hand.path), milli, {0.0, 1e5}, {-1000.0, 2000.0}},
       "[[time in s, travel in mm], ...] joined by straight lines; pauses and withdrawal are welcome"},
  };
}

std::vector<SceneKey> person_keys() {
  return {
      {"hand.force_limit_N", NumberField{ACUS_AT(hand.force_limit), one, {0.01, 200.0}},
       "force at which a person's hand comes to a stand (Hill's law); under more it gives way"},
      {"hand.reaction_s", NumberField{ACUS_AT(hand.reaction), one, {0.0, 5.0}},
       "from what a person feels until the hand does something about it"},
      {"hand.hesitation_s", NumberField{ACUS_AT(hand.hesitation), one, {0.0, 60.0}},
       "how long a person stands still after feeling contact, buckling or puncture; 0 for one who never "
       "does"},
      {"hand.tremor_mm", NumberField{ACUS_AT(hand.tremor), milli, {0.0, 5.0}},
       "root mean square of a person's tremor, 8 to 12 Hz"},
      {"hand.seed", IntegerField{ACUS_AT(hand.seed), {0.0, 1e9}}, "which tremor it is"},
      {"hand.duration_s", NumberField{ACUS_AT(hand.duration), one, {0.001, 1e5}},
       "how long a person pushes at most, and again pulls"},
      {"hand.pulls_back", SwitchField{ACUS_AT(hand.pulls_back)},
       "whether a person then pulls the needle out again"},
  };
}

std::vector<SceneKey> guide_keys() {
  return {
      {"guide.length_mm", NumberField{ACUS_AT(guide.length), milli, {0.0, 2000.0}},
       "of a sleeve, or of the fingers of a second hand, around a rod outside of the tissue; 0 for none"},
      {"guide.gap_mm", NumberField{ACUS_AT(guide.gap), milli, {0.0, 2000.0}},
       "between the tissue at rest and the guide's lower end"},
      {"guide.stiffness_MPa", NumberField{ACUS_AT(guide.stiffness), mega, {1e-3, 1e4}},
       "force per length of needle by which the guide gives way sideways, N/mm per mm; fingers about 1"},
      {"guide.friction_N_m", NumberField{ACUS_AT(guide.friction), one, {0.0, 1e5}},
       "dry friction per length of needle in the guide"},
  };
}

std::vector<SceneKey> run_keys() {
  return {
      {"run.time_step_ms", NumberField{ACUS_AT(run.time_step), milli, {0.01, 20.0}},
       "of the implicit integrator"},
      {"run.solver_precision", ACUS_CHOICE(run.solver_precision, "single", "double"),
       "of the conjugate gradients' iterations and, where the tolerance allows, of rotations and elastic "
       "forces; "
       "single is twice as fast and loses less than the tolerance leaves"},
      {"run.solver_tolerance", NumberField{ACUS_AT(run.solver_tolerance), one, {1e-14, 0.01}},
       "what a solve may leave unbalanced, of the load; 5e-5 moves no force of Fig. 6 by more than 0.01 %"},
      {"run.trace_stride", IntegerField{ACUS_AT(run.trace_stride), {1.0, 1e6}},
       "steps from one row of trace.csv to the next"},
  };
}

#undef ACUS_AT
#undef ACUS_CHOICE

}  // namespace

const std::vector<SceneKey>& scene_keys() {
  static const std::vector<SceneKey> keys = [] {
    std::vector<SceneKey> all;
    for (const auto& part :
         {needle_keys(), tissue_keys(), contact_keys(), hand_keys(), person_keys(), guide_keys(), run_keys()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return keys;
}

const SceneKey* find_scene_key(const std::string& name) {
  const auto& keys = scene_keys();
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const SceneKey& key) { return key.name == name; });
  return found == keys.end() ? nullptr : &*found;
}

std::string in_words(const Range& range) {
  return "from " + decimal_text(range.least) + " to " + decimal_text(range.most);
}

std::string complaint(const Range& range, double value) {
  const bool inside = value >= range.least && value <= range.most;
  if (inside) return {};  // a NaN is never inside
  return "must be " + in_words(range) + ", but is " + decimal_text(value);
}

}  // namespace acus
