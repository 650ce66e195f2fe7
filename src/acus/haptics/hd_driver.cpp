#include "acus/haptics/hd_driver.h"

#include <array>
#include <cstdio>

#include "acus/haptics/shared_library.h"

namespace acus::haptics::hd {

Name Driver::forget_errors() const noexcept {
  constexpr int most = 64;  // a driver that never runs out of errors must not hold us up
  Name first = 0;
  for (int i = 0; i < most; ++i) {
    const Name code = get_error().code;
    if (code == 0) break;
    if (first == 0) first = code;
  }
  return first;
}

std::string Driver::words_of(Name error) const {
  std::array<char, 16> number{};
  std::snprintf(number.data(), number.size(), "0x%04X", error);
  const char* words = get_error_string(error);
  return std::string(words ? words : "unknown error") + " (" + number.data() + ")";
}

Result<Driver> load_driver() {
  static constexpr std::array names = {"libHD.so"};
  Result<SharedLibrary> library =
      SharedLibrary::open({"ACUS_LIBHD", names, "3D Systems' devices",
                           "install OpenHaptics and the device driver of 3D Systems"});
  if (!library) return library.error();
  Driver driver{};
  library->require(driver.init_device, "hdInitDevice");
  library->require(driver.disable_device, "hdDisableDevice");
  library->require(driver.make_current_device, "hdMakeCurrentDevice");
  library->require(driver.begin_frame, "hdBeginFrame");
  library->require(driver.end_frame, "hdEndFrame");
  library->require(driver.get_error, "hdGetError");
  library->require(driver.get_error_string, "hdGetErrorString");
  library->require(driver.enable, "hdEnable");
  library->require(driver.get_doublev, "hdGetDoublev");
  library->require(driver.set_doublev, "hdSetDoublev");
  library->require(driver.get_integerv, "hdGetIntegerv");
  library->require(driver.get_string, "hdGetString");
  library->require(driver.check_calibration, "hdCheckCalibration");
  library->require(driver.update_calibration, "hdUpdateCalibration");
  library->require(driver.schedule_asynchronous, "hdScheduleAsynchronous");
  library->require(driver.unschedule, "hdUnschedule");
  library->require(driver.start_scheduler, "hdStartScheduler");
  library->require(driver.stop_scheduler, "hdStopScheduler");
  library->require(driver.set_scheduler_rate, "hdSetSchedulerRate");
  if (const std::optional<Error> missing = library->complaint()) return *missing;
  return driver;
}

}  // namespace acus::haptics::hd
