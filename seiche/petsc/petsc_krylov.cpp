#include <seiche/petsc/petsc_krylov.hpp>

#include <optional>

namespace seiche {
namespace {

// a with what vanishes outside the support, in balanced coordinates.
class SupportProduct final : public Product {
 public:
  SupportProduct(Mat a, Potential::Support support, const Vector& scales)
      : a_(a), support_(support), scales_(scales), whole_(Vector::Zero(scales.size())) {}
  void apply(std::span<const double> x, std::span<double> y) const override {
    whole_.segment(support_.begin, support_.size) = Eigen::Map<const Vector>(x.data(), std::ssize(x));
    a_.apply({whole_.data(), static_cast<std::size_t>(whole_.size())}, y);
    Eigen::Map<Vector>(y.data(), std::ssize(y)).array() /= scales_.array();
  }

 private:
  PetscProduct a_;
  Potential::Support support_;
  Vector scales_;
  mutable Vector whole_;
};

class PetscKrylovOperators final : public KrylovOperators {
 public:
  PetscKrylovOperators(const PetscEquation& equation, Potential::Support support_of_V, const Space& of_states)
      : KrylovOperators(of_states), equation_(equation) {
    support = support_of_V;
    S = std::make_shared<PetscProduct>(equation.S);
    M = std::make_shared<PetscProduct>(equation.M);
    multiply(equation.S, equation.M, L_itself_);
    if (equation.D != nullptr) add(-1, equation.D, L_itself_);
    rate = spectral_radius_bound(L_itself_);
    scales = balancing_scales(L_itself_);
    const Vector inverse = scales.cwiseInverse();
    BorrowedVec left, right;
    for (BorrowedVec* v : {&left, &right}) v->set_layout(communicator_of(equation.S), scales.size());
    require(MatDiagonalScale(L_itself_, left.of(span_of(inverse)), right.of(span_of(scales))));
    L = std::make_shared<PetscProduct>(L_itself_);
    S_support = std::make_shared<SupportProduct>(equation.S, support, scales);
    holds_s = equation.ranks->here().index == 0;
  }

  // sym(MD₀) − M sym(S) M
  const Product& Q() const override {
    if (Q_) return *Q_;
    OwnedMat sym_S, M_sym_S, product;
    make_symmetric_part(equation_.S, sym_S);
    multiply(equation_.M, sym_S, M_sym_S);
    multiply(M_sym_S, equation_.M, product);
    if (equation_.D != nullptr) {
      OwnedMat MD;
      multiply(equation_.M, equation_.D, MD);
      make_symmetric_part(MD, Q_itself_);
      add(-1, product, Q_itself_);
    } else {
      require(MatDuplicate(product, MAT_COPY_VALUES, Q_itself_.make()));
      require(MatScale(Q_itself_, -1));
    }
    return Q_.emplace(Q_itself_);
  }

  PhiEvaluator::Dissipation dissipation() const override {
    if (dissipation_) return *dissipation_;
    OwnedMat sym_S;
    make_symmetric_part(equation_.S, sym_S);
    PhiEvaluator::Dissipation d;
    d.is_zero = is_zero(sym_S) && (equation_.D == nullptr || is_zero(equation_.D));
    d.is_quadratic =
        space.all(!has_entries(sym_S, support) && (equation_.D == nullptr || !has_entries(equation_.D, support)));
    if (!d.is_zero) Q();
    d.is_nonnegative = d.is_zero || is_nonnegative(Q_itself_);
    dissipation_ = d;
    return d;
  }

  bool without_casimirs(const Vector& /*z*/, Vector& /*d*/) const override { return false; }

 private:
  PetscEquation equation_;
  OwnedMat L_itself_;
  // When first asked for:
  mutable OwnedMat Q_itself_;
  mutable std::optional<PetscProduct> Q_;
  mutable std::optional<PhiEvaluator::Dissipation> dissipation_;
};

}  // namespace

std::unique_ptr<PhiEvaluator> petsc_phi(const PetscEquation& equation, Potential::Support support, const Space& space) {
  return krylov_phi(std::make_shared<PetscKrylovOperators>(equation, support, space));
}

}  // namespace seiche
