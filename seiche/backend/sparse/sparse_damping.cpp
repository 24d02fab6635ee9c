#include <seiche/backend/sparse/pade.hpp>
#include <seiche/backend/sparse/sparse_damping.hpp>

#include <cmath>

namespace seiche {
namespace {

class SparseMap final : public LinearMap {
 public:
  explicit SparseMap(const SparseMatrix& a) : a_(a) {}
  void apply(const Vector& in, Vector& out) const override { out.noalias() = a_ * in; }

 private:
  SparseMatrix a_;
};

class DiagonalMap final : public LinearMap {
 public:
  explicit DiagonalMap(Vector diagonal) : diagonal_(std::move(diagonal)) {}
  void apply(const Vector& in, Vector& out) const override { out = diagonal_.cwiseProduct(in); }

 private:
  Vector diagonal_;
};

bool is_diagonal(const SparseMatrix& a) {
  bool diagonal = true;
  for_entries(a, [&](Index i, Index j, double value) { diagonal = diagonal && (i == j || value == 0); });
  return diagonal;
}

class MinusIdentity final : public Product {
 public:
  void apply(std::span<const double> x, std::span<double> y) const override {
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = -x[i];
  }
};
const MinusIdentity minus_identity;

// The exponential of hSM with S = −I and M = D.
class DampingExponential final : public LinearMap {
 public:
  DampingExponential(std::shared_ptr<const Product> D, double radius, std::shared_ptr<const Resolvents> resolvents,
                     Index size, double h)
      : D_(std::move(D)),
        resolvents_(std::move(resolvents)),
        force_(minus_identity, *D_, size, *resolvents_, h, plan_pade(std::abs(h) * radius, 1e-15)),
        Dz_(size) {}
  void apply(const Vector& in, Vector& out) const override {
    D_->apply(in, Dz_);
    force_.apply(Dz_, out);
    out += in;
  }

 private:
  std::shared_ptr<const Product> D_;
  std::shared_ptr<const Resolvents> resolvents_;
  PadeForce force_;
  mutable Vector Dz_;
};

}  // namespace

std::unique_ptr<LinearMap> sparse_map(const SparseMatrix& a) { return std::make_unique<SparseMap>(a); }

std::unique_ptr<LinearMap> diagonal_map(Vector diagonal) { return std::make_unique<DiagonalMap>(std::move(diagonal)); }

std::unique_ptr<LinearMap> pade_decay(std::shared_ptr<const Product> D, double radius,
                                      std::shared_ptr<const Resolvents> resolvents, Index size, double h) {
  return std::make_unique<DampingExponential>(std::move(D), radius, std::move(resolvents), size, h);
}

std::function<std::unique_ptr<LinearMap>(double)> sparse_damping_flow(const SparseMatrix& D) {
  if (is_diagonal(D))
    return [diagonal = Vector(D.diagonal())](double h) { return diagonal_map((-h * diagonal.array()).exp().matrix()); };
  return [D_times = std::make_shared<SparseProduct<SparseMatrix>>(D), radius = spectral_radius_bound(D),
          resolvents = std::make_shared<ResolventFactory>(SparseMatrix(-identity_matrix(D.rows())), D),
          size = D.rows()](double h) { return pade_decay(D_times, radius, resolvents, size, h); };
}

}  // namespace seiche
