// The bits of a number as another type: std::bit_cast, which libc++ 13 does not have.
#pragma once

#include <cstring>
#include <type_traits>

namespace acus {

template <class To, class From>
To bits_as(From from) {
  static_assert(sizeof(To) == sizeof(From));
  static_assert(std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
  To to;
  std::memcpy(&to, &from, sizeof(to));
  return to;
}

}  // namespace acus
