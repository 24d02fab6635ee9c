#include <seiche/backend/krylov/balance.hpp>
#include <seiche/backend/sparse/pade.hpp>
#include <seiche/backend/sparse/sparse_kernel.hpp>
#include <seiche/backend/sparse/sparse_phi.hpp>
#include <seiche/core/numerics/definiteness.hpp>

#include <optional>

namespace seiche {
namespace {

using Support = Potential::Support;
using RowMajor = Eigen::SparseMatrix<double, Eigen::RowMajor>;

bool has_entries(const SparseMatrix& A, Support rows) {
  bool has = false;
  for_entries(A, [&](Index i, Index, double value) {
    has = has || (value != 0 && i >= rows.begin && i < rows.begin + rows.size);
  });
  return has;
}

class SparseKrylovOperators final : public KrylovOperators {
 public:
  SparseKrylovOperators(std::shared_ptr<const SparseOperators> operators, const SparseMatrix& D0, Support support_of_V,
                        const Space& of_states)
      : KrylovOperators(of_states), operators_(std::move(operators)), D0_(D0) {
    support = support_of_V;
    S = std::make_shared<SparseProduct<const SparseMatrix&>>(operators_->S);
    M = std::make_shared<SparseProduct<const SparseMatrix&>>(operators_->M);
    const SparseMatrix L_itself = SparseMatrix(operators_->S * operators_->M) - D0_;
    rate = spectral_radius_bound(L_itself);
    scales = balancing_scales(L_itself);
    const Vector inverse = scales.cwiseInverse();
    L = std::make_shared<SparseProduct<RowMajor>>(inverse.asDiagonal() * L_itself * scales.asDiagonal());
    S_support = std::make_shared<SparseProduct<RowMajor>>(inverse.asDiagonal() *
                                                          operators_->S.middleCols(support.begin, support.size));
  }

  // sym(MD₀) − M sym(S) M
  const Product& Q() const override {
    if (Q_) return *Q_;
    Q_of_matrix_ = symmetric_part(SparseMatrix(operators_->M * D0_));
    const SparseMatrix sym_S = symmetric_part(operators_->S);
    if (has_entries(sym_S, {0, space.size()})) Q_of_matrix_ -= SparseMatrix(operators_->M * sym_S) * operators_->M;
    Q_of_matrix_.prune(0.0);  // what is stored and zero would still fill the factors of Q
    return Q_.emplace(Q_of_matrix_);
  }

  PhiEvaluator::Dissipation dissipation() const override {
    if (dissipation_) return *dissipation_;
    const SparseMatrix sym_S = symmetric_part(operators_->S);
    const Support everywhere{0, space.size()};
    PhiEvaluator::Dissipation d;
    d.is_quadratic = !has_entries(D0_, support) && !has_entries(sym_S, support);
    d.is_zero = !has_entries(D0_, everywhere) && !has_entries(sym_S, everywhere);
    if (!d.is_zero) Q();
    d.is_nonnegative = d.is_zero || !negative_direction(Q_of_matrix_);
    dissipation_ = d;
    return d;
  }

  bool without_casimirs(const Vector& z, Vector& d) const override {
    if (!kernel_) {
      kernel_ = sparse_kernel(operators_->S.transpose());
      products_.resize(kernel_->cols());
    }
    if (kernel_->cols() == 0) return false;
    products_.noalias() = kernel_->transpose() * z;
    d = z;
    d.noalias() -= *kernel_ * products_;
    return true;
  }

 private:
  std::shared_ptr<const SparseOperators> operators_;
  SparseMatrix D0_;
  // When first asked for:
  mutable SparseMatrix Q_of_matrix_;
  mutable std::optional<SparseProduct<const SparseMatrix&>> Q_;
  mutable std::optional<PhiEvaluator::Dissipation> dissipation_;
  mutable std::optional<SparseMatrix> kernel_;
  mutable Vector products_;
};

}  // namespace

std::unique_ptr<PhiEvaluator> sparse_phi(std::shared_ptr<const SparseOperators> operators, const SparseMatrix& D0,
                                         Potential::Support support, const Space& space) {
  return krylov_phi(std::make_shared<SparseKrylovOperators>(std::move(operators), D0, support, space));
}

}  // namespace seiche
