// The contract of a propagator, restored where its parts are known to a tolerance only.
#pragma once

#include <seiche/backend/krylov/product.hpp>
#include <seiche/core/space.hpp>

#include <Eigen/Dense>

#include <array>

namespace seiche {

// For a skew S. With q = Ff and y_j = Fw_j of the vectors before it, the contract says
//   e_j = w_jᵀq + fᵀy_j + y_jᵀMq = 0  and  2fᵀq + qᵀMq = 0:
// Newton's method for q + Σ a_j y_j + a q finds the a that q misses, until both hold to round-off.
class Restoration {
 public:
  // All outlive it. `moved` becomes the largest relative move.
  Restoration(const Product& M, const Space& space, double& moved);

  void start(const Vector& w, Vector& y);  // y ≈ Fw, the first one
  // Of what follows the first and the second vector, each is restored against these two.
  void follow(const Vector& f, Vector& q);

 private:
  struct Pair {
    Vector w, y, My;
  };
  static constexpr int most = 3, most_rounds = 8;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;
  using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;

  double dot(const Vector& a, const Vector& b) const { return space_.dot(a, b); }
  const Vector& y(Index i, const Vector& q) const;
  bool misses(const Vector& f, const Vector& q);
  void move(const Vector& f, Vector& q);

  const Product& M_;
  const Space& space_;
  double& moved_;
  std::array<Pair, most - 1> before_;
  std::size_t known_ = 0;
  Coefficients e_, size_;
  Vector Mq_;
};

}  // namespace seiche
