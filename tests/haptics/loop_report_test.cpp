// What the loop says about itself.
#include "acus/haptics/loop_report.h"

#include <gtest/gtest.h>

namespace acus::haptics {
namespace {

TEST(DurationHistogram, gives_quantiles_to_the_width_of_a_bin) {
  DurationHistogram histogram;
  for (int i = 1; i <= 10000; ++i) histogram.add(i * 1e-6);  // evenly from 1 us to 10 ms
  EXPECT_EQ(histogram.count(), 10000);
  EXPECT_NEAR(histogram.mean(), 5.0005e-3, 1e-9);
  EXPECT_DOUBLE_EQ(histogram.longest(), 10e-3);
  for (double q : {0.1, 0.5, 0.9, 0.999})
    EXPECT_NEAR(histogram.quantile(q), q * 10e-3, 0.09 * q * 10e-3) << q;
  EXPECT_DOUBLE_EQ(histogram.quantile(1.0), 10e-3);
  EXPECT_NEAR(static_cast<double>(histogram.longer_than(5e-3)), 5000.0, 500.0);
}

TEST(DurationHistogram, stands_what_is_no_duration) {
  DurationHistogram histogram;
  EXPECT_EQ(histogram.quantile(0.5), 0.0);
  for (double odd : {0.0, -1.0, 1e300}) histogram.add(odd);
  EXPECT_EQ(histogram.count(), 3);
  EXPECT_EQ(histogram.longer_than(1.0), 1);
}

LoopReport report_of(double step) {
  LoopReport report;
  for (int i = 0; i < 998; ++i) report.period.add(1e-3), report.work.add(2e-6);
  report.period.add(3e-3), report.period.add(9e-3);
  report.time_step = 5e-3;
  report.wall_time = 10.0;
  for (int i = 0; i < 100; ++i) report.step.add(step);
  report.simulated_time = std::min(10.0, 10.0 * 5e-3 / step);
  return report;
}

TEST(LoopReport, counts_late_ticks) {
  EXPECT_NE(in_words(report_of(2e-3)).find("1000, every 1.010 ms; 2 late"), std::string::npos)
      << in_words(report_of(2e-3));
}

TEST(LoopReport, says_whether_the_scene_is_too_heavy_and_what_helps) {
  EXPECT_NE(in_words(report_of(2e-3)).find("40 %"), std::string::npos);
  const std::string heavy = in_words(report_of(10e-3));
  EXPECT_NE(heavy.find("0.50 times real time"), std::string::npos) << heavy;
  EXPECT_NE(heavy.find("tissue.tetrahedra"), std::string::npos);
}

TEST(LoopReport, names_the_fault_that_turned_the_force_off) {
  LoopReport report = report_of(2e-3);
  EXPECT_EQ(in_words(report).find("force off"), std::string::npos);
  for (GateFault fault :
       {GateFault::not_finite, GateFault::stale, GateFault::over_speed, GateFault::overheated}) {
    report.fault = fault;
    EXPECT_NE(in_words(report).find("force off: " + in_words(fault)), std::string::npos);
    EXPECT_GT(in_words(fault).size(), 10u);
  }
}

}  // namespace
}  // namespace acus::haptics
