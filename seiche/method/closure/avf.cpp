#include <seiche/core/base/error.hpp>
#include <seiche/method/closure/avf.hpp>
#include <seiche/method/closure/newton_krylov.hpp>

#include <algorithm>
#include <limits>

namespace seiche {
namespace {

constexpr int max_sweeps = 100;
constexpr double stagnation = 100;  // in units of the tolerance: round-off of F may hold the update above 4ε

class AvfClosure final : public Closure {
 public:
  AvfClosure(const System& system, const MethodOptions& options)
      : Closure(system, options.predictor),
        start_(system.space->size()),
        mean_(Vector::Zero(system.space->size())),
        q_(system.space->size()),
        next_(system.space->size()) {}

  StepReport advance(State& s, Propagators& propagators, double t, double h) override;

 private:
  Vector& midpoint_gradient() override { return start_.g; }
  bool sweep_to_fixed_point(const Vector& z, const Propagator& propagator, StepReport& report);
  // next = z + FMz + Fḡ(z, z⁺); returns the size of the update in units of 4ε(|z⁺| + |Fḡ|) and of noise_.
  double sweep(const Vector& z, const Vector& z_plus, const Propagator& propagator, Vector& next);

  // Looks at what round-off makes of Fḡ at z, where terms of ∇V cancel, and not at an iterate, which may be anywhere;
  // false: nothing, or that is known.
  bool find_noise(const Vector& z, const Propagator& propagator);

  double residual(const Vector& z, const Propagator& propagator);

  ExplicitStep start_;
  Vector mean_, q_, next_;
  double noise_ = 0;
};

double AvfClosure::sweep(const Vector& z, const Vector& z_plus, const Propagator& propagator, Vector& next) {
  potential().mean_gradient(z, z_plus, mean_);  // ḡ = ∫₀¹∇V(z + s(z⁺ − z))ds: (A2)
  propagator.force(mean_, q_);
  next = z + start_.dz + q_;  // z⁺ = z + FMz + Fḡ: (A1)
  const double update = space().max_norm(next - z_plus);
  return update / std::max(4 * epsilon * (space().max_norm(next) + space().max_norm(q_)) + noise_,
                           std::numeric_limits<double>::min());
}

bool AvfClosure::find_noise(const Vector& z, const Propagator& propagator) {
  if (noise_ > 0) return false;
  bound_mean_gradient(potential(), z, mean_);
  propagator.force(mean_, q_);
  noise_ = space().max_norm(q_);
  return noise_ > 0;
}

bool AvfClosure::sweep_to_fixed_point(const Vector& z, const Propagator& propagator, StepReport& report) {
  double previous = std::numeric_limits<double>::infinity();
  for (int i = 0; i < max_sweeps; ++i) {
    const double update = sweep(z, start_.z_plus, propagator, next_);
    start_.z_plus.swap(next_);
    ++report.scalar_iterations;
    // Beside infinite numbers every update is small.
    if (update <= 1 || (update <= stagnation && update >= previous)) return space().is_finite(start_.z_plus);
    if (!(update < 1e3 * previous)) return false;  // diverges, or is not a number
    previous = update >= previous && find_noise(z, propagator) ? std::numeric_limits<double>::infinity() : update;
  }
  return false;
}

// With f = ḡ(z, z⁺) the energy of z' = Ez + Ff changes by the dissipation of S, and that of z⁺ by the work of ∇H on z⁺
// − z' beside it:  (½M(z⁺ + z') + f)ᵀ(z⁺ − z').
double AvfClosure::residual(const Vector& z, const Propagator& propagator) {
  sweep(z, start_.z_plus, propagator, next_);
  q_ = 0.5 * (start_.z_plus + next_);
  system().linear->apply_M(q_, start_.q);
  return space().dot(start_.q + mean_, start_.z_plus - next_);
}

//   z⁺ = Ez + Fḡ,   ḡ = ∫₀¹ ∇V(z + s(z⁺ − z)) ds                                                         (A1), (A2)
StepReport AvfClosure::advance(State& s, Propagators& propagators, double t, double h) {
  StepReport report;
  const Propagator& propagator = propagators.at(h);
  noise_ = 0;
  predictor().predict(s, propagator, h, start_.z_mid);
  start_.prepare(potential(), propagator, s.z);
  if (!sweep_to_fixed_point(s.z, propagator, report)) {
    ++report.fallbacks;
    start_.prepare(potential(), propagator, s.z);
    find_noise(s.z, propagator);
    const auto residual = [&](const Vector& z_plus, Vector& out) {
      const double size = sweep(s.z, z_plus, propagator, out);
      out = z_plus - out;
      return size;
    };
    const NewtonKrylovReport solved = newton_krylov(space(), residual, start_.z_plus, stagnation);
    report.scalar_iterations += solved.iterations;
    if (!solved.converged) {
      report.status = StepReport::Status::failed;
      report.message = fmt::format(
          "the implicit equation of avf was not solved at t = {:.6g} with h = {:.6g}: the update "
          "is still {:.3g} × its tolerance after fixed-point and Newton–Krylov iterations; a "
          "smaller h will do",
          t, h, solved.residual);
      return report;
    }
  }
  if (keeps_ledger()) report.ledger.scalar = residual(s.z, propagator);
  s.z = start_.z_plus;
  return report;
}

}  // namespace

std::unique_ptr<Closure> make_avf_closure(const System& system, const MethodOptions& options) {
  return std::make_unique<AvfClosure>(system, options);
}

}  // namespace seiche
