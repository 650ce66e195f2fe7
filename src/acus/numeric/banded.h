// Symmetric banded systems, factored as L D L^T without pivoting (Golub and Van Loan, Matrix
// Computations, 4.3).
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "acus/numeric/simd.h"

namespace acus::numeric {

// Entries (i, j) with |i - j| <= band; columns of the lower half stand one after another.
template <int band>
class BandedMatrix {
 public:
  explicit BandedMatrix(int size = 0)
      : size_(size), lower_(static_cast<std::size_t>(size + band) * stride), pivot_(size + band) {}

  int size() const { return size_; }
  void clear() { std::fill(lower_.begin(), lower_.end(), 0.0); }

  // Adds to (row, column) and (column, row), which are one number here; row >= column.
  void add(int row, int column, double value) { column_of(column)[row - column] += value; }
  // Two such, one below the other; the second may be 0 and just below the band.
  void add(int row, int column, Lane2 values) {
    double* const to = &column_of(column)[row - column];
    Lane2 sum;
    std::memcpy(&sum, to, sizeof sum);
    sum += values;
    std::memcpy(to, &sum, sizeof sum);
  }
  double at(int row, int column) const {
    return row >= column ? column_of(column)[row - column] : column_of(row)[column - row];
  }

  // In place: from here on the matrix holds its factors. False when it is not positive definite.
  bool factor() {
    Lane2 last[lanes] = {};  // the last column, still times its pivot
    double inverse = 0.0;    // of its pivot
    for (int j = 0; j < size_; ++j) {
      double* const column = column_of(j);
      Lane2 rest[lanes];
      std::memcpy(rest, column, sizeof rest);
      subtract_left(rest, j, std::make_integer_sequence<int, band - 1>());
      for (int i = 0; i + 1 < lanes; ++i)
        rest[i] -= (last[0][1] * __builtin_shufflevector(last[i], last[i + 1], 1, 2)) * inverse;
      const double pivot = rest[0][0];
      if (!(pivot > 0.0)) return false;
      inverse = 1.0 / pivot;
      for (int i = 0; i < lanes; ++i) {
        last[i] = rest[i];
        rest[i] *= inverse;
      }
      rest[0][0] = inverse;
      std::memcpy(column, rest, sizeof rest);
      pivot_[j + band] = pivot;
    }
    return true;
  }

  // x <- A^-1 x, from the factors. x has `size` entries, each a double or a vector of them: many right-hand
  // sides at once.
  template <class Number>
  void solve(Number* x) const {
    // The farthest first, so that a row waits for the one before it no longer than one product.
    const auto forward = [&](int j, int reach) {
      Number sum = x[j];
      for (int k = reach; k >= 1; --k) sum -= column_of(j - k)[k] * x[j - k];
      return sum;
    };
    const auto backward = [&](int j, int reach) {
      const double* const l = column_of(j);
      Number sum = l[0] * x[j];
      for (int k = reach; k >= 1; --k) sum -= l[k] * x[j + k];
      return sum;
    };
    for (int j = 0; j < size_; ++j) x[j] = j < band ? forward(j, j) : forward(j, band);
    for (int j = size_ - 1; j >= 0; --j)
      x[j] = size_ - 1 - j < band ? backward(j, size_ - 1 - j) : backward(j, band);
  }

 private:
  // A column fills whole pairs of numbers, with a zero below it at least; `band` empty ones stand before the
  // first.
  static constexpr int lanes = (band + 3) / 2;
  static constexpr int stride = 2 * lanes;
  double* column_of(int j) { return &lower_[static_cast<std::size_t>(j + band) * stride]; }
  const double* column_of(int j) const { return &lower_[static_cast<std::size_t>(j + band) * stride]; }

  // Takes from column j what the columns to its left, each by its entry in row j, have in the rows below.
  template <int... step>
  ACUS_INLINE void subtract_left(Lane2 (&rest)[lanes], int j, std::integer_sequence<int, step...>) const {
    (subtract<band - step>(rest, j), ...);
  }
  template <int left>
  ACUS_INLINE void subtract(Lane2 (&rest)[lanes], int j) const {
    const double* const from = column_of(j - left) + left;
    const double factor = from[0] * pivot_[j - left + band];
    for (int i = 0; i < (band + 2 - left) / 2; ++i) {
      Lane2 l;
      std::memcpy(&l, from + 2 * i, sizeof l);
      rest[i] -= factor * l;
    }
  }

  int size_ = 0;
  std::vector<double> lower_;
  std::vector<double> pivot_;  // of factored columns; 0 before the first
};

}  // namespace acus::numeric
