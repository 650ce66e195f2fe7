#include "acus/sim/simulation.h"

#include <algorithm>
#include <cmath>

#include "acus/base/hash.h"
#include "acus/sim/rod_solve.h"
#include "acus/sim/rod_step.h"
#include "acus/sim/step.h"
#include "acus/sim/support.h"
#include "acus/tissue/stress.h"

namespace acus {

struct Simulation::Parts {
  Model model;
  State state;
  Scratch scratch;
  Frame frame;
  std::vector<Event> events;
  StepProbe probe;
};

namespace {

void rod_line_into(std::span<Vec3> out, const Model& m, const State& s) {
  const double last = static_cast<double>(out.size() - 1);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = needle::place_of(s.needle.rod,
                              needle::point_at_arc(m.rod, static_cast<double>(i) / last * m.needle.length));
}

void column_line_into(std::span<Vec3> out, const Model& m, const State& s) {
  const NeedlePlace place = place_needle(m, s);
  const int points = static_cast<int>(out.size());
  const Vec3& along = m.path.direction;
  const needle::Pose hub = hub_pose(m, s.hub_travel);
  const int outside =
      std::clamp(static_cast<int>(std::lround(points * place.free_length / m.needle.length)), 2, points);
  const auto curve = needle::column_curve(m.column, place.free_length, place.shortening);
  for (int i = 0; i < outside; ++i) {
    const auto point = needle::point_at(curve, static_cast<double>(i) / (outside - 1));
    out[i] = hub.position + point.axial * along + point.lateral * hub.director;
  }
  const Vec3 from = out[outside - 1];
  const Vec3 tip = m.path.entry + s.tip_position * along;
  const int inside = points - outside;
  for (int i = 1; i <= inside; ++i)
    out[outside - 1 + i] = from + (tip - from) * (static_cast<double>(i) / inside);
}

}  // namespace

Simulation::Simulation(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Result<Simulation> Simulation::build(const Scene& scene, const mesh::TetMesh* mesh, int threads) {
  if (threads < 1 || threads > most_threads)
    return Error{"a step can be shared by 1 to " + std::to_string(most_threads) + " threads, not by " +
                 std::to_string(threads)};
  auto model = build_model(scene, mesh);
  if (!model) return model.error();
  auto parts = std::make_unique<Parts>();
  parts->model = std::move(*model);
  parts->state = initial_state(parts->model);
  parts->scratch = build_scratch(parts->model, threads);
  if (!parts->model.rigid())
    tissue::corotate_into(parts->scratch.corotation, parts->model.tissue, parts->state.position);
  parts->frame.hand_travel = parts->frame.tip_depth = parts->state.hub_travel;
  parts->frame.free_length = parts->model.needle.length;
  parts->frame.critical_load = critical_load(parts->model.scene);
  constexpr std::size_t most_events =
      4096;  // a step must not allocate; what a very restless hand causes beyond is not kept
  parts->events.reserve(most_events);
  return Simulation(std::move(parts));
}

const Frame& Simulation::step(double hand_travel) {
  Parts& p = *parts_;
  if (p.frame.health != Health::good) return p.frame;
  if (!std::isfinite(hand_travel))
    p.frame.health = Health::not_finite;
  else if (p.model.bends_freely())
    advance_rod(p.model, p.state, p.scratch, hub_pose(p.model, hand_travel), p.frame, p.events, p.probe);
  else
    advance(p.model, p.state, p.scratch, hand_travel, p.frame, p.events, p.probe);
  return p.frame;
}

double Simulation::hand_stiffness() {
  Parts& p = *parts_;
  if (p.state.steps == 0 || p.frame.health != Health::good) return 0.0;
  if (p.model.bends_freely()) return hub_stiffness(p.model, p.state, p.scratch);
  const NeedlePlace place = place_needle(p.model, p.state);
  const double free = needle::column_response(p.model.column, place.free_length, place.shortening).stiffness;
  const double column = free / (1.0 + free * p.model.grip_compliance);    // in series with the grip
  if (p.model.rigid()) return p.state.tip_position < 0.0 ? 0.0 : column;  // not at the stop yet
  // The column in series with what it pushes: P(X - z - h w) = constant + resistance w.
  const double against = resistance(p.model, p.scratch);
  const double both = against + p.model.scene.run.time_step * column;
  return both > 0.0 ? column * against / both : 0.0;
}

const Frame& Simulation::step(const needle::Pose& hub) {
  Parts& p = *parts_;
  if (!p.model.bends_freely()) return step(direction().dot(hub.position - entry()) + p.model.needle.length);
  if (p.frame.health != Health::good) return p.frame;
  needle::Pose led = hub;
  led.tangent.normalize();
  led.director = (hub.director - hub.director.dot(led.tangent) * led.tangent).normalized();
  constexpr double rounding = 1e-9;
  const bool upright =
      std::abs(led.tangent.norm() - 1.0) < rounding && std::abs(led.director.norm() - 1.0) < rounding;
  if (hub.position.allFinite() && upright)  // no number passes a comparison
    advance_rod(p.model, p.state, p.scratch, led, p.frame, p.events, p.probe);
  else
    p.frame.health = Health::not_finite;
  return p.frame;
}

needle::Pose Simulation::hub() const {
  const Parts& p = *parts_;
  return p.model.bends_freely() ? p.state.needle.hub : hub_pose(p.model, p.state.hub_travel);
}

void Simulation::set_probe(const StepProbe& probe) { parts_->probe = probe; }

const Scene& Simulation::scene() const { return parts_->model.scene; }
const Frame& Simulation::frame() const { return parts_->frame; }
std::span<const Event> Simulation::events() const { return parts_->events; }
const mesh::TetMesh& Simulation::tissue() const { return parts_->model.mesh; }
std::span<const Vec3> Simulation::positions() const { return parts_->state.position; }
Vec3 Simulation::entry() const { return parts_->model.path.entry; }
Vec3 Simulation::direction() const { return parts_->model.path.direction; }

std::vector<Vec3> Simulation::velocities() const {
  const Parts& p = *parts_;
  std::vector<Vec3> v(p.state.position.size(), Vec3::Zero());
  for (int i = 0; i < p.model.tissue.free_nodes; ++i) v[i] = numeric::at(p.state.velocity, i);
  return v;
}

std::vector<double> Simulation::von_mises() const {
  std::vector<double> stress(tissue().tets.size());
  von_mises_into(stress);
  return stress;
}

void Simulation::von_mises_into(std::span<double> out) const {
  const Parts& p = *parts_;
  if (!p.model.rigid()) tissue::von_mises_into(out, p.model.tissue, p.state.position);
}

std::vector<Vec3> Simulation::needle_line(int points) const {
  std::vector<Vec3> line(static_cast<std::size_t>(points));
  needle_line_into(line);
  return line;
}

void Simulation::needle_line_into(std::span<Vec3> out) const {
  const Parts& p = *parts_;
  // What is behind the hand is straight.
  const double behind = p.model.scene.hand.grip / p.model.scene.needle.length;
  const std::size_t least = behind > 0.0 && out.size() > 2 ? 1 : 0;
  const std::size_t at_hand = std::clamp(static_cast<std::size_t>(behind * static_cast<double>(out.size())),
                                         least, std::max(out.size(), least + 2) - 2);
  const std::span<Vec3> front = out.subspan(at_hand);
  if (p.model.bends_freely())
    rod_line_into(front, p.model, p.state);
  else
    column_line_into(front, p.model, p.state);
  if (at_hand == 0) return;
  const Vec3 back = (front[0] - front[1]).normalized() * p.model.scene.hand.grip;
  for (std::size_t i = 0; i < at_hand; ++i)
    out[i] = front[0] + (1.0 - static_cast<double>(i) / static_cast<double>(at_hand)) * back;
}

std::uint64_t Simulation::state_hash() const {
  const State& s = parts_->state;
  std::uint64_t hash = hash_seed;
  for (const Vec3& x : s.position) hash = hash_of({x.data(), 3}, hash);
  hash = hash_of(s.velocity, hash);
  hash = hash_of(s.branch.spring, hash);
  hash = hash_of(s.channel.length, hash);
  hash = hash_of(s.channel.elongation, hash);
  const double needle[] = {static_cast<double>(s.steps),
                           s.hub_travel,
                           s.tip_position,
                           s.tip_rate,
                           s.channel_depth,
                           s.tip_elongation};
  hash = hash_of(needle, hash);
  if (!parts_->model.bends_freely()) return hash;
  const RodNeedle& n = s.needle;
  for (const auto* vectors : {&n.rod.position, &n.rod.director})
    for (const Vec3& x : *vectors) hash = hash_of({x.data(), 3}, hash);
  for (const Vec3& x : {n.hub.position, n.hub.tangent, n.hub.director, n.channel_end, n.disc_axis})
    hash = hash_of({x.data(), 3}, hash);
  for (const GuideHold& hold : s.guide) hash = hash_of({&hold.elongation, 1}, hash);
  return hash_of(s.needle.rod.rate, hash);
}

}  // namespace acus
