// State: what a step advances. Each array names its one writer.
#pragma once

#include <vector>

#include "acus/coupling/slider.h"
#include "acus/force/energy_force.h"
#include "acus/numeric/node_vector.h"
#include "acus/sim/frame.h"
#include "acus/sim/model.h"

namespace acus {

// A needle that is a rod, and the channel that its tip has cut: straight or not, as the tip went.
struct RodNeedle {
  needle::RodState rod;
  needle::Pose hub;                  // where it is held now
  coupling::Channel channel;         // as far as it is cut
  std::vector<Vec3> cell_point;      // m, at rest, [cells]
  std::vector<double> cell_lateral;  // N/m^2, of the near field, [cells]
  bool tip_rests = false;            // on the surface, pressed
  bool cut_begun = false;
  Vec3 channel_end{0.0, 0.0, 0.0};  // m, at rest
  Vec3 disc_axis{0.0, 0.0, 0.0};    // unit, at rest, across the disc that spreads the tip load
  Vec3 tip_offset{0.0, 0.0, 0.0};   // m, of the tip from there, across its axis, where it came to rest
};

// How a point of the guide holds the rod. It takes it as it finds it, so that nothing that comes in from
// aside is thrown to the middle, and closes on it as it slides.
struct GuideHold {
  bool holds = false;
  double elongation = 0.0;     // m, pre-sliding
  Vec3 offset{0.0, 0.0, 0.0};  // m, across, at which the spring is at rest
};

struct State {
  long steps = 0;                // taken so far; time is this many time steps, without a sum's rounding
  std::vector<Vec3> position;    // m, [nodes]; advance
  numeric::NodeVector velocity;  // m/s, [free nodes]; begin_tissue and the solves
  // Where the velocity may go next: its change over the last step and the change of that, m/s, [free nodes],
  // and the shares of both that came again in the last steps, 0 to 1; move_tissue. A change is believed until
  // it fails to come again, a bend only when it has.
  numeric::NodeVector velocity_change, velocity_bend;
  double change_persists = 1.0, bend_persists = 0.0;
  tissue::MaxwellBranch branch;  // of tissue that relaxes; corotate_into
  // m/s of the tissue per m/s of the needle, [free nodes], roughly; solve_coupled
  numeric::NodeVectorOf<float> influence;

  double hub_travel = 0.0;    // m, along the axis, 0 where the tip touches the tissue at rest
  double tip_position = 0.0;  // m, along the axis below the undeformed entry
  double tip_rate = 0.0;      // m/s

  bool punctured = false;
  bool through = false;         // the channel has come out at the far side
  double channel_depth = 0.0;   // m, of the cut, at rest
  double tip_elongation = 0.0;  // m, of the contact spring; negative: the gap to the channel's end
  coupling::Attachment tip;     // at the channel's end
  coupling::ChannelState channel;
  std::vector<GuideHold> guide;  // of a rod, [points]
  RodNeedle needle;              // where the needle is a rod

  bool buckled = false;
  long steps_straight = 0;  // that a rod's bow has been small
  force::Ledger ledger;
  force::EnergyForce energy_force;
};

// The hub of a hand that goes straight along the path: `travel` [m] from first touch.
needle::Pose hub_pose(const Model& model, double travel);

// N, of what a cut beside the axis spreads the tissue with: the energy per length of a channel whose shaft
// lies beside it.
double spreading_force(const Model& model, const State& state);

// The tip against the channel's end: rupture before the puncture, cutting after it, nothing beyond the far
// side. Against a stop there is no puncture.
coupling::Slider tip_slider(const Model& model, const State& state);

// The needle's own geometry, from the state.
struct NeedlePlace {
  double surface = 0.0;          // m, the entry's present position along the axis
  double inserted_length = 0.0;  // m, inside tissue
  double free_length = 0.0;      // m, between hub and entry
  double covered_depth = 0.0;    // m, rest depth of the channel that the shaft fills
  double shortening = 0.0;       // m, of the distance between the ends of the free part
};
NeedlePlace place_needle(const Model& model, const State& state);

State initial_state(const Model& model);

}  // namespace acus
