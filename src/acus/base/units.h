// Everything inside acus is SI; these factors turn a number in the named unit into SI.
#pragma once

namespace acus::units {

inline constexpr double mm = 1e-3;
inline constexpr double ms = 1e-3;
inline constexpr double kPa = 1e3;
inline constexpr double GPa = 1e9;

}  // namespace acus::units
