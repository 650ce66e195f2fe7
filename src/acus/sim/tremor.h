// The tremor of a hand: what it does without being asked.
#pragma once

namespace acus {

// Physiological tremor at `time` [s] after the hand took hold: five sines between 8 and 12 Hz of equal size,
// whose phases follow from `seed`, of `rms` [m] together. It grows from nothing over the first half second
// and repeats itself after 2.5 s. m
double tremor(double rms, int seed, double time);

// The farthest that it can come from where the hand wants to be. m
double furthest_tremor(double rms);

// The fastest that it can move. m/s
double fastest_tremor(double rms);

}  // namespace acus
