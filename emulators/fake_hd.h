// How tests speak to the emulator of OpenHaptics' libHD.so (fake_hd.cpp), beside the driver's own functions.
#pragma once

extern "C" {

// What the emulated device is, from the next hdInitDevice on. A number below 0 is one that the driver does
// not know.
struct FakeHdSetup {
  const char* model = "Touch";
  int output_dof = 3;
  double max_force = -1.0;       // N
  double max_continuous = -1.0;  // N
  double max_stiffness = -1.0;   // N/mm
  unsigned int calibration = 0x5000;
  int calibration_styles = 0;
  bool refuses = false;  // to be opened
  bool starts = true;    // its scheduler
};

// What the driver saw. Forces are as they were set, whether or not force output is enabled.
struct FakeHdReport {
  double force[3], torque[3];  // N, mN m, of the last frame that ended
  double position[3];          // m, of the hand
  long frames, torques;        // that ended; times that a torque was set
  unsigned long rate;          // Hz, 0 if none was asked for
  long opened;                 // how often
  char name[64];               // it was opened by
  bool default_name;           // it was opened by NULL
  bool open, force_enabled, scheduler_runs, scheduled;
};

void fake_hd_reset();  // as after loading; the device is closed
void fake_hd_setup(const FakeHdSetup* setup);
void fake_hd_report(FakeHdReport* report);
// The forces of all frames so far, the first `most` of them; returns how many.
long fake_hd_history(double (*forces)[3], long most);
// Holds the device still and lets it say these numbers, in the units of the driver.
void fake_hd_pose(const double* position, const double* velocity, const double* transform, int buttons);
void fake_hd_send_hand(double stiffness, double x, double y, double z);  // N/m, m
void fake_hd_raise(unsigned int error);                                  // at the end of the next frame
void fake_hd_unplug();                                                   // callbacks cease
}
