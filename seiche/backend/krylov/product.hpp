// Products with a matrix, whoever holds it: all that iterations and rational functions of it ask for.
#pragma once

#include <seiche/core/base/sparse_matrix.hpp>
#include <seiche/core/base/vector.hpp>

#include <span>
#include <utility>

namespace seiche {

class Product {
 public:
  virtual ~Product() = default;
  // y ← Ax, on the rows that this process holds of x and of y, which do not overlap. One call at a time.
  virtual void apply(std::span<const double> x, std::span<double> y) const = 0;
  void apply(const Vector& x, Vector& y) const {
    apply({x.data(), static_cast<std::size_t>(x.size())}, {y.data(), static_cast<std::size_t>(y.size())});
  }
};

// With a matrix of one process: a SparseMatrix, one by rows, or a reference to either.
template <class Matrix>
class SparseProduct final : public Product {
 public:
  explicit SparseProduct(Matrix a) : a_(std::forward<Matrix>(a)) {}
  using Product::apply;
  void apply(std::span<const double> x, std::span<double> y) const override {
    Eigen::Map<Vector>(y.data(), std::ssize(y)).noalias() = a_ * Eigen::Map<const Vector>(x.data(), std::ssize(x));
  }

 private:
  Matrix a_;
};

}  // namespace seiche
