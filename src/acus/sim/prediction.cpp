#include "acus/sim/prediction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "acus/needle/buckling.h"
#include "acus/needle/elastica.h"
#include "acus/sim/hand.h"

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

// Three significant digits, zeros too.
std::string newtons(double force) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%#.3g", force);
  std::string digits = text.data();
  if (digits.back() == '.') digits.pop_back();
  return digits + " N";
}

}  // namespace

double half_space_sink(double force, const TissueScene& tissue, double disc_radius) {
  const double nu = tissue.poisson_ratio;
  constexpr double pi = std::numbers::pi;
  return 16.0 * (1.0 - nu * nu) * force / (3.0 * pi * pi * tissue.youngs_modulus * disc_radius);
}

Prediction predict(const Scene& scene) {
  const needle::NeedleSpec& spec = scene.needle;
  const double rupture_force = scene.contact.rupture_force;
  const double rigidity = needle::bending_rigidity(spec);
  Prediction p{};
  p.critical_load = needle::critical_load(rigidity, spec.length, spec.support);
  p.sink =
      scene.tissue.rigid ? 0.0 : half_space_sink(rupture_force, scene.tissue, scene.contact.contact_radius);
  const double travel = std::max(furthest_travel(scene.hand), 0.0);
  // Straight, needle and tissue are springs in series, and the tissue is much the softer one.
  const bool comes_to_buckle = travel * rupture_force >= p.sink * p.critical_load && travel > 0.0;
  p.highest_load = comes_to_buckle
                       ? p.critical_load * highest_load_ratio(spec.support, (travel - p.sink) / spec.length)
                       : (travel > 0.0 ? travel / p.sink * rupture_force : 0.0);
  p.longest_straight = spec.length * std::sqrt(p.critical_load / rupture_force);
  if (scene.tissue.rigid || p.highest_load < rupture_force)
    p.outcome = Outcome::never_punctured;
  else
    p.outcome =
        p.critical_load < rupture_force ? Outcome::buckled_then_punctured : Outcome::straight_puncture;
  return p;
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
  if (p.highest_load < p.critical_load)
    return "within the hand's travel the needle presses with at most about " + most +
           ", the tissue ruptures at " + rupture + ": this hand does not go far enough";
  return buckles + " and pushes at most " + most + " when bent, the tissue ruptures at " + rupture +
         ": this needle will not go in";
}

}  // namespace acus
