// A root of a continuous function inside a bracket. Never allocates, never throws, always ends.
#pragma once

#include <cassert>
#include <cmath>
#include <limits>

namespace acus::numeric {

// x between `a` and `b` with f(x) = 0, to within `tolerance` (same unit as x; 0 asks for the last bits).
// f(a) and f(b) must differ in sign (or one of them be zero). Chandrupatla's method (Adv. Eng. Software 28,
// 1997): inverse quadratic interpolation where it can be trusted, else bisection; the bracket never opens.
template <class Function>
double bracketed_root(Function&& f, double a, double b, double tolerance = 0.0) {
  // Bisection alone needs about 60 halvings of an ordinary bracket; the rest is for brackets around zero.
  constexpr int max_evaluations = 200;
  double fa = f(a);
  double fb = f(b);
  if (fa == 0.0) return a;
  if (fb == 0.0) return b;
  assert((fa < 0.0) != (fb < 0.0));
  double old = a;  // the point before the last two
  double f_old = fa;
  double fraction = 0.5;
  for (int i = 0; i < max_evaluations; ++i) {
    const double x = a + fraction * (b - a);
    const double fx = f(x);
    if ((fx < 0.0) == (fa < 0.0)) {
      old = a;
      f_old = fa;
    } else {
      old = b;
      f_old = fb;
      b = a;
      fb = fa;
    }
    a = x;
    fa = fx;
    const double best = std::abs(fa) < std::abs(fb) ? a : b;
    const double resolution = 2.0 * std::numeric_limits<double>::epsilon() * std::abs(best) + 0.5 * tolerance;
    const double width = std::abs(b - a);
    if (fa == 0.0 || width <= 2.0 * resolution) return fa == 0.0 ? a : best;
    const double xi = (a - b) / (old - b);
    const double phi = (fa - fb) / (f_old - fb);
    const bool interpolate = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
    fraction = interpolate ? fa / (fb - fa) * f_old / (fb - f_old) +
                                 (old - a) / (b - a) * fa / (f_old - fa) * fb / (f_old - fb)
                           : 0.5;
    const double least = resolution / width;
    fraction = std::fmin(std::fmax(fraction, least), 1.0 - least);
  }
  return std::abs(fa) < std::abs(fb) ? a : b;
}

}  // namespace acus::numeric
