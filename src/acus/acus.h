// The public face of acus: describe a Scene, build a Simulation of it, step it, read its Frame.
//
// Building a Simulation reads and writes decimal numbers; the numeric locale must then be "C", as it is
// unless a program calls setlocale.
#pragma once

#include "acus/sim/frame.h"
#include "acus/sim/scene.h"
#include "acus/sim/simulation.h"
