#include <seiche/backend/krylov/sparse_ldlt.hpp>
#include <seiche/backend/sparse/resolvent.hpp>
#include <seiche/backend/sparse/sparse_lu.hpp>

namespace seiche {
namespace {

SparseMatrix block(const SparseMatrix& a, Index row, Index column, Index n) {
  SparseMatrix b = a.block(row, column, n, n);
  b.prune([](Index, Index, double value) { return value != 0; });
  return b;
}

bool equal(const SparseMatrix& a, const SparseMatrix& b) { return SparseMatrix(a - b).norm() == 0; }

bool is_symmetric(const SparseMatrix& a) { return equal(a, SparseMatrix(a.transpose())); }

double as(std::complex<double> p, double) { return p.real(); }
std::complex<double> as(std::complex<double> p, std::complex<double>) { return p; }

void to_result(const Vector& x, std::complex<double>, Vector& out) { out = x; }
void to_result(const Eigen::VectorXcd& x, std::complex<double> p, Vector& out) { out = x.imag() / p.imag(); }

// hB − p, with a place for every diagonal entry.
template <class Scalar>
Eigen::SparseMatrix<Scalar> shifted(const SparseMatrix& B, double h, std::complex<double> p) {
  const Eigen::SparseMatrix<Scalar> one = identity_matrix(B.rows()).cast<Scalar>();
  Eigen::SparseMatrix<Scalar> a = SparseMatrix(h * B).cast<Scalar>() - as(p, Scalar()) * one;
  a.makeCompressed();
  return a;
}

// By whichever factorisation of A − p.
template <class Scalar, class Factors>
class DirectResolvent final : public Resolvent {
 public:
  DirectResolvent(Index size, std::complex<double> p, Factors factors)
      : p_(p), factors_(std::move(factors)), x_(size) {}
  void apply(const Vector& b, Vector& x) const override {
    x_ = b.template cast<Scalar>();
    factors_.solve(x_);
    to_result(x_, p_, x);
  }

 private:
  std::complex<double> p_;
  Factors factors_;
  mutable Eigen::Matrix<Scalar, Eigen::Dynamic, 1> x_;
};

template <class Scalar>
class WaveResolvent final : public Resolvent {
 public:
  // `all`: a zero at every place where one of the matrices has an entry.
  WaveResolvent(std::shared_ptr<const WaveStructure> wave, const SparseMatrix& all,
                std::shared_ptr<const LdltPattern> pattern, double h, std::complex<double> p)
      : wave_(std::move(wave)),
        h_(h),
        p_(as(p, Scalar())),
        is_slow_(h * h * frequency_squared(*wave_) <= std::norm(p)),
        ldlt_(std::move(pattern), eliminated(*wave_, all, h, p_).valuePtr()),
        u_(all.rows()),
        v_(all.rows()) {}

  void apply(const Vector& b, Vector& x) const override {
    const Index n = u_.size();
    const Vector& W = wave_->inverse_W;
    v_.setZero();
    add_product(wave_->G, [&](Index i) { return Scalar(h_ * b[i]); });
    for (Index i = 0; i < n; ++i) u_[i] = -(v_[i] + p_ * (W[i] * b[i]) + h_ * b[n + i]);
    ldlt_.solve(u_);
    if (is_slow_) {
      v_ = b.tail(n).template cast<Scalar>();
      add_product(wave_->K, [&](Index i) { return h_ * u_[i]; });
      add_product(wave_->G, [&](Index i) { return b[i] + p_ * u_[i]; });
      v_ /= -p_;
    } else {
      for (Index i = 0; i < n; ++i) v_[i] = W[i] / h_ * (b[i] + p_ * u_[i]);
    }
    for (Index i = 0; i < n; ++i) {
      x[i] = result(u_[i]);
      x[n + i] = result(v_[i]);
    }
  }

 private:
  static constexpr bool is_real = std::is_same_v<Scalar, double>;

  // v_ += A w
  template <class Values>
  void add_product(const SparseMatrix& A, const Values& w) const {
    for (Index j = 0; j < A.outerSize(); ++j) {
      const Scalar w_j = w(j);
      for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) v_[entry.row()] += entry.value() * w_j;
    }
  }

  double result(const Scalar& value) const {
    if constexpr (is_real) {
      return value;
    } else {
      return value.imag() / p_.imag();
    }
  }

  // A bound of ω², the largest eigenvalue of WK.
  static double frequency_squared(const WaveStructure& wave) {
    const SparseMatrix absolute = wave.K.cwiseAbs();
    return (absolute * Vector::Ones(absolute.cols())).cwiseQuotient(wave.inverse_W).maxCoeff();
  }

  static Eigen::SparseMatrix<Scalar> eliminated(const WaveStructure& wave, const SparseMatrix& all, double h,
                                                Scalar p) {
    Eigen::SparseMatrix<Scalar> a = all.cast<Scalar>();
    const auto add = [&a](const SparseMatrix& b, Scalar factor) {
      for (Index j = 0; j < b.outerSize(); ++j) {
        typename Eigen::SparseMatrix<Scalar>::InnerIterator to(a, j);
        for (SparseMatrix::InnerIterator entry(b, j); entry; ++entry) {
          while (to.row() != entry.row()) ++to;
          to.valueRef() += factor * entry.value();
        }
      }
    };
    add(wave.K, Scalar(h * h));
    add(wave.G, p * h);
    add(SparseMatrix(wave.inverse_W.asDiagonal()), p * p);
    return a;
  }

  std::shared_ptr<const WaveStructure> wave_;
  double h_;
  Scalar p_;
  // v from the second row, −(b + hKu + G(a + pu))/p, where hω ≤ |p|: the first would divide round-off by h.
  bool is_slow_;
  SparseLdlt<Scalar> ldlt_;
  mutable Eigen::Matrix<Scalar, Eigen::Dynamic, 1> u_, v_;
};

}  // namespace

std::optional<WaveStructure> wave_structure(const SparseMatrix& S, const SparseMatrix& M) {
  if (S.rows() % 2 != 0) return std::nullopt;
  const Index n = S.rows() / 2;
  const SparseMatrix one = identity_matrix(n);
  if (block(S, 0, 0, n).nonZeros() > 0 || !equal(block(S, 0, n, n), one) ||
      !equal(block(S, n, 0, n), SparseMatrix(-one)) || block(M, 0, n, n).nonZeros() > 0 ||
      block(M, n, 0, n).nonZeros() > 0)
    return std::nullopt;
  const SparseMatrix W = block(M, n, n, n);
  const Vector diagonal = W.diagonal();
  if (W.nonZeros() != n || !(diagonal.array() > 0).all()) return std::nullopt;
  WaveStructure wave{block(M, 0, 0, n), -block(S, n, n, n), diagonal.cwiseInverse()};
  if (!is_symmetric(wave.K) || !is_symmetric(wave.G)) return std::nullopt;
  return wave;
}

struct ResolventFactory::Shared {
  std::shared_ptr<const WaveStructure> wave;  // null: A − p is factorised itself, with …
  SparseMatrix SM;
  std::shared_ptr<const LdltPattern> pattern;  // … of the matrix of u alone, or of A − p where that is symmetric
  SparseMatrix all;

  template <class Scalar>
  std::unique_ptr<Resolvent> make(double h, std::complex<double> p) const {
    if (wave) return std::make_unique<WaveResolvent<Scalar>>(wave, all, pattern, h, p);
    const Eigen::SparseMatrix<Scalar> a = shifted<Scalar>(SM, h, p);
    using Symmetric = DirectResolvent<Scalar, SparseLdlt<Scalar>>;
    using General = DirectResolvent<Scalar, SparseLu<Scalar>>;
    if (pattern) return std::make_unique<Symmetric>(a.rows(), p, SparseLdlt<Scalar>(pattern, a.valuePtr()));
    return std::make_unique<General>(a.rows(), p, SparseLu<Scalar>(a));
  }
};

ResolventFactory::ResolventFactory(const SparseMatrix& S, const SparseMatrix& M) {
  auto shared = std::make_shared<Shared>();
  if (auto wave = wave_structure(S, M)) {
    shared->all = 0 * (wave->K + wave->G + identity_matrix(wave->K.rows()));
    shared->all.makeCompressed();
    shared->pattern = std::make_shared<LdltPattern>(shared->all);
    shared->wave = std::make_shared<WaveStructure>(*std::move(wave));
  } else {
    shared->SM = S * M;
    if (is_symmetric(shared->SM)) shared->pattern = std::make_shared<LdltPattern>(shifted<double>(shared->SM, 1, 1));
  }
  shared_ = std::move(shared);
}

ResolventFactory::~ResolventFactory() = default;

std::unique_ptr<Resolvent> ResolventFactory::make(double h, std::complex<double> pole) const {
  return pole.imag() == 0 ? shared_->make<double>(h, pole) : shared_->make<std::complex<double>>(h, pole);
}

double ResolventFactory::factor_bytes() const {
  constexpr double of_value = sizeof(std::complex<double>);
  if (shared_->pattern) return of_value * static_cast<double>(shared_->pattern->L_row.size());
  // Without pivoting L and U fill as LDLᵀ does on the places of A and Aᵀ together; each value has its row beside it.
  const SparseMatrix A = shared_->SM.cwiseAbs();
  const SparseMatrix places = A + SparseMatrix(A.transpose()) + identity_matrix(A.rows());
  return 2 * (of_value + sizeof(int)) * static_cast<double>(LdltPattern(places).L_row.size());
}

}  // namespace seiche
