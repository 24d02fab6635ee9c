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

// e^{−hD} as the exponential of hSM with S = −I and M = D.
struct DampingSystem {
  explicit DampingSystem(const SparseMatrix& damping)
      : D(damping), minus_I(-identity_matrix(D.rows())), factory(minus_I, D), radius(spectral_radius_bound(D)) {}
  SparseMatrix D, minus_I;
  SparseProduct<const SparseMatrix&> D_times{D}, minus{minus_I};
  ResolventFactory factory;
  double radius;
};

class DampingExponential final : public LinearMap {
 public:
  DampingExponential(std::shared_ptr<const DampingSystem> system, double h)
      : system_(std::move(system)),
        force_(system_->minus, system_->D_times, system_->D.rows(), system_->factory, h,
               plan_pade(std::abs(h) * system_->radius, 1e-15)),
        Dz_(system_->D.rows()) {}
  void apply(const Vector& in, Vector& out) const override {
    Dz_.noalias() = system_->D * in;
    force_.apply(Dz_, out);
    out += in;
  }

 private:
  std::shared_ptr<const DampingSystem> system_;
  PadeForce force_;
  mutable Vector Dz_;
};

}  // namespace

std::unique_ptr<LinearMap> sparse_map(const SparseMatrix& a) { return std::make_unique<SparseMap>(a); }

std::function<std::unique_ptr<LinearMap>(double)> sparse_damping_flow(const SparseMatrix& D) {
  if (is_diagonal(D)) {
    return [diagonal = Vector(D.diagonal())](double h) {
      return std::make_unique<DiagonalMap>((-h * diagonal.array()).exp().matrix());
    };
  }
  return [system = std::make_shared<const DampingSystem>(D)](double h) {
    return std::make_unique<DampingExponential>(system, h);
  };
}

}  // namespace seiche
