// Translation-invariant operators on a grid, stated once and understood by every backend.
#pragma once

#include <seiche/core/grid.hpp>

#include <Eigen/Dense>

#include <complex>
#include <map>
#include <vector>

namespace seiche {

// (Au)_j = Σ_k c_k u_{j+k}. Where the field vanishes at the ends it is continued as an odd function, so only
// symmetric stencils act there within the sines.
class Stencil {
 public:
  Stencil() = default;  // the zero operator
  static Stencil identity(double factor = 1.0);
  static Stencil laplacian(double dx);           // R: (u_{j+1} − 2u_j + u_{j−1}) / Δx²
  static Stencil central_difference(double dx);  // (u_{j+1} − u_{j−1}) / 2Δx

  Stencil& operator+=(const Stencil& other);
  Stencil& operator*=(double factor);
  friend Stencil operator+(Stencil a, const Stencil& b) { return a += b; }
  friend Stencil operator*(double factor, Stencil a) { return a *= factor; }

  bool is_zero() const { return taps_.empty(); }
  bool is_symmetric() const;
  bool is_identity() const;
  double coefficient(int offset) const;
  const std::map<int, double>& taps() const { return taps_; }  // offset k → c_k

  // Eigenvalue on e^{2πi j mode / period}: exact zeros where the sines vanish, no cancellation near mode 0.
  std::complex<double> symbol(Index mode, Index period) const;
  Eigen::MatrixXd matrix(const Grid& grid) const;

 private:
  void drop_zeros();
  std::map<int, double> taps_;
};

// An m × m block of stencils acting on m fields: the S, M or D of a problem.
class BlockStencil {
 public:
  BlockStencil() = default;
  explicit BlockStencil(Index fields);

  Index fields() const { return fields_; }
  Stencil& operator()(Index row, Index column);
  const Stencil& operator()(Index row, Index column) const;
  bool is_zero() const;

  Eigen::MatrixXcd symbol(Index mode, Index period) const;  // m × m
  Eigen::MatrixXd matrix(const Grid& grid) const;           // field-major: all of field 0, then field 1, …

 private:
  Index fields_ = 0;
  std::vector<Stencil> entries_;
};

// The modes of a grid and the period of their phases: mode k has the symbol at angle 2πk / period.
// Periodic: k = 0 … ⌊N/2⌋ of N; Dirichlet: k = 1 … N−1 of 2N.
struct Modes {
  Index first;
  Index count;
  Index period;
};
Modes modes(const Grid& grid);

}  // namespace seiche
