#include <seiche/core/stencil.hpp>

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace seiche {
namespace {

// sin(π p / q), exact where it is 0 or ±1.
double sin_pi(Index p, Index q) {
  p %= 2 * q;
  if (p < 0) p += 2 * q;
  const double sign = p < q ? 1.0 : -1.0;
  if (p >= q) p -= q;
  if (2 * p > q) p = q - p;
  if (2 * p == q) return sign;
  return sign * std::sin(std::numbers::pi * static_cast<double>(p) / static_cast<double>(q));
}

struct Reflected {
  Index index;
  double sign;
};

// Where u_{i} of unknown number i lies on the grid, and with which sign; index −1: at an end, where u = 0.
Reflected locate(Index i, const Grid& grid) {
  const Index n = grid.intervals;
  if (grid.boundary == Boundary::periodic) return {((i % n) + n) % n, 1.0};
  Index j = ((i + 1) % (2 * n) + 2 * n) % (2 * n);  // odd about 0 and n, period 2n
  if (j % n == 0) return {-1, 0.0};
  if (j > n) return {2 * n - j - 1, -1.0};
  return {j - 1, 1.0};
}

}  // namespace

Stencil Stencil::identity(double factor) {
  Stencil s;
  if (factor != 0) s.taps_[0] = factor;
  return s;
}

Stencil Stencil::laplacian(double dx) {
  const double c = 1 / (dx * dx);
  Stencil s;
  s.taps_ = {{-1, c}, {0, -2 * c}, {1, c}};
  return s;
}

Stencil Stencil::central_difference(double dx) {
  const double c = 1 / (2 * dx);
  Stencil s;
  s.taps_ = {{-1, -c}, {1, c}};
  return s;
}

Stencil& Stencil::operator+=(const Stencil& other) {
  for (const auto& [offset, c] : other.taps_) taps_[offset] += c;
  drop_zeros();
  return *this;
}

Stencil& Stencil::operator*=(double factor) {
  for (auto& [offset, c] : taps_) c *= factor;
  drop_zeros();
  return *this;
}

void Stencil::drop_zeros() {
  std::erase_if(taps_, [](const auto& tap) { return tap.second == 0; });
}

double Stencil::coefficient(int offset) const {
  const auto found = taps_.find(offset);
  return found == taps_.end() ? 0.0 : found->second;
}

bool Stencil::is_symmetric() const {
  for (const auto& [offset, c] : taps_)
    if (coefficient(-offset) != c) return false;
  return true;
}

bool Stencil::is_identity() const { return taps_.size() == 1 && coefficient(0) == 1; }

std::complex<double> Stencil::symbol(Index mode, Index period) const {
  // Σ c_k e^{ikθ} = Σ c_k − 2 Σ c_k sin²(kθ/2) + i Σ c_k sin(kθ): the first sum is exactly 0 for differences.
  double sum = 0;
  for (const auto& [offset, c] : taps_) sum += c;
  double real = 0;
  double imaginary = 0;
  for (const auto& [offset, c] : taps_) {
    real -= 2 * c * square(sin_pi(offset * mode, period));
    imaginary += c * sin_pi(2 * offset * mode, period);
  }
  return {sum + real, imaginary};
}

Eigen::MatrixXd Stencil::matrix(const Grid& grid) const {
  const Index n = grid.unknowns();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (const auto& [offset, c] : taps_) {
      const Reflected at = locate(i + offset, grid);
      if (at.index >= 0) a(i, at.index) += at.sign * c;
    }
  return a;
}

BlockStencil::BlockStencil(Index fields) : fields_(fields), entries_(static_cast<std::size_t>(fields * fields)) {}

Stencil& BlockStencil::operator()(Index row, Index column) {
  return entries_[static_cast<std::size_t>(row * fields_ + column)];
}

const Stencil& BlockStencil::operator()(Index row, Index column) const {
  return entries_[static_cast<std::size_t>(row * fields_ + column)];
}

bool BlockStencil::is_zero() const {
  for (const Stencil& s : entries_)
    if (!s.is_zero()) return false;
  return true;
}

Eigen::MatrixXcd BlockStencil::symbol(Index mode, Index period) const {
  Eigen::MatrixXcd block(fields_, fields_);
  for (Index i = 0; i < fields_; ++i)
    for (Index j = 0; j < fields_; ++j) block(i, j) = (*this)(i, j).symbol(mode, period);
  return block;
}

Eigen::MatrixXd BlockStencil::matrix(const Grid& grid) const {
  const Index n = grid.unknowns();
  Eigen::MatrixXd a(fields_ * n, fields_ * n);
  for (Index i = 0; i < fields_; ++i)
    for (Index j = 0; j < fields_; ++j) a.block(i * n, j * n, n, n) = (*this)(i, j).matrix(grid);
  return a;
}

Modes modes(const Grid& grid) {
  if (grid.boundary == Boundary::periodic) return {0, grid.intervals / 2 + 1, grid.intervals};
  return {1, grid.intervals - 1, 2 * grid.intervals};
}

}  // namespace seiche
