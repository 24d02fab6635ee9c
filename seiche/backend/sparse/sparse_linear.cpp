#include <seiche/backend/krylov/lanczos.hpp>
#include <seiche/backend/krylov/sparse_ldlt.hpp>
#include <seiche/backend/sparse/equal_rows.hpp>
#include <seiche/backend/sparse/pade_propagator.hpp>
#include <seiche/backend/sparse/sparse_linear.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/memory_limit.hpp>
#include <seiche/core/numerics/definiteness.hpp>

#include <fmt/format.h>

#include <cmath>

namespace seiche {
namespace {

struct Operators {
  SparseMatrix S, M, absolute_M;
  Potential::Support support;
};

SparseMatrix with_diagonal(const SparseMatrix& M) {
  SparseMatrix a = M + SparseMatrix(0 * identity_matrix(M.rows()));
  a.makeCompressed();
  return a;
}

class SparseSkewSystem final : public SkewSystem {
 public:
  SparseSkewSystem(const Operators& operators, const Product& of_S, const Product& of_M, const Space& of_states)
      : SkewSystem(of_S, of_M, of_states) {
    if (SparseMatrix(operators.S + SparseMatrix(operators.S.transpose())).norm() != 0) throw lanczos_needs_skew_S();
    constexpr double least = 1e-12;
    const double size = operators.M.norm();
    const SparseMatrix lowered = operators.M - SparseMatrix(least * size * identity_matrix(operators.M.rows()));
    if (const auto x = negative_direction(lowered))
      throw lanczos_needs_definite_M(fmt::format("zᵀMz = {:.3g} for a z of norm 1", x->value + least * size));
    const SparseMatrix a = with_diagonal(operators.M);
    M_factors_ = std::make_unique<SparseLdlt<double>>(std::make_shared<LdltPattern>(a), a.valuePtr());
  }
  void divide_by_M(Vector& f) const override { M_factors_->solve(f); }

 private:
  std::unique_ptr<SparseLdlt<double>> M_factors_;
};

class SparseLinear final : public LinearPart {
 public:
  SparseLinear(Operators operators, const SparseOptions& options, const Space& space)
      : operators_(std::move(operators)),
        options_(options),
        space_(space),
        rows_of_M_(EqualRows::of(operators_.M)),
        radius_(spectral_radius_bound(operators_.S * operators_.M)),
        scratch_(operators_.S.rows()),
        absolute_(operators_.S.rows()) {
    if (options.exponential == ExponentialKind::lanczos)
      skew_ = std::make_shared<SparseSkewSystem>(operators_, S_, M_, space_);
  }

  void apply_S(const Vector& z, Vector& out) const override { out.noalias() = operators_.S * z; }
  bool apply_symmetric_S(const Vector& z, Vector& out) const override {
    if (!symmetric_S_) {
      symmetric_S_ = 0.5 * (operators_.S + SparseMatrix(operators_.S.transpose()));
      symmetric_S_->prune(0.0);
    }
    if (symmetric_S_->nonZeros() == 0) return false;
    out.noalias() = *symmetric_S_ * z;
    return true;
  }
  void apply_M(const Vector& z, Vector& out) const override {
    if (rows_of_M_)
      rows_of_M_->apply(z, out);
    else
      out.noalias() = operators_.M * z;
  }
  double quadratic_energy(const Vector& z) const override {
    if (rows_of_M_) return rows_of_M_->form(z) / 2;
    scratch_.noalias() = operators_.M * z;
    return z.dot(scratch_) / 2;
  }
  double quadratic_magnitude(const Vector& z) const override {
    absolute_ = z.cwiseAbs();  // a product with an expression would allocate
    scratch_.noalias() = operators_.absolute_M * absolute_;
    return absolute_.dot(scratch_) / 2;
  }
  ValueAndMagnitude quadratic(const Vector& z) const override {
    if (!rows_of_M_) return LinearPart::quadratic(z);
    const auto [value, magnitude] = rows_of_M_->form_and_magnitude(z);
    return {value / 2, magnitude / 2};
  }
  std::unique_ptr<Propagator> propagator(PropagatorKind kind, double h) const override {
    if (kind == PropagatorKind::cayley) {
      require_memory(1);
      return pade_propagator(M_, space_, operators_.support, force(h, {1, 1}), nullptr);
    }
    if (skew_) return lanczos_propagator(skew_, operators_.support, h, options_.lanczos_dimension);
    const PadePlan whole = plan(h);
    const PadePlan half = plan(h / 2);
    require_memory(whole.degree + half.degree);
    return pade_propagator(M_, space_, operators_.support, force(h, whole), force(h / 2, half));
  }

 private:
  PadePlan plan(double h) const { return plan_exponential(std::abs(h) * radius_, options_); }
  std::unique_ptr<PadeForce> force(double h, PadePlan plan) const {
    return std::make_unique<PadeForce>(S_, M_, operators_.S.rows(), factory(), h, plan);
  }
  const ResolventFactory& factory() const {
    if (!factory_) factory_ = std::make_unique<ResolventFactory>(operators_.S, operators_.M);
    return *factory_;
  }
  void require_memory(int degrees) const {
    if (factor_bytes_ < 0) factor_bytes_ = factory().factor_bytes();
    const double bytes = factor_bytes_ * degrees / 2;  // two degrees share a complex pole, and a real one takes half
    if (bytes > memory_limit())
      throw Error(
          "the factors of the sparse backend need about {:.3g} bytes, but only {:.3g} are available; a method with the "
          "Cayley propagator needs {:.3g}, and [backend] exponential = \"lanczos\" factorises M alone",
          bytes, memory_limit(), factor_bytes_ / 2);
  }

  Operators operators_;
  SparseProduct<const SparseMatrix&> S_{operators_.S}, M_{operators_.M};
  SparseOptions options_;
  const Space& space_;
  std::optional<EqualRows> rows_of_M_;                 // nothing where coefficients change from point to point
  mutable std::unique_ptr<ResolventFactory> factory_;  // when first asked for: Lanczos needs none
  mutable double factor_bytes_ = -1;                   // likewise
  double radius_;
  std::shared_ptr<const SkewSystem> skew_;           // null: Padé
  mutable std::optional<SparseMatrix> symmetric_S_;  // likewise
  mutable Vector scratch_, absolute_;
};

}  // namespace

std::unique_ptr<LinearPart> sparse_linear_part(const SparseMatrix& S, const SparseMatrix& M, Potential::Support support,
                                               const SparseOptions& options, const Space& space) {
  return std::make_unique<SparseLinear>(Operators{S, M, M.cwiseAbs(), support}, options, space);
}

}  // namespace seiche
