// Translation-invariant operators on a grid, stated once and understood by every backend.
#pragma once

#include <seiche/core/grid/fourier_multiplier.hpp>
#include <seiche/core/grid/grid.hpp>
#include <seiche/core/grid/modes.hpp>
#include <seiche/core/grid/sparse_operators.hpp>

#include <Eigen/Dense>

#include <complex>
#include <memory>
#include <optional>
#include <vector>

namespace seiche {

// How derivatives are taken: central differences of order two or four, or exactly on the modes of the grid.
enum class Discretisation { fd2, fd4, spectral };

// A multiple of the identity, plus derivatives of order one to four along the axes, plus functions of the wave vector,
// plus products of such. Beyond a Dirichlet end a field is continued as an odd function, beyond a Neumann end as an
// even one; odd derivatives need periodic axes.
class Stencil {
 public:
  Stencil() = default;  // the zero operator
  static Stencil identity(double factor = 1.0);
  static Stencil laplacian(const Grid& grid, Discretisation discretisation = Discretisation::fd2);
  // The second derivative along one axis, and that of it.
  static Stencil second_derivative(const Grid& grid, Index axis = 0,
                                   Discretisation discretisation = Discretisation::fd2);
  static Stencil fourth_derivative(const Grid& grid, Index axis = 0,
                                   Discretisation discretisation = Discretisation::fd2);
  static Stencil derivative(const Grid& grid, Index axis = 0, Discretisation discretisation = Discretisation::fd2);

  // The first derivative of the second.
  static Stencil third_derivative(const Grid& grid, Index axis = 0,
                                  Discretisation discretisation = Discretisation::fd2);

  // Symbol f(κ), or i f(κ) where f is odd; throws Error as FourierMultiplier does.
  static Stencil multiplier(const Grid& grid, WaveFunction f, Parity parity = Parity::even);
  // One after the other: Δ² of several axes, which no sum over axes is.
  static Stencil product(const Stencil& a, const Stencil& b);

  Stencil& operator+=(const Stencil& other);
  Stencil& operator*=(double factor);
  friend Stencil operator+(Stencil a, const Stencil& b) { return a += b; }
  friend Stencil operator*(double factor, Stencil a) { return a *= factor; }

  bool is_zero() const { return factor_of_identity() == 0.0; }
  bool is_identity() const { return factor_of_identity() == 1.0; }
  std::optional<double> factor_of_identity() const;   // nothing where there is anything else
  double identity_part() const { return identity_; }  // beside the derivatives
  bool is_symmetric() const;                          // nothing odd
  bool is_sparse() const;                             // nothing spectral, which couples all points

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
  struct Multiplier {
    std::shared_ptr<const FourierMultiplier> function;
    double factor;
  };
  struct Product {
    std::shared_ptr<const Stencil> first, second;
    double factor;
    bool is_symmetric() const { return first->is_symmetric() && second->is_symmetric(); }
    SparseMatrix sparse_matrix(const Grid& grid) const;
  };
  double entries_per_row() const;
  static Stencil odd_derivative(const Grid& grid, Index axis, int order, Discretisation discretisation);
  static std::complex<double> symbol(const Term& term, Index k, Index period);
  static Eigen::MatrixXd line_matrix(const Term& term, const GridAxis& axis);

  void drop_what_vanishes();

  double identity_ = 0.0;
  std::vector<Term> terms_;
  std::vector<Multiplier> multipliers_;
  std::vector<Product> products_;
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
