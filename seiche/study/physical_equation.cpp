#include <seiche/core/base/error.hpp>
#include <seiche/core/momenta.hpp>
#include <seiche/study/physical_equation.hpp>

#include <algorithm>

namespace seiche {

PhysicalEquation::Rows PhysicalEquation::rows(const BlockStencil& stencil, const Grid& grid) {
  if (stencil.is_sparse()) return rows(stencil.sparse_matrix(grid));
  constexpr Index most = 8192;  // the matrix below is full before its zeros go
  if (stencil.fields() * grid.unknowns() > most)
    throw Error(
        "with spectral derivatives a reference solution is computed for up to {} unknowns, and there are {}; choose fewer "
        "points, or finite differences",
        most, stencil.fields() * grid.unknowns());
  return rows(SparseMatrix(stencil.matrix(grid).sparseView()));
}

PhysicalEquation::Rows PhysicalEquation::rows(const Stencil& stencil, const Grid& grid) {
  BlockStencil alone(1);
  alone(0, 0) = stencil;
  return rows(alone, grid);
}

PhysicalEquation::Rows PhysicalEquation::rows(const SparseMatrix& matrix) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = matrix;
  Rows rows;
  for (Index i = 0; i < by_rows.rows(); ++i) {
    rows.begin.push_back(rows.value.size());
    for (decltype(by_rows)::InnerIterator entry(by_rows, i); entry; ++entry) {
      rows.column.push_back(static_cast<std::size_t>(entry.col()));
      rows.value.push_back(entry.value());
    }
  }
  rows.begin.push_back(rows.value.size());
  return rows;
}

PhysicalEquation::PhysicalEquation(const Problem& problem)
    : potential_(problem.potential),
      points_(static_cast<std::size_t>(problem.grid.unknowns())),
      support_begin_(static_cast<std::size_t>(problem.potential_field) * points_),
      support_size_(potential_ ? static_cast<std::size_t>(potential_->fields()) * points_ : 0),
      rate_(problem.damping.rate),
      field_rate_(problem.damping.field_rate),
      friction_(problem.friction),
      forces_(problem.forces),
      structure_(problem.structure),
      initial_(problem.initial.begin(), problem.initial.end()),
      gradient_(initial_.size()),
      force_(support_size_),
      gamma_(points_),
      velocity_(initial_.size()),
      beyond_(initial_.size()) {
  if (friction_) {
    const std::optional<Momenta> found = momenta(problem);
    if (!found) throw Error("the friction {} acts on velocities, and {} has none", friction_->text(), problem.name);
    inverse_mass_ = found->inverse_mass;
  }
  for (const Stencil& along_axis : problem.derivatives) derivatives_.push_back(rows(along_axis, problem.grid));
  if (problem.matrices) {
    S_ = rows(problem.matrices->S);
    M_ = rows(problem.matrices->M);
    D_ = rows(problem.matrices->D);
  } else {
    S_ = rows(problem.S, problem.grid);
    M_ = rows(problem.M, problem.grid);
    if (!problem.damping.constant.is_zero()) D_ = rows(problem.damping.constant, problem.grid);
  }
  for (std::size_t field = 0; field < problem.damping.rate_fields.size(); ++field)
    if (problem.damping.rate_fields[field]) rated_.push_back(field * points_);
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
  add_beyond_linear(t, z, out);
  if (!rate_ && !field_rate_) return;
  std::fill(gamma_.begin(), gamma_.end(), 0.0);
  if (field_rate_) field_rate_->values(t, gamma_);
  const double everywhere = rate_ ? rate_->value(t) : 0.0;
  for (const std::size_t begin : rated_)
    for (std::size_t j = 0; j < points_; ++j) out[begin + j] -= (everywhere + gamma_[j]) * z[begin + j];
}

// After gradient(z).
void PhysicalEquation::add_beyond_linear(double t, std::span<const double> z, std::span<double> out) const {
  const std::size_t half = z.size() / 2;
  if (friction_) {
    for (std::size_t i = 0; i < half; ++i) velocity_[i] = inverse_mass_ * z[half + i];
    friction_->force(t, z.first(half), {velocity_.data(), half}, {beyond_.data(), half});
    for (std::size_t i = 0; i < half; ++i) out[half + i] -= beyond_[i];
  }
  for (std::size_t f = 0; f < forces_.size(); ++f) {
    if (!forces_[f]) continue;
    forces_[f]->values(t, {beyond_.data(), points_});
    for (std::size_t j = 0; j < points_; ++j) out[f * points_ + j] += beyond_[j];
  }
  if (structure_) {
    const auto derivative = [&](std::span<const double> u, Index axis, std::span<double> du) {
      for_products(derivatives_[static_cast<std::size_t>(axis)], u,
                   [&](std::size_t i, double value) { du[i] = value; });
    };
    structure_->apply(z, gradient_, derivative, beyond_);
    for (std::size_t i = 0; i < z.size(); ++i) out[i] += beyond_[i];
  }
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
