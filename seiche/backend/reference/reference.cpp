#include <seiche/backend/dense/dense.hpp>
#include <seiche/backend/dense/dense_force.hpp>
#include <seiche/backend/reference/reference.hpp>

namespace seiche {
namespace {

using Matrix = Eigen::MatrixXd;

class ReferencePropagator final : public PlainPropagator {
 public:
  ReferencePropagator(const Space& space, const LinearPart& linear, DenseForce maps, Potential::Support support)
      : PlainPropagator(space, linear), maps_(std::move(maps)), support_(support), f_(Vector::Zero(space.size())) {}

  void increment(const Vector& z, Vector& dz) const override { product(maps_.FM, z, dz); }
  void force(const Vector& f, Vector& q) const override { product(maps_.F, f, q); }
  // ẑ = z⁻ + Q(Mz⁻ + ∇V)
  void predict(const Vector& z, const Vector& gradient, Vector& z_mid, FieldFactors before) const override {
    const auto [begin, size] = support_;
    z_ = z;
    multiply_fields(before, z_);
    f_.segment(begin, size) = gradient.segment(begin, size);
    product(maps_.QM, z_, dz_);
    product(maps_.Q, f_, q_);
    z_mid.segment(begin, size) = (z_ + dz_ + q_).segment(begin, size);
  }

 private:
  void product(const Matrix& a, const Vector& x, Vector& out) const {
    out.noalias() = a * x;
    if (maps_.T.size() == 0) return;  // else `a` leads to coordinates of energy, and T from there
    y_ = out;
    out.noalias() = maps_.T * y_;
  }

  DenseForce maps_;
  Potential::Support support_;
  mutable Vector z_, f_, dz_, q_, y_;
};

class ReferenceLinear final : public LinearPart {
 public:
  ReferenceLinear(const Space& space, Potential::Support support, Matrix S, Matrix M)
      : space_(space), support_(support), S_(std::move(S)), M_(std::move(M)), absolute_M_(M_.cwiseAbs()) {}

  void apply_S(const Vector& z, Vector& out) const override { out.noalias() = S_ * z; }
  bool apply_symmetric_S(const Vector& z, Vector& out) const override {
    if (S_ == -S_.transpose()) return false;
    out.noalias() = 0.5 * (S_ + S_.transpose()) * z;
    return true;
  }
  void apply_M(const Vector& z, Vector& out) const override { out.noalias() = M_ * z; }
  double quadratic_energy(const Vector& z) const override {
    Mz_.noalias() = M_ * z;
    return space_.dot(z, Mz_) / 2;
  }
  double quadratic_magnitude(const Vector& z) const override {
    size_ = z.cwiseAbs();
    Mz_.noalias() = absolute_M_ * size_;
    return space_.dot(size_, Mz_) / 2;
  }
  std::unique_ptr<Propagator> propagator(PropagatorKind kind, double h) const override {
    return std::make_unique<ReferencePropagator>(space_, *this, dense_force(kind, S_, M_, h), support_);
  }

 private:
  const Space& space_;
  Potential::Support support_;
  Matrix S_, M_, absolute_M_;
  mutable Vector size_, Mz_;
};

// The matrix of a map, column by column.
template <class Map>
Matrix matrix_of(Index n, const Map& map) {
  Matrix a(n, n);
  Vector column(n);
  for (Index j = 0; j < n; ++j) {
    map(Vector::Unit(n, j), column);
    a.col(j) = column;
  }
  return a;
}

}  // namespace

System reference_system(const Problem& problem, const BackendOptions& options) {
  System system = dense_system(problem, options);
  const Index n = system.space->size();
  const LinearPart& linear = *system.linear;
  system.linear =
      std::make_unique<ReferenceLinear>(*system.space, system.potential->support(),
                                        matrix_of(n, [&](const Vector& x, Vector& y) { linear.apply_S(x, y); }),
                                        matrix_of(n, [&](const Vector& x, Vector& y) { linear.apply_M(x, y); }));
  return system;
}

}  // namespace seiche
