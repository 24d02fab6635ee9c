#include <seiche/core/base/error.hpp>
#include <seiche/method/projection/energy_projection.hpp>
#include <seiche/method/runge_kutta/exponential_runge_kutta.hpp>
#include <seiche/method/splitting/chin.hpp>
#include <seiche/method/splitting/momentum_form.hpp>

namespace seiche {
namespace {

class Chin final : public BaseStep {
 public:
  Chin(const System& system, const PhiEvaluator& phi)
      : system_(system),
        kind_(StepDissipation::kind_of(system, phi)),
        undamped_(system.make_undamped_phi()),
        hamiltonian_(exponential_runge_kutta(system, *undamped_, krogstad())),
        projection_(system, *undamped_) {
    const MomentumForm form = momentum_form(system);
    if (!form.separable) throw Error("it needs H = T(v) + U(u), with S that couples u and v alone; use etdrk4 or egc4");
    if (!form.rate)
      throw Error(
          "it needs H = vᵀMv/2 + U(u) and a linear damping that is one number on all momenta, the same at all times; use etdrk4 or egc4");
    gamma_ = *form.rate;
    for (Vector* v : {&inner_.z, &end_}) v->setZero(system.space->size());
  }

  bool compute(const State& s, double t, double h, Vector& z) override {
    const double kappa = 1 / (1 + h * h * gamma_ * gamma_ / 72);
    inner_.z = s.z;
    damping_ = 0;
    fallbacks_ = 0;
    moved_far_ = false;
    damp(t, h / 6);
    if (!conserve(t, kappa * h / 2)) return false;
    damp(t, 2 * h / 3);
    if (!conserve(t, kappa * h / 2)) return false;
    damp(t, h / 6);
    z = inner_.z;
    return true;
  }

  std::string_view failure() const override { return "the flow without damping found no point of its energy"; }
  int fallbacks() const override { return fallbacks_; }
  bool moved_far() const override { return moved_far_; }
  StepDissipation::Kind dissipation_kind() const override { return kind_; }
  StepDissipation::Amount dissipated(const State&, double, double, const Vector&, double) override {
    return {.fine = damping_, .negative = kind_ == StepDissipation::Kind::general};
  }

 private:
  void damp(double t, double h) {
    if (kind_ == StepDissipation::Kind::none) return;
    const double before = system_.linear->quadratic_energy(inner_.z);
    system_.damping->flow(t, h, inner_.z);
    damping_ += before - system_.linear->quadratic_energy(inner_.z);
  }

  bool conserve(double t, double h) {
    const double H = system_.energy(inner_.z);
    if (!hamiltonian_->compute(inner_, t, h, end_)) return false;
    projection_.measure(end_);
    const EnergyProjection::Outcome outcome = projection_.project(end_, {H, H});
    fallbacks_ += outcome.by_bisection ? 1 : 0;
    if (!outcome.admissible) return false;
    moved_far_ = moved_far_ || projection_.moved_far(outcome, end_);
    inner_.z.swap(end_);
    return system_.space->is_finite(inner_.z);
  }

  const System& system_;
  StepDissipation::Kind kind_;
  std::unique_ptr<PhiEvaluator> undamped_;  // of SM
  std::unique_ptr<BaseStep> hamiltonian_;
  EnergyProjection projection_;
  double gamma_ = 0, damping_ = 0;
  int fallbacks_ = 0;
  bool moved_far_ = false;
  State inner_;
  Vector end_;
};

}  // namespace

std::unique_ptr<BaseStep> chin_splitting(const System& system, const PhiEvaluator& phi) {
  return std::make_unique<Chin>(system, phi);
}

}  // namespace seiche
