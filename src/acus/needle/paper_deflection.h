// The paper's large deflection of a pinned-pinned needle, Eq. 11-13, exactly as printed.
//
// Where it leaves the exact elastica (elastica.h) of the same end slope and length L:
//   end slope                     20 deg   40 deg   60 deg   80 deg
//   amplitude of Eq. 11 too high   2.4 %   11.5 %     38 %    181 %
// because tan(alpha) stands for the slope of a sine arch only while alpha is small; and at 60 deg the drawn
// curve is 1.14 L long. At 90 deg the amplitude has no limit. Eq. 12-13 themselves are exact.
#pragma once

namespace acus::needle {

// Eq. 12, which is Eq. 13 with Eq. 10 put in: the slope at the ends, rad, 0 <= alpha < pi.
// Symbols: F = load [N] >= 0, F_e = critical_load [N] > 0 (pinned-pinned). Eq. 12 has a root only for F >=
// F_e; below, the needle is straight and alpha = 0.
double end_slope(double load, double critical_load);

// Eq. 11: a = (s / pi) tan(alpha). m
// Symbols: s = span [m], alpha = end_slope [rad], 0 <= alpha < pi/2.
double paper_amplitude(double span, double end_slope);

// Eq. 11: w(x) = a sin(pi x / s), 0 <= x <= s. m
double paper_shape(double x, double span, double end_slope);

}  // namespace acus::needle
