// Loops over pairs of elements that add to the nodes, in either precision.
#pragma once

#include "acus/tissue/element.h"

namespace acus::tissue {

// For a precision: how many numbers a kernel works on at once.
template <class Real>
struct LaneOf;
template <>
struct LaneOf<double> {
  using type = ExactLane;
};
template <>
struct LaneOf<float> {
  using type = PackedLane;
};

// `count` numbers of each element, in an array [groups][count][as many as fill 64 bytes], one part of a group
// after the other.
template <class Real>
class ElementNumbers {
 public:
  using Lane = typename LaneOf<Real>::type;
  ACUS_INLINE ElementNumbers(const std::vector<Real>& of, int count) : all_(of.data()), count_(count) {}
  ACUS_INLINE void go_to(std::size_t first, int part) {
    part_ = all_ + count_ * first + part * lanes_in<Real, Lane>;
  }
  ACUS_INLINE Lane operator[](int k) const { return load_part<Lane>(part_ + k * numeric::lane_count<Real>); }

 private:
  const Real* all_;
  int count_;
  const Real* part_ = nullptr;
};

// Calls `respond` for the parts of each batch of pairs with the part's own `offsets`, and adds up what it
// puts on their nodes.
template <class Real, class Respond>
ACUS_INLINE void add_pairs(Real* to, const TissueModel& m, numeric::Range elements, Respond respond) {
  using Lane = typename LaneOf<Real>::type;
  constexpr int parts = lane_count<Real> / lanes_in<Real, Lane>;
  for (std::size_t pair = elements.first / 2; pair < elements.last / 2; pair += lane_count<Real>) {
    const Offsets* offsets = m.offsets.data() + pair;
    BatchSum<Real, Lane> sum(to, offsets);
    for (int part = 0; part < parts; ++part) {
      Lane node[pair_nodes][4];
      respond(pair, part, offsets + part * lanes_in<Real, Lane>, node);
      ACUS_UNROLL
      for (int i = 0; i < pair_nodes; ++i) sum.take(part, i, node[i]);
    }
    sum.finish();
  }
}

}  // namespace acus::tissue
