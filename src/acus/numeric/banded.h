// Symmetric banded systems, factored as L D L^T without pivoting (Golub and Van Loan, Matrix
// Computations, 4.3).
#pragma once

#include <algorithm>
#include <vector>

namespace acus::numeric {

// Entries (i, j) with |i - j| <= band; columns of the lower half stand one after another.
template <int band>
class BandedMatrix {
 public:
  explicit BandedMatrix(int size = 0)
      : size_(size), lower_(static_cast<std::size_t>(size + band) * (band + 1)) {}

  int size() const { return size_; }
  void clear() { std::fill(lower_.begin(), lower_.end(), 0.0); }

  // Adds to (row, column) and (column, row), which are one number here; row >= column.
  void add(int row, int column, double value) { column_of(column)[row - column] += value; }
  double at(int row, int column) const {
    return row >= column ? column_of(column)[row - column] : column_of(row)[column - row];
  }

  // In place: from here on the matrix holds its factors. False when it is not positive definite.
  bool factor() {
    for (int j = 0; j < size_; ++j) {
      double* const from = column_of(j);
      const double pivot = from[0];
      if (!(pivot > 0.0)) return false;
      const double inverse = 1.0 / pivot;
      for (int k = 1; k <= band; ++k) {
        const double l = from[k] * inverse;
        double* const to = column_of(j + k);
        for (int i = 0; i <= band - k; ++i) to[i] -= l * from[k + i];
      }
      from[0] = inverse;
      for (int k = 1; k <= band; ++k) from[k] *= inverse;
    }
    return true;
  }

  // x <- A^-1 x, from the factors. x has `size` entries.
  void solve(double* x) const {
    for (int j = 0; j < size_; ++j) {
      const double* const l = column_of(j);
      const int rows = std::min(band, size_ - 1 - j);
      for (int k = 1; k <= rows; ++k) x[j + k] -= l[k] * x[j];
    }
    for (int j = size_ - 1; j >= 0; --j) {
      const double* const l = column_of(j);
      const int rows = std::min(band, size_ - 1 - j);
      double sum = l[0] * x[j];
      for (int k = 1; k <= rows; ++k) sum -= l[k] * x[j + k];
      x[j] = sum;
    }
  }

 private:
  // The last columns reach below the matrix; what is written there is never read.
  double* column_of(int j) { return &lower_[static_cast<std::size_t>(j) * (band + 1)]; }
  const double* column_of(int j) const { return &lower_[static_cast<std::size_t>(j) * (band + 1)]; }

  int size_ = 0;
  std::vector<double> lower_;
};

}  // namespace acus::numeric
