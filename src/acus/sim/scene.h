// Scene: everything that is chosen for one insertion, in SI. Built from TOML by io, or in code.
#pragma once

#include <string>
#include <vector>

#include "acus/base/result.h"
#include "acus/base/vec.h"
#include "acus/force/fracture.h"
#include "acus/needle/needle_spec.h"
#include "acus/tissue/element_kind.h"

namespace acus {

// The paper's closed forms outside the tissue, straight inside; or a rod everywhere (needle/rod.h).
enum class NeedleModel { column, rod };
using Element = tissue::ElementKind;
enum class Coupling { embedded, nearest_node };
using Crack = force::Crack;
enum class HandKind { steady, path, person };

struct TissueScene {
  bool rigid = false;            // a fixed stop instead of tissue: the bare column in a testing machine
  double youngs_modulus = 25e3;  // Pa, Table I; what is left when all has relaxed
  double poisson_ratio = 0.48;   // Table I
  double density = 1000.0;       // kg/m^3, Table I
  Element element = Element::nodal_pressure;
  double damping_mass = 0.0;        // 1/s, Rayleigh: D = damping_mass M + damping_stiffness K
  double damping_stiffness = 5e-3;  // s, chosen: damps the layer's first shear mode (12 Hz) by about a fifth
  double relaxation_share = 0.0;    // of the stiffness in shear that a sudden load meets; gone after a while
  double relaxation_time = 1.0;     // s, chosen
  Vec3 size{0.1, 0.1, 0.06};        // m, block centred on x = y = 0, bottom at z = 0; depth last
  int tetrahedra = 10000;           // aimed at
  std::string mesh;                 // a mesh file instead of the block; empty for the block
  double mesh_unit = 1e-3;          // m per unit of that file
  // Where the needle goes in. For a block: the centre of the top, straight down. For a mesh: the needle comes
  // from far outside along `direction` through `target`, and the first surface it meets is the entry.
  Vec3 target{0.0, 0.0, 0.0};      // m
  Vec3 direction{0.0, 0.0, -1.0};  // unit vector, into the tissue
  double fixed_fraction = 0.1;     // of a mesh's extent along `direction`: the far part that is held fixed
};

struct ContactScene {
  double rupture_force = 1.0;         // N
  double fracture_toughness = 164.0;  // J/m^2, bovine liver, needle (Gokgol 2012)
  Crack crack = Crack::ring;
  // Dry friction per inserted length; the order measured in J Endourol, 10.1089/end.2016.0342.
  double friction = 40.0;          // N/m
  double contact_radius = 2.5e-3;  // m, disc over which a tip load is spread; chosen, a mesh must resolve it
  double stiffness = 1e4;  // N/m, needle point against tissue (k of Eq. 8); chosen stiff beside the tissue
  Coupling coupling = Coupling::embedded;
  bool near_field = true;  // the tissue close to the needle gives way by what the mesh cannot
  // Of r cos(bevel), how far from the axis the point of a bevel cuts: 1 is where its geometry has it.
  double bevel_share = 1.0;
};

struct HandPoint {
  double time = 0.0;    // s
  double travel = 0.0;  // m from first touch
};

struct HandScene {
  HandKind kind = HandKind::steady;
  double speed = 10e-3;         // m/s; of a person without load
  double travel = 80e-3;        // m from first touch
  double grip = 0.0;            // m, from the hub to where the hand holds the needle
  double stiffness = 0.0;       // N/m, of the grip between hand and needle; 0: rigid
  std::vector<HandPoint> path;  // kind = path: straight lines between these, times increasing

  // kind = person (person.h)
  double force_limit = 3.0;  // N, at which the hand stands; chosen: three times the rupture force
  // s, from what is felt to what is done. To a touch alone it is 0.155 s (Robinson 1934, in Kosinski's review
  // of reaction times); chosen a little longer for someone who is busy pushing.
  double reaction = 0.2;
  double hesitation = 0.4;  // s, chosen
  // m rms. Eye surgeons who hold an instrument still: 49 um (Riviere, Rader and Khosla, Proc. IEEE EMBS
  // 1997).
  double tremor = 50e-6;
  int seed = 1;            // of the tremor
  double duration = 30.0;  // s, chosen: after which nobody would push any longer
  bool pulls_back = false;
};

// A sleeve or a second hand around the needle, outside of the tissue; it stays where it is, and the hand may
// pass it.
struct GuideScene {
  double length = 0.0;     // m, along the path; 0: none
  double gap = 0.0;        // m, between the tissue at rest and its lower end
  double stiffness = 1e9;  // N/m^2, across the needle per length; chosen: that of a rigid sleeve
  double friction = 0.0;   // N/m, per length of needle inside it
};

// Of the inner iterations of a solve and, where the tolerance allows floats, of what a step finds afresh. In
// single precision iterations are refined in double where floats do not reach.
enum class Precision { single_, double_ };

struct RunScene {
  double time_step = 1e-3;  // s
  Precision solver_precision = Precision::single_;
  double solver_tolerance = 5e-5;  // of the load, that a solve may leave unbalanced
  int trace_stride = 1;            // steps from one recorded frame to the next
};

struct Scene {
  NeedleModel needle_model = NeedleModel::rod;
  needle::NeedleSpec needle;
  TissueScene tissue;
  ContactScene contact;
  HandScene hand;
  GuideScene guide;
  RunScene run;
};

// The scene itself if every number makes sense together; else one sentence naming the TOML key, what is wrong
// and what would be right.
Result<Scene> validated(Scene scene);

}  // namespace acus
