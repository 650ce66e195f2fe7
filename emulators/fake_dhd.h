// How tests speak to the emulator of Force Dimension's libdhd.so (fake_dhd.cpp), beside the driver's own
// functions.
#pragma once

extern "C" {

// The call that fails from now on; `everything` is a device that was unplugged.
enum FakeDhdFailure {
  fake_dhd_nothing,
  fake_dhd_everything,
  fake_dhd_read_fails,
  fake_dhd_force_fails,
  fake_dhd_open_fails
};

// What the driver saw. Forces are as they were set, whether or not force is enabled.
struct FakeDhdReport {
  double force[3];     // N, the last that was set
  double position[3];  // m, of the hand
  long forces;         // times that one was set
  int index, watchdog;
  bool open, force_enabled;
};

void fake_dhd_reset();  // as after loading; the device is closed
void fake_dhd_report(FakeDhdReport* report);
void fake_dhd_fail(FakeDhdFailure failure);
void fake_dhd_calibrate(bool calibrated);
// Holds the device still and lets it say these numbers; the frame is by rows.
void fake_dhd_pose(const double* position, const double* velocity, const double* frame, int button);
void fake_dhd_send_hand(double stiffness, double x, double y, double z);  // N/m, m
}
