#include "acus/sim/prediction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "acus/base/units.h"
#include "acus/force/fracture.h"
#include "acus/needle/buckling.h"
#include "acus/needle/elastica.h"
#include "acus/numeric/root.h"
#include "acus/sim/hand.h"
#include "acus/sim/support.h"

namespace acus {
namespace {

// Largest load of the elastica up to an end shortening, as a multiple of the critical load. The load need not
// grow all the way: clamped_pinned is highest at a shortening of 0.46.
double highest_load_ratio(needle::Support support, double shortening_ratio) {
  constexpr int samples = 100;  // the curve is smooth: its top is met to 1e-4
  const double furthest = std::clamp(shortening_ratio, 0.0, needle::max_shortening_ratio(support));
  double highest = 1.0;
  for (int i = 1; i <= samples; ++i)
    highest = std::max(highest, needle::elastica(support, furthest * i / samples).load_ratio);
  return highest;
}

// After a straight puncture at `sink` the tip goes on with the hand: cutting and friction grow with its
// depth, and the free part, which is shorter by as much, must carry them. Where it first cannot.
std::optional<ExpectedBuckling> buckling_inside(const Scene& scene, double sink, double travel) {
  const needle::NeedleSpec spec = in_front_of_hand(scene);
  const double cutting =
      force::cutting_force(scene.contact.fracture_toughness, scene.contact.crack, spec.radius);
  const auto load = [&](double depth) { return cutting + scene.contact.friction * depth; };
  const auto room = [&](double depth) { return critical_load(scene, spec.length - depth) - load(depth); };
  constexpr int samples = 200;  // the load is a line and the critical load a smooth curve above or across it
  const double deepest = std::min(travel, spec.length - needle::shortest_column * spec.radius);
  double before = sink;
  if (deepest <= sink) return std::nullopt;
  if (room(sink) <= 0.0) return ExpectedBuckling{load(sink), sink, true};
  for (int i = 1; i <= samples; ++i) {
    const double depth = sink + (deepest - sink) * i / samples;
    if (room(depth) <= 0.0) {
      const double first = numeric::bracketed_root(room, before, depth);
      return ExpectedBuckling{load(first), first, true};
    }
    before = depth;
  }
  return std::nullopt;
}

std::optional<ExpectedBuckling> first_buckling(const Scene& scene, const Prediction& p, double travel) {
  const double most =
      scene.hand.kind == HandKind::person ? scene.hand.force_limit : std::numeric_limits<double>::infinity();
  std::optional<ExpectedBuckling> buckling;
  if (p.outcome == Outcome::straight_puncture)
    buckling = buckling_inside(scene, p.sink, travel);
  else if (p.highest_load >= p.critical_load && travel > 0.0)
    buckling = {p.critical_load, p.sink * p.critical_load / scene.contact.rupture_force, false};
  return buckling && buckling->load <= most ? buckling : std::nullopt;
}

// Three significant digits, zeros too.
std::string three_digits(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%#.3g", value);
  std::string digits = text.data();
  if (digits.back() == '.') digits.pop_back();
  return digits;
}

std::string newtons(double force) { return three_digits(force) + " N"; }
std::string millimetres(double length) { return three_digits(length / units::mm) + " mm"; }

// Rounded down: what is held shorter stays straight for certain.
std::string at_most_millimetres(double length) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f mm", std::floor(length / units::mm * 10.0) / 10.0);
  return text.data();
}

}  // namespace

double half_space_sink(double force, const TissueScene& tissue, double disc_radius) {
  const double nu = tissue.poisson_ratio;
  constexpr double pi = std::numbers::pi;
  return 16.0 * (1.0 - nu * nu) * force / (3.0 * pi * pi * tissue.youngs_modulus * disc_radius);
}

Prediction predict(const Scene& scene) {
  const Span span = weakest_span(scene, in_front_of_hand(scene).length);
  const double rupture_force = scene.contact.rupture_force;
  Prediction p{};
  p.critical_load = critical_load(scene);
  p.sink =
      scene.tissue.rigid ? 0.0 : half_space_sink(rupture_force, scene.tissue, scene.contact.contact_radius);
  const double travel = std::max(furthest_travel(scene.hand), 0.0);
  // Straight, needle and tissue are springs in series, and the tissue is much the softer one.
  const bool comes_to_buckle = travel * rupture_force >= p.sink * p.critical_load && travel > 0.0;
  p.highest_load = comes_to_buckle
                       ? p.critical_load * highest_load_ratio(span.support, (travel - p.sink) / span.length)
                       : (travel > 0.0 ? travel / p.sink * rupture_force : 0.0);
  if (scene.hand.kind == HandKind::person) p.highest_load = std::min(p.highest_load, scene.hand.force_limit);
  p.longest_straight = span.length * std::sqrt(p.critical_load / rupture_force);
  const double between_clamps =
      needle::critical_load(needle::bending_rigidity(scene.needle), 1.0, above_guide(scene.needle.support));
  p.longest_in_sleeve = std::sqrt(between_clamps / rupture_force);
  p.least_radius = scene.needle.radius * std::sqrt(std::sqrt(rupture_force / p.critical_load));
  if (scene.tissue.rigid || p.highest_load < rupture_force)
    p.outcome = Outcome::never_punctured;
  else
    p.outcome =
        p.critical_load < rupture_force ? Outcome::buckled_then_punctured : Outcome::straight_puncture;
  p.buckling = first_buckling(scene, p, travel);
  return p;
}

std::string buckling_in_words(const Scene& scene, const Prediction& p) {
  if (!p.buckling) return "It does not buckle within this hand's travel and force.";
  if (scene.tissue.rigid) return "It buckles at " + newtons(p.buckling->load) + ", as soon as it is pressed.";
  const std::string where =
      newtons(p.buckling->load) + ", about " + millimetres(p.buckling->hand_travel) + " into the push";
  return p.buckling->inside ? "It goes in straight and buckles outside of the tissue later, at " + where +
                                  ", when cutting and friction have grown to what the free part carries."
                            : "It buckles before the puncture, at " + where + ".";
}

std::vector<std::string> remedies_in_words(const Scene& scene, const Prediction& p) {
  if (scene.tissue.rigid) return {};
  const double rupture_force = scene.contact.rupture_force;
  const std::string rupture = newtons(rupture_force), longest = at_most_millimetres(p.longest_straight);
  const bool guided = scene.guide.length > 0.0;
  if (p.critical_load >= rupture_force)
    return {(guided ? "With the same tip a span outside of hand and guide could be up to "
                    : "With the same tip it could be up to ") +
                longest + " long and not buckle before the puncture.",
            "Or its radius could be as little as " + millimetres(p.least_radius) + ".",
            "Or the tissue could resist with up to " + newtons(p.critical_load) + "."};
  std::vector<std::string> remedies = {
      (guided ? "A hand and a guide that leave spans of at most " : "A grip that leaves at most ") + longest +
          " free keeps it straight up to " + rupture + ".",
      "So does a radius of at least " + millimetres(p.least_radius) + " at this length.",
      "So does a tip sharp enough to go in at less than " + newtons(p.critical_load) + "."};
  if (!guided)
    remedies.push_back("So does a sleeve that stands on the tissue and leaves at most " +
                       at_most_millimetres(p.longest_in_sleeve) + " of it free.");
  return remedies;
}

std::string in_words(const Scene& scene, const Prediction& p) {
  const std::string buckles = "buckles at " + newtons(p.critical_load);
  const std::string most = newtons(p.highest_load), rupture = newtons(scene.contact.rupture_force);
  if (scene.tissue.rigid)
    return buckles + " against a fixed stop and carries at most " + most + " within the hand's travel";
  switch (p.outcome) {
    case Outcome::straight_puncture:
      return "the tissue ruptures at " + rupture + ", the needle " + buckles +
             ": this needle will go in straight";
    case Outcome::buckled_then_punctured:
      return buckles + ", the tissue ruptures at " + rupture + ", and bent the needle still pushes up to " +
             most + ": this needle will bow and go in all the same";
    case Outcome::never_punctured:
      break;
  }
  if (scene.hand.kind == HandKind::person && p.highest_load == scene.hand.force_limit)
    return "the person pushes with at most " + most + ", the tissue ruptures at " + rupture +
           ": this needle will not go in";
  if (p.highest_load < p.critical_load)
    return "within the hand's travel the needle presses with at most about " + most +
           ", the tissue ruptures at " + rupture + ": this hand does not go far enough";
  return buckles + " and pushes at most " + most + " when bent, the tissue ruptures at " + rupture +
         ": this needle will not go in";
}

}  // namespace acus
