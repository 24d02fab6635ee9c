// Translation-invariant operators on a grid, stated once and understood by every backend.
#pragma once

#include <seiche/core/grid.hpp>
#include <seiche/core/modes.hpp>
#include <seiche/core/sparse_operators.hpp>

#include <Eigen/Dense>

#include <complex>
#include <optional>
#include <vector>

namespace seiche {

// How derivatives are taken: central differences of order two or four, or exactly on the modes of the grid.
enum class Discretisation { fd2, fd4, spectral };

// A multiple of the identity plus derivatives of order one to three along the axes. Beyond a Dirichlet end a field is
// continued as an odd function, beyond a Neumann end as an even one; odd derivatives need periodic axes.
class Stencil {
 public:
  Stencil() = default;  // the zero operator
  static Stencil identity(double factor = 1.0);
  static Stencil laplacian(const Grid& grid, Discretisation discretisation = Discretisation::fd2);
  static Stencil derivative(const Grid& grid, Index axis = 0, Discretisation discretisation = Discretisation::fd2);

  // The first derivative of the second.
  static Stencil third_derivative(const Grid& grid, Index axis = 0,
                                  Discretisation discretisation = Discretisation::fd2);

  Stencil& operator+=(const Stencil& other);
  Stencil& operator*=(double factor);
  friend Stencil operator+(Stencil a, const Stencil& b) { return a += b; }
  friend Stencil operator*(double factor, Stencil a) { return a *= factor; }

  bool is_zero() const { return identity_ == 0 && terms_.empty(); }
  bool is_identity() const { return identity_ == 1 && terms_.empty(); }
  std::optional<double> factor_of_identity() const;  // nothing where there are derivatives
  bool is_symmetric() const;                         // no odd derivatives
  bool is_sparse() const;                            // no spectral derivatives, which couple all points

  // Eigenvalue on a mode: exact zeros where the sines vanish, no cancellation near the mean.
  std::complex<double> symbol(const Mode& mode) const;
  Eigen::MatrixXd matrix(const Grid& grid) const;
  SparseMatrix sparse_matrix(const Grid& grid) const;  // throws Error unless is_sparse()

 private:
  struct Term {  // factor · (∂/∂x_axis)^order
    Index axis;
    int order;
    Discretisation discretisation;
    double dx;
    double factor;
  };
  static Stencil odd_derivative(const Grid& grid, Index axis, int order, Discretisation discretisation);
  static std::complex<double> symbol(const Term& term, Index k, Index period);
  static Eigen::MatrixXd line_matrix(const Term& term, const GridAxis& axis);

  double identity_ = 0.0;
  std::vector<Term> terms_;
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
  bool is_sparse() const;        // every entry
  bool has_real_symbol() const;  // no odd derivatives: the blocks of all modes are real

  Eigen::MatrixXcd symbol(const Mode& mode) const;  // m × m
  Eigen::MatrixXd matrix(const Grid& grid) const;   // field-major: all of field 0, then field 1, …
  SparseMatrix sparse_matrix(const Grid& grid) const;

 private:
  Index fields_ = 0;
  std::vector<Stencil> entries_;
};

}  // namespace seiche
