// The needle laid over the cells of its channel.
#include "acus/coupling/channel.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <numbers>
#include <numeric>

namespace acus::coupling {
namespace {

constexpr int cells = 20;

Channel some_channel() {
  Channel channel;
  channel.friction = 40.0;               // N/m
  channel.stiffness.assign(cells, 5e4);  // N/m^2
  channel.attachment.resize(cells);
  channel.count = cells;
  return channel;
}
ChannelState empty_state() { return {std::vector<double>(cells, 0.0), std::vector<double>(cells, 0.0)}; }

double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }
double stored(const Channel& channel, const ChannelState& state) {
  double energy = 0.0;
  for (int cell = 0; cell < cells; ++cell)
    energy +=
        0.5 * channel.stiffness[cell] * state.length[cell] * state.elongation[cell] * state.elongation[cell];
  return energy;
}

TEST(Channel, spreads_the_needle_evenly_over_the_cells_it_fills) {
  const Channel channel = some_channel();
  ChannelState state = empty_state();
  cover(state, channel, 3.5e-3, 7e-3);  // stretched to twice its rest length
  for (int cell = 0; cell < 3; ++cell) EXPECT_NEAR(state.length[cell], 2e-3, 1e-15);
  EXPECT_NEAR(state.length[3], 1e-3, 1e-15);
  for (int cell = 4; cell < cells; ++cell) EXPECT_EQ(state.length[cell], 0.0);
}

TEST(Channel, keeps_the_force_where_needle_arrives_and_the_elongation_where_it_leaves) {
  const Channel channel = some_channel();
  ChannelState state = empty_state();
  cover(state, channel, 2e-3, 2e-3);
  state.elongation[0] = state.elongation[1] = 1e-4;
  const double force = channel.stiffness[0] * 1e-3 * 1e-4;
  cover(state, channel, 2e-3, 3e-3);
  EXPECT_NEAR(channel.stiffness[0] * state.length[0] * state.elongation[0], force, 1e-15);
  const double elongation = state.elongation[0];
  cover(state, channel, 1.5e-3, 1.5e-3);
  EXPECT_EQ(state.elongation[0], elongation);
  EXPECT_EQ(state.elongation[1], elongation);
  cover(state, channel, 0.0, 0.0);
  EXPECT_EQ(total(state.length), 0.0);
  EXPECT_EQ(total(state.elongation), 0.0);
}

RC_GTEST_PROP(ChannelProperty, covers_all_of_the_needle_and_only_sets_energy_free, ()) {
  const Channel channel = some_channel();
  ChannelState state = empty_state();
  for (int step = 0; step < 30; ++step) {
    for (double& e : state.elongation) e = *rc::gen::inRange(-800, 800) * 1e-6;
    const double before = stored(channel, state);
    const double depth = *rc::gen::inRange(0, 20'001) * 1e-6;
    const double inserted = depth * *rc::gen::inRange(300, 3000) * 1e-3;
    const double released = cover(state, channel, depth, inserted);
    RC_ASSERT(released >= -1e-15 * before);
    RC_ASSERT(std::abs(before - released - stored(channel, state)) <= 1e-13 * before);
    RC_ASSERT(std::abs(total(state.length) - inserted) <= 1e-14);
    for (double length : state.length) RC_ASSERT(length >= 0.0);
  }
}

TEST(Channel, slides_at_its_friction_times_the_length_inside) {
  const Channel channel = some_channel();
  ChannelState state = empty_state();
  cover(state, channel, 12.3e-3, 11e-3);
  double forward = 0.0, back = 0.0;
  for (int cell = 0; cell < cells; ++cell) {
    const Slider slider = slider_of(channel, state, cell);
    if (state.length[cell] == 0.0) continue;
    forward += advance(slider, 0.1).force;
    back += advance(slider, -0.1).force;
  }
  EXPECT_NEAR(forward, 40.0 * 11e-3, 1e-14);
  EXPECT_NEAR(back, -40.0 * 11e-3, 1e-14);
}

// Antiplane shear of a sleeve between r and R: force per length and displacement w = q ln(R / r) / (2 pi G);
// here R / r = e.
TEST(Channel, sleeve_is_sheared_as_love_says) {
  const double shear_modulus = 8446.0, force_per_length = 40.0;
  const double displacement =
      force_per_length * std::log(std::numbers::e) / (2.0 * std::numbers::pi * shear_modulus);
  EXPECT_NEAR(sleeve_stiffness(shear_modulus) * displacement, force_per_length, 1e-12);
}

}  // namespace
}  // namespace acus::coupling
