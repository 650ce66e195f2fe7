// The part of OpenHaptics' HD interface that we use, as functions found in its library when the program runs.
// Types and constants are those of the maker's headers for 64-bit Linux.
#pragma once

#include <string>

#include "acus/base/result.h"

namespace acus::haptics::hd {

using Handle = unsigned int;
using Name = unsigned int;  // of a parameter, a capability or an error
using Schedule = unsigned long;
using Callback = unsigned int (*)(void*);

struct ErrorInfo {
  Name code;
  int internal_code;
  Handle device;
};

inline constexpr Handle invalid_handle = 0xFFFFFFFF;

inline constexpr Name current_buttons = 0x2000;         // 1 int, a bit a button
inline constexpr Name current_position = 0x2050;        // 3, mm
inline constexpr Name current_velocity = 0x2051;        // 3, mm/s
inline constexpr Name current_transform = 0x2052;       // 16, by columns, lengths in mm
inline constexpr Name current_force = 0x2700;           // 3, N
inline constexpr Name current_gimbal_torque = 0x2704;   // 3, mN m
inline constexpr Name device_model_type = 0x2501;       // text
inline constexpr Name output_dof = 0x2554;              // 1 int, 6 where torques can be shown
inline constexpr Name calibration_style = 0x2555;       // 1 int, a bit a style
inline constexpr Name nominal_max_stiffness = 0x2602;   // N/mm
inline constexpr Name nominal_max_force = 0x2603;       // N
inline constexpr Name nominal_max_continuous = 0x2604;  // N
inline constexpr Name force_output = 0x4000;            // a capability

inline constexpr Name calibration_ok = 0x5000;
inline constexpr Name calibration_needs_update = 0x5001;
inline constexpr Name calibration_needs_manual_input = 0x5002;
inline constexpr int calibrates_by_itself = 1 << 1;
inline constexpr int calibrates_in_inkwell = 1 << 2;

inline constexpr unsigned int callback_continue = 1;
inline constexpr unsigned short max_priority = 0xFFFF;

struct Driver {
  Handle (*init_device)(const char* name);
  void (*disable_device)(Handle);
  void (*make_current_device)(Handle);
  void (*begin_frame)(Handle);
  void (*end_frame)(Handle);
  ErrorInfo (*get_error)();
  const char* (*get_error_string)(Name);
  void (*enable)(Name);
  void (*get_doublev)(Name, double*);
  void (*set_doublev)(Name, const double*);
  void (*get_integerv)(Name, int*);
  const char* (*get_string)(Name);
  Name (*check_calibration)();
  void (*update_calibration)(Name style);
  Schedule (*schedule_asynchronous)(Callback, void*, unsigned short priority);
  void (*unschedule)(Schedule);
  void (*start_scheduler)();
  void (*stop_scheduler)();
  void (*set_scheduler_rate)(unsigned long);  // Hz

  // Forgets the errors that the driver remembers; returns the first of them, 0 if there was none.
  Name forget_errors() const noexcept;
  std::string words_of(Name error) const;
};

// From libHD.so, or the file that ACUS_LIBHD names.
Result<Driver> load_driver();

}  // namespace acus::haptics::hd
