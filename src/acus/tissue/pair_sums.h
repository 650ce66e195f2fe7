// Loops over pairs of elements that add to the nodes, in either precision.
#pragma once

#include "acus/tissue/element.h"

namespace acus::tissue {

// `count` numbers of each element, in an array [groups][count][as many as fill 64 bytes].
template <class Lane>
class ElementNumbers {
 public:
  using Real = numeric::RealOf<Lane>;
  // Those of one part of the group that begins with element `first`.
  class Part {
   public:
    ACUS_INLINE explicit Part(const Real* from) : from_(from) {}
    ACUS_INLINE Lane operator[](int k) const {
      return numeric::load_lanes<Lane>(from_ + k * numeric::lane_count<Real>);
    }

   private:
    const Real* from_;
  };
  ACUS_INLINE ElementNumbers(const std::vector<Real>& of, int count) : all_(of.data()), count_(count) {}
  ACUS_INLINE Part of(std::size_t first, int part) const {
    return Part(all_ + count_ * first + part * lanes_in<Real, Lane>);
  }

 private:
  const Real* all_;
  int count_;
};

// Calls `respond` for the parts of each batch of pairs with the part's own `offsets`, and adds up what it
// puts on their nodes.
template <class Lane, class Real, class Respond>
ACUS_INLINE void add_pairs(Real* to, const TissueModel& m, numeric::Range elements, Respond respond) {
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
