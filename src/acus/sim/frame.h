// Frame: what is seen of one step from outside. All SI; forces are positive when they push the hand back out.
#pragma once

#include "acus/base/vec.h"
#include "acus/force/ledger.h"

namespace acus {

enum class Stage { free, contact, buckled, inserted, inserted_buckled, withdrawn };
enum class EventKind { contact, buckling, straightening, puncture, second_buckling, layer, exit };
// A step that went wrong says so here; the state is then no longer advanced.
enum class Health { good, solver_broke_down, not_finite, needle_folded, hub_at_entry };

struct Frame {
  double time = 0.0;             // s
  double hand_travel = 0.0;      // m, from first touch
  double hand_force = 0.0;       // N, reaction at the hub
  double energy_force = 0.0;     // N, Eq. 14-18 over energy_force_travel
  double tip_force = 0.0;        // N, contact or cutting at the tip
  double shaft_force = 0.0;      // N, along the path, friction of the tissue on the shaft
  double tip_depth = 0.0;        // m, of the tip below the undeformed entry
  double tip_aside = 0.0;        // m, of the tip from the straight path
  double inserted_length = 0.0;  // m, of needle inside tissue
  double free_length = 0.0;      // m, of needle outside tissue
  double critical_load = 0.0;    // N, closed form on the present free length
  double deflection = 0.0;       // m, largest lateral distance of the free part from the line hub-entry
  // What the hand does on the needle, about where it holds it; hand_force is the part along the path. A
  // column knows no other.
  Vec3 hub_force{0.0, 0.0, 0.0};   // N
  Vec3 hub_moment{0.0, 0.0, 0.0};  // N m
  Stage stage = Stage::free;
  force::Ledger ledger;          // J
  double energy_residual = 0.0;  // J
  int solver_iterations = 0;
  Health health = Health::good;
};

struct Event {
  double time = 0.0;  // s
  EventKind kind = EventKind::contact;
  double hand_travel = 0.0;  // m
  double hand_force = 0.0;   // N
  double free_length = 0.0;  // m
};

}  // namespace acus
