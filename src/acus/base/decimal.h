// Decimal text of doubles: the one place where numbers become text and back.
#pragma once

#include <string>

namespace acus {

// The shortest decimal text that reads back as the same double: "0.1", "1e-09", "nan", "inf".
std::string decimal_text(double value);

// value * 10^power, correctly rounded from the shortest decimal of `value`: 0.3 (mm) with power -3 is the
// very double that the literal 0.3e-3 is, which a multiplication by 1e-3 does not promise.
double times_power_of_ten(double value, int power);

}  // namespace acus
