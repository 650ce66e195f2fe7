#include "acus/tissue/streams.h"

#include "acus/numeric/simd.h"
#include "acus/tissue/pairs.h"

namespace acus::tissue {
namespace {

constexpr std::size_t fewest_cut = 6000;  // elements: less takes one thread no longer than two
constexpr std::size_t block = numeric::cut_step / numeric::node_stride;  // nodes: runs are made of such

template <class Real>
ACUS_INLINE void move(Real* to, Real* from, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    to[i] += from[i];
    from[i] = Real{};
  }
}

}  // namespace

ACUS_KERNEL void move_sum(float* to, float* from, std::size_t size) { move(to, from, size); }
ACUS_KERNEL void move_sum(double* to, double* from, std::size_t size) { move(to, from, size); }

std::size_t stream_length(std::size_t elements) {
  const std::size_t batches = (elements + batch_elements - 1) / batch_elements;
  return elements < fewest_cut ? batches * batch_elements
                               : (batches + most_streams - 1) / most_streams * batch_elements;
}

Streams build_streams(const std::vector<mesh::Tet>& corners, std::size_t nodes) {
  Streams s;
  const std::size_t length = stream_length(corners.size());
  for (std::size_t first = 0; first < corners.size(); first += length)
    s.elements.push_back({first, std::min(first + length, corners.size())});

  std::vector<std::uint32_t> adding((nodes + block - 1) / block, 0);
  for (std::size_t e = 0; e < corners.size(); ++e)
    for (const int node : corners[e]) adding[node / block] |= std::uint32_t{1} << (e / length);
  for (std::uint32_t& some : adding)
    if (some == 0) some = 1;  // no element: the sum is the first one's zero

  const std::size_t numbers = numeric::node_stride * nodes;
  s.first_run.push_back(0);
  for (int piece = 0; piece < numeric::pieces_of(numbers); ++piece) {
    const numeric::Range of = numeric::piece_of(numbers, piece);
    const std::size_t last = of.last / numeric::node_stride;
    for (std::size_t first = of.first / numeric::node_stride; first < last; first += block) {
      const std::uint32_t by = adding[first / block];
      const std::size_t end = std::min(first + block, last);
      if (s.runs.size() > s.first_run.back() && s.runs.back().adding == by)
        s.runs.back().nodes.last = end;
      else
        s.runs.push_back({{first, end}, by});
    }
    s.first_run.push_back(s.runs.size());
  }
  return s;
}

}  // namespace acus::tissue
