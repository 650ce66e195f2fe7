#include "acus/io/spelling.h"

#include <algorithm>
#include <numeric>

namespace acus::io {
namespace {

std::string after_dot(const std::string& word) {
  const auto dot = word.rfind('.');
  return dot == std::string::npos ? word : word.substr(dot + 1);
}

bool begins_with(const std::string& word, const std::string& start) {
  return word.compare(0, start.size(), start) == 0;
}

}  // namespace

int edit_distance(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i) + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replace = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replace, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t longest = 80;  // no key is this long; keeps a hostile word cheap
  if (word.size() > longest) return {};
  for (const std::string& candidate : known)
    if (after_dot(candidate) == after_dot(word)) return candidate;  // the right key in the wrong table
  for (const std::string& candidate : known)
    if (!word.empty() && begins_with(candidate, word + "_")) return candidate;  // the unit left out
  std::string best;
  int best_distance = std::max(2, static_cast<int>(word.size()) / 3) + 1;
  for (const std::string& candidate : known)
    if (const int distance = edit_distance(word, candidate); distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  return best;
}

}  // namespace acus::io
