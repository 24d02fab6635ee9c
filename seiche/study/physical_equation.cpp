#include <seiche/core/error.hpp>
#include <seiche/study/physical_equation.hpp>

#include <algorithm>

namespace seiche {

PhysicalEquation::Rows PhysicalEquation::rows(const BlockStencil& stencil, const Grid& grid) {
  constexpr Index most = 8192;  // the matrix below is full before its zeros go
  if (stencil.fields() * grid.unknowns() > most)
    throw Error("a reference solution is computed for up to {} unknowns, and there are {}; choose fewer points", most,
                stencil.fields() * grid.unknowns());
  Rows rows;
  const Eigen::MatrixXd matrix = stencil.matrix(grid);
  for (Index i = 0; i < matrix.rows(); ++i) {
    rows.begin.push_back(rows.value.size());
    for (Index j = 0; j < matrix.cols(); ++j) {
      if (matrix(i, j) == 0) continue;
      rows.column.push_back(static_cast<std::size_t>(j));
      rows.value.push_back(matrix(i, j));
    }
  }
  rows.begin.push_back(rows.value.size());
  return rows;
}

PhysicalEquation::PhysicalEquation(const Problem& problem)
    : S_(rows(problem.S, problem.grid)),
      M_(rows(problem.M, problem.grid)),
      D_(problem.damping.constant.is_zero() ? Rows{} : rows(problem.damping.constant, problem.grid)),
      potential_(problem.potential),
      support_begin_(static_cast<std::size_t>(problem.potential_field * problem.grid.unknowns())),
      support_size_(static_cast<std::size_t>(problem.grid.unknowns())),
      rate_(problem.damping.rate),
      initial_(problem.initial.begin(), problem.initial.end()),
      gradient_(initial_.size()),
      force_(support_size_) {
  for (std::size_t i = 0; rate_ && i < initial_.size(); ++i) {
    if (problem.damping.rate_fields[i / support_size_]) rated_.push_back(i);
  }
}

template <class Combine>
void PhysicalEquation::for_products(const Rows& a, std::span<const double> z, const Combine& combine) {
  for (std::size_t i = 0; i + 1 < a.begin.size(); ++i) {
    double sum = 0;
    for (std::size_t k = a.begin[i]; k < a.begin[i + 1]; ++k) sum += a.value[k] * z[a.column[k]];
    combine(i, sum);
  }
}

void PhysicalEquation::gradient(std::span<const double> z) const {
  for_products(M_, z, [&](std::size_t i, double Mz) { gradient_[i] = Mz; });
  if (!potential_) return;
  potential_->value_and_gradient(z.subspan(support_begin_, support_size_), force_);
  for (std::size_t j = 0; j < support_size_; ++j) gradient_[support_begin_ + j] += force_[j];
}

void PhysicalEquation::right_hand_side(double t, std::span<const double> z, std::span<double> out) const {
  gradient(z);
  for_products(S_, gradient_, [&](std::size_t i, double S_gradient) { out[i] = S_gradient; });
  for_products(D_, z, [&](std::size_t i, double Dz) { out[i] -= Dz; });
  if (!rate_) return;
  const double gamma = rate_->value(t);
  for (const std::size_t i : rated_) out[i] -= gamma * z[i];
}

double PhysicalEquation::potential(std::span<const double> z) const {
  return potential_ ? potential_->value(z.subspan(support_begin_, support_size_)) : 0.0;
}

double PhysicalEquation::energy(std::span<const double> z) const {
  double twice_quadratic = 0;
  for_products(M_, z, [&](std::size_t i, double Mz) { twice_quadratic += z[i] * Mz; });
  return twice_quadratic / 2 + potential(z);
}

}  // namespace seiche
