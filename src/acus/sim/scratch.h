// What a step needs and forgets.
#pragma once

#include <vector>

#include "acus/base/team.h"
#include "acus/coupling/slider.h"
#include "acus/needle/rod_motion.h"
#include "acus/numeric/refined_solve.h"
#include "acus/sim/model.h"

namespace acus {

// One attachment of a column that takes part in a step.
struct HeldPoint {
  coupling::Slider slider;
  const coupling::Attachment* at = nullptr;
  int cell = -1;  // of the channel; -1 for the tip
  coupling::Grip grip = coupling::Grip::stick;
  double rate_before = 0.0;  // m/s, of the tissue at the start of a line search
  double rate_change = 0.0;  // m/s, over its whole step
};

// A place where a rod and the tissue hold each other in a step, or a guide the rod. With d the way of the
// rod's point against the tissue in the step, the force on the rod is force - stiffness d.
struct RodContact {
  const coupling::Attachment* at = nullptr;  // empty: a stop that does not give
  needle::RodPoint point;
  Vec3 axis{0.0, 0.0, 0.0};  // unit, along the rod
  coupling::Slider slider;   // along the axis
  coupling::Grip grip = coupling::Grip::stick;
  double lateral = 0.0;                    // N/m, across the axis, both ways
  Vec3 lateral_elongation{0.0, 0.0, 0.0};  // m, before the step
  Vec3 arm{0.0, 0.0, 0.0};                 // m, from the rod's point to where a bevel's is held
  double* elongation = nullptr;            // m, of the slider, in the state
  Vec3 force{0.0, 0.0, 0.0};               // N, on this branch
  Mat3 stiffness = Mat3::Zero();           // N/m, on this branch
  Vec3 rate_before{0.0, 0.0, 0.0};         // m/s, of the rod against the tissue at the start of a line search
  Vec3 rate_change{0.0, 0.0, 0.0};         // m/s, over its whole step
};

struct RodScratch {
  needle::RodMotion motion;
  std::vector<RodContact> contacts;  // the tip first
  std::vector<double> free_answer;   // of the rod while the tissue rests, [unknowns]
  std::vector<double> load;          // [unknowns]
  needle::RodState before;           // at the start of a line search
  std::vector<double> change;        // of the rates over its whole step, [unknowns]
};

struct Scratch {
  Team team;  // who does the work of a step
  // At the present positions. Its rotations go on from those of the step before, so that their last bits
  // (1e-12, of floats 1e-7) remember the way: a scratch belongs to one run, and a state alone does not go on
  // to the same bits.
  tissue::Corotation corotation;
  tissue::SystemMatrix matrix;
  numeric::RefinedScratch solver;
  numeric::SolveScratch<double> exact_solver;  // where the scene asks for double precision
  numeric::CoarseScratch coarse;
  numeric::NodeVector momentum;  // M v0 + h f_el + impulses that do not depend on the step
  // What the tissue's own equation is short of with state.velocity: momentum - A v. Contacts make up for it:
  // during a solve it is the residual of the equation with them.
  numeric::NodeVector imbalance;
  numeric::NodeVectorOf<float> stick_load;  // answer wanted for a unit rate of the needle
  numeric::NodeVector velocity_before;      // at the start of the step

  numeric::NodeVector velocity_tried;   // at the start of a line search
  numeric::NodeVector imbalance_tried;  // there
  // Of the velocity, over the whole of it; in between, the right-hand side with the contacts.
  numeric::NodeVector change;
  numeric::NodeVectorOf<float> answer;  // as state.influence, for resistance()
  std::vector<HeldPoint> held;          // of a column: the tip first
  RodScratch rod;                       // of a rod
};
Scratch build_scratch(const Model& model, int threads = 1);

}  // namespace acus
