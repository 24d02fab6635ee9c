#include <seiche/backend/reference/long_matrix.hpp>
#include <seiche/backend/reference/reference_phi.hpp>
#include <seiche/core/numerics/gauss_rule.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SparseCore>

#include <cmath>
#include <utility>

namespace seiche {
namespace {

using Matrix = Eigen::MatrixXd;

struct ReferenceOperators {
  LongMatrix L, Q;  // Q: sym(MD₀) − M sym(S) M
  Eigen::SparseMatrix<long double> S;
  Potential::Support support;
};

// The maps of rows from z and all forces, one under the other.
class ReferenceRows {
 public:
  ReferenceRows(const PhiRows& rows, const ReferenceOperators& operators, double h)
      : rows_(rows), operators_(operators), h_(h) {}

  LongMatrix of(const PhiRow& row) {
    const Index n = operators_.L.rows();
    if (phi_.empty() || row.theta != theta_) phi_ = reference_phi_functions(row.theta * h_ * operators_.L, rows_.order);
    theta_ = row.theta;
    LongMatrix wide = LongMatrix::Zero(n, n * (1 + rows_.forces));
    if (rows_.of_state) wide.leftCols(n) = long_identity(n) + phi_[0];
    for (Index j = 0; j < rows_.forces; ++j) {
      LongMatrix sum = LongMatrix::Zero(n, n);
      for (Index k = 0; k < rows_.order; ++k)
        sum += h_ * row.weights[static_cast<std::size_t>(j * rows_.order + k)] * phi_[static_cast<std::size_t>(k) + 1];
      if (rows_.kind == PhiRows::Forces::gradients) sum = (sum * operators_.S).eval();
      wide.middleCols((1 + j) * n, n) = sum;
    }
    return wide;
  }

 private:
  const PhiRows& rows_;
  const ReferenceOperators& operators_;
  long double h_;
  double theta_ = 0;  // of phi_
  std::vector<LongMatrix> phi_;
};

// z and all forces, one under the other; of gradients what lies outside the support stays zero.
class ReferenceStack {
 public:
  ReferenceStack(const PhiRows& rows, const ReferenceOperators& of)
      : size_(of.L.rows()),
        of_forces_(rows.kind == PhiRows::Forces::gradients ? of.support : Potential::Support{0, size_}),
        y_(Vector::Zero(size_ * (1 + rows.forces))) {}

  const Vector& of(const Vector& z, std::span<const Vector> forces) const {
    y_.head(size_) = z;
    Index begin = size_ + of_forces_.begin;
    for (const Vector& f : forces) {
      y_.segment(begin, of_forces_.size) = f.segment(of_forces_.begin, of_forces_.size);
      begin += size_;
    }
    return y_;
  }

 private:
  Index size_;
  Potential::Support of_forces_;
  mutable Vector y_;
};

class ReferencePhiMap final : public PhiMap {
 public:
  ReferencePhiMap(const PhiRows& rows, const ReferenceOperators& of, double h)
      : stack_(rows, of),
        outputs_(rows.outputs == PhiRows::Outputs::support ? of.support : Potential::Support{0, of.L.rows()}) {
    const Index n = of.L.rows();
    ReferenceRows maps(rows, of, h);
    tall_.resize(n * static_cast<Index>(rows.rows.size()), n * (1 + rows.forces));
    for (std::size_t i = 0; i < rows.rows.size(); ++i)
      tall_.middleRows(n * static_cast<Index>(i), n) = maps.of(rows.rows[i]).cast<double>();
    result_.resize(tall_.rows());
  }

  void apply(const Vector& z, std::span<const Vector> forces, std::span<Vector> out) const override {
    result_.noalias() = tall_ * stack_.of(z, forces);
    Index begin = outputs_.begin;
    for (Vector& v : out) {
      v.segment(outputs_.begin, outputs_.size) = result_.segment(begin, outputs_.size);
      begin += v.size();
    }
  }

 private:
  ReferenceStack stack_;
  Potential::Support outputs_;
  Matrix tall_;
  mutable Vector result_;
};

// ∫₀ʰ Q(x) dt along ẋ = Lx + n from x = z, as a form of (z, n): by Gauss's rule (nodes in double) over a time t in
// which little happens, and doublings W(2t) = W(t) + EᵀW(t)E with E the flow of (x, n) over t. It leaves n alone: of E
// only x is kept.
LongMatrix integral_along_flow(const LongMatrix& L, const LongMatrix& Q, double h) {
  const Index n = L.rows();
  const int halvings = reference_halvings(static_cast<long double>(h) * L);
  const long double t = std::ldexp(static_cast<long double>(h), -halvings);
  const auto flow = [&](long double s) {
    const std::vector<LongMatrix> phi = reference_phi_functions(s * L, 1);
    LongMatrix x(n, 2 * n);
    x << long_identity(n) + phi[0], s * phi[1];
    return x;
  };
  LongMatrix W = LongMatrix::Zero(2 * n, 2 * n);
  for (const auto& [place, weight] : gauss_rule(12)) {
    const LongMatrix x = flow(place * t);
    W += weight * t * (x.transpose() * (Q * x));
  }
  LongMatrix x = flow(t);
  for (int i = 0; i < halvings; ++i) {
    LongMatrix WE = W.leftCols(n) * x;
    WE.rightCols(n) += W.rightCols(n);
    W += x.transpose() * WE.topRows(n);
    W.bottomRows(n) += WE.bottomRows(n);
    LongMatrix next = x.leftCols(n) * x;
    next.rightCols(n) += x.rightCols(n);
    x.swap(next);
  }
  return W;
}

class ReferencePhiForms final : public PhiForms {
 public:
  ReferencePhiForms(std::span<const PhiEvaluator::Form> forms, const ReferenceOperators& of, double h)
      : stack_(forms.front().rows, of) {
    const Index n = of.L.rows();
    for (const auto& [rows, coefficients, minus_integral] : forms) {
      const Index size = n * (1 + rows.forces);
      LongMatrix gram = LongMatrix::Zero(size, size);
      ReferenceRows maps(rows, of, h);
      for (std::size_t i = 0; i < rows.rows.size(); ++i) {
        const LongMatrix row = maps.of(rows.rows[i]);
        gram += static_cast<long double>(coefficients[i]) * (row.transpose() * (of.Q * row));
      }
      if (minus_integral) {
        LongMatrix z_and_n = LongMatrix::Zero(2 * n, size);
        z_and_n.topLeftCorner(n, n) = long_identity(n);
        for (Index j = 1; j <= rows.forces; ++j)
          z_and_n.block(n, n * j, n, n) = rows.kind == PhiRows::Forces::gradients ? LongMatrix(of.S) : long_identity(n);
        gram -= z_and_n.transpose() * (integral_along_flow(of.L, of.Q, h) * z_and_n);
      }
      grams_.emplace_back(gram.cast<double>());
    }
    image_.resize(grams_.front().rows());
  }

  void apply(const Vector& z, std::span<const Vector> forces, std::span<double> values) const override {
    const Vector& y = stack_.of(z, forces);
    for (std::size_t l = 0; l < grams_.size(); ++l) {
      image_.noalias() = grams_[l] * y;
      values[l] = y.dot(image_);
    }
  }

 private:
  ReferenceStack stack_;
  std::vector<Matrix> grams_;
  mutable Vector image_;
};

class ReferencePhi final : public PhiEvaluator {
 public:
  ReferencePhi(const Matrix& S, const Matrix& M, const Matrix& D0, Potential::Support support) {
    const LongMatrix s = S.cast<long double>(), m = M.cast<long double>(), d = D0.cast<long double>();
    const LongMatrix damped = m * d - m * s * m;
    operators_ = {.L = s * m - d, .Q = (damped + damped.transpose()) / 2, .S = s.sparseView(), .support = support};
    // a little above what round-off makes of a multiple eigenvalue
    rate_ = (1 + 1e-6) * operators_.L.cast<double>().eval().eigenvalues().cwiseAbs().maxCoeff();
    const Matrix symmetric_S = S + S.transpose();
    const auto [begin, size] = support;
    dissipation_.is_quadratic = D0.middleRows(begin, size).isZero(0) && symmetric_S.middleRows(begin, size).isZero(0);
    dissipation_.is_zero = D0.isZero(0) && symmetric_S.isZero(0);
    const Vector rates =
        Eigen::SelfAdjointEigenSolver<Matrix>(operators_.Q.cast<double>(), Eigen::EigenvaluesOnly).eigenvalues();
    dissipation_.is_nonnegative = rates.minCoeff() >= -1e-13 * rates.cwiseAbs().maxCoeff();
    const Eigen::FullPivLU<Matrix> lu = Eigen::FullPivLU<Matrix>(S.transpose()).setThreshold(1e-12);
    casimirs_.resize(S.rows(), lu.dimensionOfKernel());
    if (casimirs_.cols() > 0)
      casimirs_ = Eigen::HouseholderQR<Matrix>(lu.kernel()).householderQ() *
                  Matrix::Identity(casimirs_.rows(), casimirs_.cols());
    products_.resize(casimirs_.cols());
  }

  bool has_tables() const override { return true; }
  double rate() const override { return rate_; }
  std::unique_ptr<PhiMap> map(const PhiRows& rows, double h) const override {
    return std::make_unique<ReferencePhiMap>(rows, operators_, h);
  }
  std::unique_ptr<PhiForms> forms(std::span<const Form> forms, double h) const override {
    return std::make_unique<ReferencePhiForms>(forms, operators_, h);
  }
  Dissipation dissipation() const override { return dissipation_; }
  bool without_casimirs(const Vector& z, Vector& d) const override {
    if (casimirs_.cols() == 0) return false;
    products_.noalias() = casimirs_.transpose() * z;
    d = z;
    d.noalias() -= casimirs_ * products_;
    return true;
  }

 private:
  ReferenceOperators operators_;
  double rate_ = 0;
  Dissipation dissipation_;
  Matrix casimirs_;  // orthonormal columns c, cᵀS = 0
  mutable Vector products_;
};

}  // namespace

std::unique_ptr<PhiEvaluator> reference_phi(const Matrix& S, const Matrix& M, const Matrix& D0,
                                            Potential::Support support) {
  return std::make_unique<ReferencePhi>(S, M, D0, support);
}

}  // namespace seiche
