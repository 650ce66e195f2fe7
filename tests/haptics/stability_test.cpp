// A spring rendered through a sampled loop: the simulated device loses stability where theory says, so that
// what it says of other loops can be believed.
#include <gtest/gtest.h>

#include "acus/haptics/virtual_coupling.h"
#include "sampled_spring.h"

namespace acus::haptics {
namespace {

// K_max = b / (T/2 + t_d): Gil, Sanchez, Hulin et al. (2009), "Stability boundary for haptic rendering:
// influence of damping and delay"; 200 N/m for b = 0.1 N s/m, T = 1 ms and no delay.
TEST(Handle, loses_stability_where_the_theory_of_sampled_springs_says) {
  for (double b : {0.05, 0.1})
    for (double delay : {0.0, 0.5e-3, 1e-3, 2e-3, 5e-3}) {
      constexpr double T = 1e-3;
      const double theory = b / (T / 2.0 + delay);
      SCOPED_TRACE(testing::Message() << "b " << b << " delay " << delay);
      DeviceLimits limits;
      limits.mass = 0.045;
      limits.viscous = b;
      limits.delay = delay;
      double stable = 0.9 * theory, unstable = 1.2 * theory;
      ASSERT_LT(growth(stable, 0.0, no_hand, limits, T), 1.0);
      ASSERT_GT(growth(unstable, 0.0, no_hand, limits, T), 1.0);
      while (unstable - stable > 0.01 * theory) {
        const double K = 0.5 * (stable + unstable);
        (growth(K, 0.0, no_hand, limits, T) > 1.0 ? unstable : stable) = K;
      }
      EXPECT_NEAR(0.5 * (stable + unstable), theory, 0.02 * theory);
    }
}

// Even where nothing but the coupling holds the handle, and nothing but its own friction helps.
TEST(VirtualCoupling, has_a_gain_margin_of_two_on_every_device) {
  for (const DeviceLimits& device : known_devices()) {
    const VirtualCoupling coupling = coupling_for(device);
    EXPECT_LT(growth(1.95 * coupling.stiffness, coupling.damping, no_hand, device, 1e-3), 1.0) << device.name;
  }
}

}  // namespace
}  // namespace acus::haptics
