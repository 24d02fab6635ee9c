// ż = S(z)∇H(z) − D(t)z − R(t, z) + f(t) on physical values, straight from the stencils or matrices: it shares no
// operator, propagator or transform with backend/ and method/, so that a reference computed with it can judge them.
#pragma once

#include <seiche/core/problem.hpp>

#include <span>
#include <vector>

namespace seiche {

class PhysicalEquation {
 public:
  explicit PhysicalEquation(const Problem& problem);

  std::size_t size() const { return initial_.size(); }
  const std::vector<double>& initial() const { return initial_; }
  void right_hand_side(double t, std::span<const double> z, std::span<double> out) const;  // allocates nothing
  double potential(std::span<const double> z) const;
  double energy(std::span<const double> z) const;

 private:
  struct Rows {  // a sparse matrix, row by row
    std::vector<std::size_t> begin, column;
    std::vector<double> value;
  };
  static Rows rows(const BlockStencil& stencil, const Grid& grid);
  static Rows rows(const Stencil& stencil, const Grid& grid);
  static Rows rows(const SparseMatrix& matrix);
  template <class Combine>
  static void for_products(const Rows& a, std::span<const double> z, const Combine& combine);
  void gradient(std::span<const double> z) const;  // ∇H into gradient_

  void add_beyond_linear(double t, std::span<const double> z, std::span<double> out) const;

  Rows S_, M_, D_;
  std::vector<Rows> derivatives_;
  std::shared_ptr<const PointwisePotential> potential_;
  std::size_t points_, support_begin_, support_size_;
  RatePointer rate_;
  FieldRatePointer field_rate_;
  FrictionPointer friction_;
  double inverse_mass_ = 1;
  std::vector<FieldRatePointer> forces_;
  StructurePointer structure_;
  std::vector<std::size_t> rated_;  // where the fields begin that γ damps
  std::vector<double> initial_;
  mutable std::vector<double> gradient_, force_, gamma_, velocity_, beyond_;
};

}  // namespace seiche
