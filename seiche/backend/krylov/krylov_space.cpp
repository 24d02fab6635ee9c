#include <seiche/backend/krylov/krylov_space.hpp>
#include <seiche/backend/phi/force_map.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/control/stop_request.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

using Matrix = Eigen::MatrixXd;

constexpr int most_blocks = 400;
constexpr double dependent = 1e-13;  // a remainder this small against its vector is round-off

std::span<double> span_of(Matrix::ColXpr x) { return {x.data(), static_cast<std::size_t>(x.size())}; }

template <class Coefficients>
void sum(const Space& space, Coefficients& c) {
  space.sum({c.data(), static_cast<std::size_t>(c.size())});
}

}  // namespace

void KrylovSpace::reserve(Index columns, Index rows) {
  if (V_.rows() == rows && V_.cols() >= columns) return;
  const Index capacity = V_.rows() == rows ? std::max(columns, 2 * V_.cols()) : std::max<Index>(columns, 32);
  V_.conservativeResize(rows, capacity);
  W_.conservativeResize(rows, capacity);
}

// (xᵀMx)^½, and Mx.
double KrylovSpace::norm_in_M(Matrix::ColXpr x) {
  M_.apply(span_of(x), {Mx_.data(), static_cast<std::size_t>(Mx_.size())});
  return std::sqrt(std::max(0.0, space_.sum(x.dot(Mx_))));
}

// Orthonormalises the columns of `block` against V and each other and appends those that are new; block =
// V·coefficients afterwards. Two passes of Gram–Schmidt keep V orthonormal to round-off. Returns how many were
// appended.
Index KrylovSpace::append(Matrix& block, Matrix& coefficients) {
  const Index before = size_;
  reserve(size_ + block.cols(), block.rows());
  coefficients.setZero(size_ + block.cols(), block.cols());
  Mx_.resize(block.rows());
  for (Index j = 0; j < block.cols(); ++j) {
    auto x = block.col(j);
    const double norm = norm_in_M(x);
    for (int pass = 0; pass < 2 && size_ > 0; ++pass) {
      Vector c = W_.leftCols(size_).transpose() * x;
      sum(space_, c);
      x.noalias() -= V_.leftCols(size_) * c;
      coefficients.col(j).head(size_) += c;
    }
    const double remainder = norm_in_M(x);
    if (!(remainder > dependent * norm)) continue;
    V_.col(size_) = x / remainder;
    W_.col(size_) = Mx_ / remainder;
    coefficients(size_, j) = remainder;
    ++size_;
  }
  coefficients.conservativeResize(size_, Eigen::NoChange);
  return size_ - before;
}

// (e^{hT} − I)R, by the map F of S = T and M = I.
void KrylovSpace::exponentiate(double h) {
  R_.conservativeResizeLike(Matrix::Zero(T_.rows(), R_.cols()));
  change_ = R_;
  if (T_.rows() > 0) change_ = exponential_force<Matrix>(T_, Matrix::Identity(T_.rows(), T_.rows()), h) * R_;
}

void KrylovSpace::complain(double h) const {
  // T is skew: its norm is its spectral radius, and that of SM as far as the space has seen it
  const double radius = std::sqrt((T_.transpose() * T_).selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff());
  throw Error(
      "exponential = \"lanczos\" does not settle within {} blocks at h = {:.6g}, where hρ is about {:.3g} for the spectral "
      "radius ρ = {:.3g} of SM and about hρ blocks are needed; take a smaller h, or exponential = \"pade\"",
      most_blocks, h, std::abs(h) * radius, radius);
}

void KrylovSpace::build(const Matrix& start, double h, int blocks) {
  // What the next block would see of the change, against the vectors; and what round-off in e^{hT} may leave of it.
  constexpr double settled = 1e-15, round_off = 1e-13;
  int next_check = 4;
  const auto grow_T = [this](Index size) { T_.conservativeResizeLike(Matrix::Zero(size, size)); };
  size_ = 0;
  T_.resize(0, 0);
  Matrix block = start;
  Matrix coefficients;
  Index last = append(block, R_);
  const double scale = R_.norm();
  for (int k = 1; last > 0; ++k) {
    end_if_asked();
    // SM of the last block: inside the block, T; along the block before, −Tᵀ; the rest is the next block.
    const Index known = size_;
    const Index from = known - last;
    block.resize(start.rows(), last);
    for (Index j = 0; j < last; ++j) S_.apply(span_of(W_.col(from + j)), span_of(block.col(j)));
    Matrix inside = W_.middleCols(from, last).transpose() * block;
    sum(space_, inside);
    grow_T(known);
    T_.bottomRightCorner(last, last) = (inside - inside.transpose()) / 2;
    if (k == blocks) break;
    const Index next = append(block, coefficients);
    const Matrix coupling = coefficients.bottomRows(next);
    if (blocks == 0 && (k == next_check || k == most_blocks)) {
      exponentiate(h);
      const double rest = std::abs(h) * (coupling * (change_ + R_).bottomRows(last)).norm() / scale;
      if (rest <= settled || (k == most_blocks && rest <= round_off)) return;
      if (k == most_blocks) complain(h);
      next_check += std::max(4, k / 8);  // the exponential of T costs more than a few blocks
    }
    grow_T(size_);
    T_.block(known, from, next, last) = coupling;
    T_.block(from, known, last, next) = -coupling.transpose();
    last = next;
  }
  exponentiate(h);
}

}  // namespace seiche
