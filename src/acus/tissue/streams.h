// Streams: how the elements of a large mesh are shared out, so that several threads may add to the nodes.
//
// Each stream is a run of elements and adds into a vector of its own; then the vectors are added up node by
// node in the order of the streams. How many there are depends on the mesh alone, so that threads change no
// bits. Where neighbours in space are neighbours in the mesh, a stream adds to few of the nodes, and only
// those are added up.
#pragma once

#include <cstdint>
#include <vector>

#include "acus/mesh/tet_mesh.h"
#include "acus/numeric/node_vector.h"
#include "acus/numeric/pieces.h"

namespace acus::tissue {

inline constexpr int most_streams = 8;

struct Streams {
  // Nodes one after the other to which the same streams add.
  struct Run {
    numeric::Range nodes;
    std::uint32_t adding = 1;  // bit s: stream s
  };
  std::vector<numeric::Range> elements;  // [streams], multiples of `batch_elements`
  std::vector<Run> runs;                 // in the order of the nodes
  std::vector<std::size_t> first_run;    // [pieces + 1] of each piece of the nodes

  int count() const { return static_cast<int>(elements.size()); }

  // add(part, elements, stream) for each stream, with its own of the `parts`, [streams][nodes].
  template <class Real, class Add>
  void add(numeric::NodeVectorOf<Real>& parts, const Team& team, const Add& add) const {
    const std::size_t size = parts.size() / elements.size();
    team.run(count(), [&](int s) { add(parts.data() + s * size, elements[s], s); });
  }

  // Adds the parts up and calls take(sum, nodes, piece) run by run: where `sum`, a vector over all nodes,
  // holds it for these. It may go on being added to, or be cleared; the other parts are zero then.
  template <class Real, class Take>
  void sum(numeric::NodeVectorOf<Real>& parts, const Team& team, const Take& take) const;
};

// Of how many of so many elements a stream is, all but the last one.
std::size_t stream_length(std::size_t elements);
Streams build_streams(const std::vector<mesh::Tet>& corners, std::size_t nodes);

// to += from; from = 0
void move_sum(float* to, float* from, std::size_t size);
void move_sum(double* to, double* from, std::size_t size);

template <class Real, class Take>
void Streams::sum(numeric::NodeVectorOf<Real>& parts, const Team& team, const Take& take) const {
  const std::size_t size = parts.size() / elements.size();
  team.run(static_cast<int>(first_run.size()) - 1, [&](int piece) {
    for (std::size_t r = first_run[piece]; r < first_run[piece + 1]; ++r) {
      const Run& run = runs[r];
      const std::size_t from = numeric::node_stride * run.nodes.first;
      Real* sum = nullptr;
      for (int s = 0; s < count(); ++s) {
        if ((run.adding >> s & 1U) == 0) continue;
        Real* part = parts.data() + s * size;
        if (sum == nullptr)
          sum = part;
        else
          move_sum(sum + from, part + from, numeric::node_stride * run.nodes.size());
      }
      take(sum, run.nodes, piece);
    }
  });
}

}  // namespace acus::tissue
