// The exponential of a small Hessenberg matrix times e₁, walked along.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <Eigen/Dense>

#include <cmath>

namespace seiche {

// y' = Hy, y(0) = e₁, for the (m+1) × m matrix H of m steps of Arnoldi iteration: its last component is the usual
// estimate of the error of the first m, β h_{m+1,m} e_mᵀ τφ₁(τH)e₁ (Saad 1992), and belongs to the solution that it
// corrects.
class HessenbergFlow {
 public:
  explicit HessenbergFlow(Index most_columns);

  Index columns() const { return columns_; }
  void clear();
  // The next column of H: as many numbers as there are columns then, and one more.
  void append(const Vector& column);

  void start();                           // y ← e₁
  void advance(double tau);               // y ← e^{τH}y, by Taylor's series; τ ≤ reach()
  double reach() const;                   // beyond it, Taylor's series has a hump
  const Vector& y() const { return y_; }  // the first columns() + 1 of them
  double error() const { return std::abs(y_[columns_]); }

 private:
  Eigen::MatrixXd H_;
  Index columns_ = 0;
  double norm_ = 0;  // ‖H‖₁
  Vector y_, term_, next_;
};

}  // namespace seiche
