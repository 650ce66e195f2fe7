#include "acus/sim/support.h"

#include <algorithm>

#include "acus/needle/buckling.h"

namespace acus {
namespace {

using needle::Support;

// With a clamp in place of the hub.
Support below_guide(Support support) {
  return support == Support::pinned_pinned ? Support::clamped_pinned : support;
}
double load_of(const Span& span, double bending_rigidity) {
  return needle::critical_load(bending_rigidity, span.length, span.support);
}

}  // namespace

needle::NeedleSpec in_front_of_hand(const Scene& scene) {
  needle::NeedleSpec part = scene.needle;
  if (scene.hand.grip == 0.0) return part;
  part.length -= scene.hand.grip;
  part.imperfection *= part.length / scene.needle.length;
  return part;
}

Support above_guide(Support support) {
  return support == Support::pinned_pinned ? Support::clamped_pinned : Support::clamped_clamped;
}

Span weakest_span(const Scene& scene, double free_length) {
  const Support support = scene.needle.support;
  const GuideScene& guide = scene.guide;
  const double stub = needle::shortest_column * scene.needle.radius;
  if (guide.length == 0.0 || guide.gap >= free_length) return {std::max(free_length, stub), support};
  const Span below{std::max(guide.gap, stub), below_guide(support)};
  const Span above{std::max(free_length - guide.gap - guide.length, stub), above_guide(support)};
  return load_of(below, 1.0) < load_of(above, 1.0) ? below : above;
}

double critical_load(const Scene& scene, double free_length) {
  return load_of(weakest_span(scene, free_length), needle::bending_rigidity(scene.needle));
}

double critical_load(const Scene& scene) { return critical_load(scene, in_front_of_hand(scene).length); }

}  // namespace acus
