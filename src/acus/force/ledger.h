// The energy ledger: where the work of the hand has gone since the start, in joules.
#pragma once

namespace acus::force {

struct Ledger {
  double work_hand = 0.0;       // J, done by the hand on the hub
  double energy_tissue = 0.0;   // J, elastic, in the tissue
  double energy_needle = 0.0;   // J, bending, stretch and twist of the needle
  double energy_contact = 0.0;  // J, springs between needle and tissue (tip contact, pre-sliding)
  double energy_kinetic = 0.0;  // J, tissue and rod
  double work_cutting = 0.0;    // J, never decreases; of a bevel, less what its shaft spreads the tissue with
  double work_friction = 0.0;   // J, never decreases
  double work_damping = 0.0;    // J, Rayleigh, and what the tissue by the tip lets go at a puncture
  double work_relaxation = 0.0;  // J, never decreases; where the tissue relaxes
  double work_numerical = 0.0;   // J, dissipated by the integrator, from its own formulas
  // J, given off where the needle jumps from one equilibrium to another (snaps straight): a real needle goes
  // on to vibrate with it. In smooth motion it vanishes with the time step.
  double work_snap = 0.0;
};

// What has not been lost. J
inline double stored(const Ledger& l) {
  return l.energy_tissue + l.energy_needle + l.energy_contact + l.energy_kinetic;
}

// Where the work went, all lines but the first. J
inline double accounted(const Ledger& l) {
  return stored(l) + l.work_cutting + l.work_friction + l.work_damping + l.work_relaxation +
         l.work_numerical + l.work_snap;
}

// What the ledger cannot explain. J
inline double residual(const Ledger& l) { return l.work_hand - accounted(l); }

}  // namespace acus::force
