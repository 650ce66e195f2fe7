#include "acus/tissue/pairs.h"

#include <algorithm>
#include <tuple>

#include "acus/tissue/streams.h"

namespace acus::tissue {
namespace {

using mesh::Tet;
constexpr int none = -1;

// Where a tetrahedron meets another: its corners with the one that they do not share last, still of positive
// volume.
struct Face {
  int tet = none;
  Tet corners{};
};

Tet with_corner_last(const Tet& t, std::size_t last) {
  constexpr std::array<std::array<std::size_t, 4>, 4> even = {
      {{1, 3, 2, 0}, {0, 2, 3, 1}, {0, 3, 1, 2}, {0, 1, 2, 3}}};
  Tet turned{};
  for (std::size_t i = 0; i < 4; ++i) turned[i] = t[even[last][i]];
  return turned;
}

// The same corners from one of the shared face on.
Tet beginning_with(const Tet& t, int node) {
  for (std::size_t i = 0; i < 3; ++i)
    if (t[i] == node) return {t[i], t[(i + 1) % 3], t[(i + 2) % 3], t[3]};
  return t;
}

// Both sides of the faces between two tetrahedra that lie on different sides of them.
std::vector<std::array<Face, 2>> inner_faces(const std::vector<Tet>& tets) {
  struct Side {
    std::array<int, 3> nodes;  // ascending
    Face face;
  };
  std::vector<Side> sides;
  for (int t = 0; t < static_cast<int>(tets.size()); ++t)
    for (std::size_t last = 0; last < 4; ++last) {
      const Tet corners = with_corner_last(tets[t], last);
      Side& side = sides.emplace_back(Side{{corners[0], corners[1], corners[2]}, {t, corners}});
      std::sort(side.nodes.begin(), side.nodes.end());
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.nodes, a.face.tet) < std::tie(b.nodes, b.face.tet);
  });
  std::vector<std::array<Face, 2>> faces;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].nodes != sides[i - 1].nodes) continue;
    const Face& one = sides[i - 1].face;
    const Tet other = beginning_with(sides[i].face.corners, one.corners[0]);
    if (other[1] == one.corners[2] && other[2] == one.corners[1])
      faces.push_back({one, {sides[i].face.tet, other}});
  }
  return faces;
}

// Partners, taken first where there is least choice: one in four hundred is left alone.
class Matching {
 public:
  explicit Matching(const std::vector<Tet>& tets)
      : faces_(inner_faces(tets)), around_(tets.size()), partner_(tets.size(), none) {
    for (int f = 0; f < static_cast<int>(faces_.size()); ++f)
      for (const Face& side : faces_[f]) around_[side.tet].push_back(f);
    for (int t = static_cast<int>(tets.size()); t-- > 0;) wait(t);
    while (match_one()) {
    }
  }
  // The face by which it is paired, or none.
  int face_of(int tet) const { return partner_[tet]; }
  const std::array<Face, 2>& face(int f) const { return faces_[f]; }

 private:
  int across(int f, int tet) const { return faces_[f][faces_[f][0].tet == tet ? 1 : 0].tet; }
  bool is_free(int tet) const { return partner_[tet] == none; }
  std::size_t choice(int tet) const {
    const auto free = std::count_if(around_[tet].begin(), around_[tet].end(),
                                    [&](int f) { return is_free(across(f, tet)); });
    return std::min<std::size_t>(free, 4);  // more only where three share a face
  }
  void wait(int tet) {
    if (const std::size_t k = choice(tet); k > 0) waiting_[k].push_back(tet);
  }
  bool match_one() {
    for (std::size_t k = 1; k < waiting_.size(); ++k)
      while (!waiting_[k].empty()) {
        const int tet = waiting_[k].back();
        waiting_[k].pop_back();
        if (!is_free(tet) || choice(tet) != k) continue;  // it waits elsewhere
        int best = none;
        for (int f : around_[tet])
          if (is_free(across(f, tet)) && (best == none || choice(across(f, tet)) < choice(across(best, tet))))
            best = f;
        partner_[tet] = partner_[across(best, tet)] = best;
        for (const Face& side : faces_[best])
          for (int f : around_[side.tet])
            if (is_free(across(f, side.tet))) wait(across(f, side.tet));
        return true;
      }
    return false;
  }

  std::vector<std::array<Face, 2>> faces_;
  std::vector<std::vector<int>> around_;     // [tets] their faces
  std::vector<int> partner_;                 // [tets] the face to it
  std::array<std::vector<int>, 5> waiting_;  // by the number of partners to choose from
};

using Pair = std::array<Face, 2>;  // no second where its number is none

std::vector<Pair> pairs_of(const std::vector<Tet>& tets) {
  const Matching matching(tets);
  std::vector<Pair> pairs;
  std::vector<bool> done(tets.size(), false);
  for (int t = 0; t < static_cast<int>(tets.size()); ++t) {
    if (done[t]) continue;
    if (const int f = matching.face_of(t); f != none) {
      pairs.push_back(matching.face(f));
      done[pairs.back()[0].tet] = done[pairs.back()[1].tet] = true;
    } else {
      pairs.push_back({Face{t, tets[t]}, Face{}});
    }
  }
  return pairs;
}

std::size_t batches_of(std::size_t pairs) { return (pairs + batch_pairs - 1) / batch_pairs; }

// Deals the pairs of each stream to the lanes of the kernels like cards from as many stacks, each a run of
// neighbours: the pairs of a batch then share few nodes, and adding to a node seldom waits for the one
// before.
std::vector<Pair> dealt(const std::vector<Pair>& pairs) {
  std::vector<Pair> to;
  const std::size_t stream = stream_length(batches_of(pairs.size()) * batch_elements) / 2;
  for (std::size_t first = 0; first < pairs.size(); first += stream) {
    const std::size_t last = std::min(first + stream, pairs.size());
    const std::size_t batches = batches_of(last - first);
    for (std::size_t batch = first; batch < first + batches; ++batch)
      for (std::size_t p = batch; p < last; p += batches) to.push_back(pairs[p]);
  }
  return to;
}

}  // namespace

Pairing pair_up(const std::vector<Tet>& tets) {
  Pairing out;
  const std::vector<Pair> pairs = dealt(pairs_of(tets));
  const std::size_t batches = batches_of(pairs.size());
  out.corners.resize(batches * batch_elements);
  out.tet.resize(out.corners.size());
  out.element.assign(tets.size(), none);
  for (std::size_t p = 0; p < batches * batch_pairs; ++p) {
    const Pair& pair = pairs[std::min(p, pairs.size() - 1)];
    const Tet& c = pair[0].corners;
    const std::array<Face, 2> sides = {
        pair[0], pair[1].tet != none ? pair[1] : Face{pair[0].tet, {c[0], c[2], c[1], c[3]}}};
    for (int side = 0; side < 2; ++side) {
      const std::size_t e = element_of_pair(p, side);
      out.corners[e] = sides[side].corners;
      out.tet[e] = sides[side].tet;
      if (out.element[out.tet[e]] == none) out.element[out.tet[e]] = static_cast<int>(e);
    }
  }
  return out;
}

}  // namespace acus::tissue
