// The public face of acus: describe a Scene, build a Simulation of it, step it, read its Frame.
#pragma once

#include "acus/sim/frame.h"
#include "acus/sim/scene.h"
#include "acus/sim/simulation.h"
