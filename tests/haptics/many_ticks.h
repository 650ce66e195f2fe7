// How long the tests that throw anything at a tick go on: with sanitizers each takes ten times as long.
#pragma once

namespace acus::haptics {

#ifdef ACUS_SANITIZED
inline constexpr long many_ticks = 100'000;
#else
inline constexpr long many_ticks = 1'000'000;
#endif

}  // namespace acus::haptics
