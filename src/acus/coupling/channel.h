// The channel the needle has cut, and dry friction along it.
//
// The straight path into the tissue is divided into cells of the rest state. The shaft lies in the cells
// between the entry and the tip; each carries friction per length of needle inside it, through an elastic
// pre-sliding that stands for the tissue close to the shaft, sheared before it slips.
#pragma once

#include <vector>

#include "acus/coupling/attachment.h"
#include "acus/coupling/slider.h"

namespace acus::coupling {

inline constexpr double channel_cell =
    1e-3;  // m, rest length of a cell; of the order of the elements along the path

// Axial stiffness per length of the sleeve of tissue between radius r and e r around a line that pulls on it:
// 2 pi G / ln(e), N/m^2 (antiplane shear; Love 1927). What lies farther out is the mesh's to resolve.
double sleeve_stiffness(double shear_modulus);

// One attachment per cell, of its middle.
struct Channel {
  double friction = 0.0;   // N/m, limit of the force per length
  double stiffness = 0.0;  // N/m^2, pre-sliding, per length
  std::vector<Attachment> attachment;  // at least `count`
  int count = 0;

  int cells() const { return count; }
};

// What moves, one entry per cell.
struct ChannelState {
  std::vector<double> length;      // m, of needle inside the cell
  std::vector<double> elongation;  // m, pre-sliding
};

// Lays `inserted` [m] of needle over the cells up to rest depth `depth` [m], stretched evenly. A cell that
// gains needle keeps its force (new length arrives unloaded), one that loses needle keeps its elongation.
// Returns the energy set free by that, J, at least 0: it is friction's.
double cover(ChannelState& state, const Channel& channel, double depth, double inserted);

Slider slider_of(const Channel& channel, const ChannelState& state, int cell);

}  // namespace acus::coupling
