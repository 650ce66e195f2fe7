#include "acus/sim/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "acus/base/decimal.h"
#include "acus/sim/hand.h"
#include "acus/sim/hill.h"
#include "acus/sim/scene_keys.h"
#include "acus/sim/support.h"
#include "acus/sim/tremor.h"

namespace acus {
namespace {

using Complaint = std::optional<std::string>;  // begins with the key it is about

std::string in_mm(double metres) { return decimal_text(times_power_of_ten(metres, 3)) + " mm"; }

// Each field on its own: finite and inside the range of its key.
struct RangeCheck {
  Scene& scene;

  std::string operator()(const NumberField& f) const {
    return complaint(f.range, times_power_of_ten(f.of(scene), -f.power));
  }
  std::string operator()(const IntegerField& f) const { return complaint(f.range, f.of(scene)); }
  std::string operator()(const VectorField& f) const {
    for (double component : f.of(scene))
      if (auto said = complaint(f.range, times_power_of_ten(component, -f.power)); !said.empty())
        return "has a component that " + said;
    return {};
  }
  std::string operator()(const HandPathField& f) const {
    for (const HandPoint& point : f.of(scene)) {
      if (auto said = complaint(f.time, point.time); !said.empty()) return "has a time in s that " + said;
      const double travel = times_power_of_ten(point.travel, -f.travel_power);
      if (auto said = complaint(f.travel, travel); !said.empty()) return "has a travel in mm that " + said;
    }
    return {};
  }
  std::string operator()(const ChoiceField& f) const {
    const int chosen = f.get(scene);
    return chosen >= 0 && chosen < static_cast<int>(f.names.size()) ? "" : "must be one of its named choices";
  }
  std::string operator()(const SwitchField&) const { return {}; }
  std::string operator()(const FileField&) const { return {}; }
};

constexpr double least_slenderness = 20.0;  // length / radius below which beam theory is no longer fair

Complaint needle_complaint(const Scene& scene) {
  const needle::NeedleSpec& needle = scene.needle;
  constexpr double largest_bow = 0.01;  // of the length: an imperfection, not a bent needle
  if (needle.length < least_slenderness * needle.radius)
    return "needle.radius_mm must be at most 1/20 of needle.length_mm, which allows " +
           in_mm(needle.length / least_slenderness) + ", but is " + in_mm(needle.radius);
  constexpr double thinnest_wall = 0.01;  // of the radius: thinner, it dents before it bends
  if (needle.inner_radius > (1.0 - thinnest_wall) * needle.radius)
    return "needle.inner_radius_mm must be at most 0.99 of needle.radius_mm, which allows " +
           in_mm((1.0 - thinnest_wall) * needle.radius) + ", but is " + in_mm(needle.inner_radius);
  constexpr double sharpest_bevel = 5.0;  // degrees: a face of more than eleven diameters is no tip
  if (needle.bevel_degrees > 0.0 && needle.bevel_degrees < sharpest_bevel)
    return "needle.bevel_deg must be 0 for a tip without a side, or from 5 to 90, but is " +
           decimal_text(needle.bevel_degrees);
  if (needle.bevel_degrees > 0.0 && scene.needle_model != NeedleModel::rod)
    return "needle.bevel_deg is for needle.model = \"rod\"; a column's tip has no side; set the model or "
           "remove the bevel";
  if (needle.imperfection > largest_bow * needle.length)
    return "needle.imperfection_mm must be at most 1/100 of needle.length_mm, which allows " +
           in_mm(largest_bow * needle.length) + ", but is " + in_mm(needle.imperfection);
  return {};
}

Complaint tissue_complaint(const Scene& scene) {
  const TissueScene& tissue = scene.tissue;
  if (tissue.rigid && !tissue.mesh.empty())
    return "tissue.mesh names a mesh while tissue.rigid puts a fixed stop in its place; remove one of the "
           "two";
  if (!(tissue.direction.norm() > 0.0))
    return "tissue.direction must point somewhere, for example [0, 0, -1], but all its components are 0";
  return {};
}

Complaint contact_complaint(const Scene& scene) {
  const ContactScene& contact = scene.contact;
  if (contact.contact_radius < scene.needle.radius)
    return "contact.contact_radius_mm must be at least needle.radius_mm, which is " +
           in_mm(scene.needle.radius) + ", but is " + in_mm(contact.contact_radius);
  const bool block = !scene.tissue.rigid && scene.tissue.mesh.empty();
  constexpr double largest_disc = 0.25;  // of the block's smallest side, so that the disc lies well inside
  const double side = scene.tissue.size.minCoeff();
  if (block && contact.contact_radius > largest_disc * side)
    return "contact.contact_radius_mm must be at most a quarter of the smallest side in tissue.size_mm, "
           "which allows " +
           in_mm(largest_disc * side) + ", but is " + in_mm(contact.contact_radius);
  return {};
}

Complaint path_complaint(const Scene& scene) {
  const auto& path = scene.hand.path;
  if (path.size() < 2)
    return "hand.path must hold at least two points, as in [[0, 0], [5, 50]], but holds " +
           std::to_string(path.size());
  if (path.front().time != 0.0)
    return "hand.path must begin at time 0, but begins at " + decimal_text(path.front().time) + " s";
  if (path.front().travel > 0.0)
    return "hand.path must begin at first touch or before it, at a travel of 0 mm or less, but begins at " +
           in_mm(path.front().travel);
  for (std::size_t i = 1; i < path.size(); ++i)
    if (!(path[i].time > path[i - 1].time))
      return "hand.path must have increasing times, but " + decimal_text(path[i].time) + " s follows " +
             decimal_text(path[i - 1].time) + " s";
  return {};
}

double highest_speed(const HandScene& hand) {
  if (hand.kind == HandKind::steady) return hand.speed;
  if (hand.kind == HandKind::person) return hand.speed + fastest_tremor(hand.tremor);
  double highest = 0.0;
  for (std::size_t i = 1; i < hand.path.size(); ++i) {
    const HandPoint &from = hand.path[i - 1], &to = hand.path[i];
    highest = std::max(highest, std::abs(to.travel - from.travel) / (to.time - from.time));
  }
  return highest;
}

Complaint hand_complaint(const Scene& scene) {
  const HandScene& hand = scene.hand;
  if (hand.kind != HandKind::path && !hand.path.empty())
    return std::string("hand.path is given, but hand.kind is \"") +
           (hand.kind == HandKind::steady ? "steady" : "person") +
           "\"; set hand.kind = \"path\" or remove the path";
  if (hand.kind == HandKind::path)
    if (auto said = path_complaint(scene)) return said;
  const std::string travel_key = hand.kind == HandKind::path ? "hand.path" : "hand.travel_mm";
  // A shorter stub outside the tissue is no column any more.
  const double front = in_front_of_hand(scene).length;
  if (hand.grip > 0.0 && front < least_slenderness * scene.needle.radius)
    return "hand.grip_mm must leave 20 needle radii in front of the hand, so be at most " +
           in_mm(scene.needle.length - least_slenderness * scene.needle.radius) + ", but is " +
           in_mm(hand.grip);
  const double furthest = front - needle::shortest_column * scene.needle.radius;
  if (furthest_travel(hand) > furthest)
    return travel_key + " must leave 10 needle radii between hand and tissue, so reach at most " +
           in_mm(furthest) + ", but reaches " + in_mm(furthest_travel(hand));
  return {};
}

Complaint guide_complaint(const Scene& scene) {
  if (scene.guide.length > 0.0 && scene.needle_model != NeedleModel::rod)
    return "guide.length_mm is for needle.model = \"rod\"; a column knows of no guide; set the model or "
           "remove the guide";
  const double front = in_front_of_hand(scene).length;
  if (scene.guide.length > 0.0 && scene.guide.gap >= front)
    return "guide.gap_mm must be less than what is in front of the hand, " + in_mm(front) + ", but is " +
           in_mm(scene.guide.gap);
  return {};
}

// N/m, most that the force can rise by for each metre of the hand, where needle and tissue meet.
double stiffest_contact(const Scene& scene) {
  const needle::NeedleSpec& needle = scene.needle;
  double give = grip_compliance(scene.hand);
  give += in_front_of_hand(scene).length / needle::axial_rigidity(needle);
  if (!scene.tissue.rigid) give += 1.0 / scene.contact.stiffness;
  return 1.0 / give;
}

// A person's speed follows the force of the step before. As long as a step lets the force rise by no more
// than what takes the speed away, the force comes to the limit from below and never passes it.
Complaint person_complaint(const Scene& scene) {
  const HandScene& hand = scene.hand;
  if (hand.kind != HandKind::person) return {};
  const double stiffness = stiffest_contact(scene);
  const double longest = 1.0 / (hill_steepest_fall(hand.speed, hand.force_limit) * stiffness);
  if (scene.run.time_step <= longest) return {};
  const double softest = std::floor(stiffness * longest / scene.run.time_step);
  const double longest_us = std::floor(times_power_of_ten(longest, 6));
  return "run.time_step_ms is too long for a person who comes to a stand at " +
         decimal_text(hand.force_limit) + " N: the force would jump past it; take at most " +
         decimal_text(times_power_of_ten(longest_us, -3)) +
         " ms, or a softer grip, hand.stiffness_N_m = " + decimal_text(softest) + " or less";
}

Complaint run_complaint(const Scene& scene) {
  const double step = scene.run.time_step, end = duration(scene.hand);
  constexpr double most_steps = 1e8;  // a day at the haptic rate
  if (end < step)
    return "run.time_step_ms must be shorter than the movement of the hand, which takes " +
           decimal_text(end) + " s";
  if (end / step > most_steps)
    return "run.time_step_ms makes " + decimal_text(std::round(end / step)) +
           " steps of the movement of the hand; at most 1e+08 are allowed";
  const double advance = highest_speed(scene.hand) * step;
  if (advance > scene.contact.contact_radius)
    return "run.time_step_ms is too long for a hand that moves at " + in_mm(highest_speed(scene.hand)) +
           "/s: it may go at most contact.contact_radius_mm, " + in_mm(scene.contact.contact_radius) +
           ", in one step, but goes " + in_mm(advance);
  return person_complaint(scene);
}

}  // namespace

Result<Scene> validated(Scene scene) {
  for (const SceneKey& key : scene_keys())
    if (std::string said = std::visit(RangeCheck{scene}, key.field); !said.empty())
      return Error{key.name + " " + said};
  for (auto check : {needle_complaint, tissue_complaint, contact_complaint, hand_complaint, guide_complaint,
                     run_complaint})
    if (Complaint said = check(scene)) return Error{*said};
  // A direction that is already of unit length keeps its bits.
  constexpr double rounding = 1e-15;
  const double norm = scene.tissue.direction.norm();
  if (std::abs(norm - 1.0) > rounding) scene.tissue.direction /= norm;
  return scene;
}

}  // namespace acus
