#include <seiche/core/base/error.hpp>
#include <seiche/method/closure/directed_multiplier.hpp>
#include <seiche/method/closure/lm.hpp>

#include <cmath>

namespace seiche {
namespace {

class LmClosure final : public Closure {
 public:
  LmClosure(const System& system, const MethodOptions& options)
      : Closure(system, options.predictor),
        // Frozen is the printed scheme: the fallbacks of the robust solver measure V elsewhere and would be another
        // one.
        solver_(options.auxiliary == AuxiliaryMode::frozen ? ScalarSolver::newton : options.scalar_solver),
        frozen_(options.auxiliary == AuxiliaryMode::frozen && system.damping->touches_potential()),
        start_(system.space->size()),
        equation_(*system.space, *system.potential),
        directed_(system),
        conserves_(solver_ == ScalarSolver::robust && nothing_changes_H()) {
    if (frozen_ && !system.damping->is_linear())
      throw Error("auxiliary = \"frozen\" is the paper's scheme for a linear damping; with friction use \"transport\"");
    if (frozen_)
      for (Vector* v : {&before_damping_, &end_, &direction_}) v->setZero(system.space->size());
  }

  void begin(State& s) override {
    Closure::begin(s);
    s.energy = system().energy(s.z);
  }
  void damp(State& s, double t, double h) override {
    if (frozen_) before_damping_ = s.z;
    Closure::damp(s, t, h);
  }
  StepReport advance(State& s, Propagators& propagators, double t, double h) override;
  void keep_ledger() override {
    Closure::keep_ledger();
    directed_.keep_ledger();
  }

 private:
  Vector& midpoint_gradient() override { return start_.g; }
  double residual(const Vector& z, double x);
  void set_equation(const Vector& z, double t, double h);
  StepReport solve_robustly(Vector& z, Propagators& propagators, double h, std::optional<double> energy);
  StepReport solve_by_newton(Vector& z, double t);

  ScalarSolver solver_;
  bool frozen_;
  ExplicitStep start_;
  MultiplierEquation equation_;
  DirectedMultiplier directed_;
  bool conserves_;  // and makes up for what round-off has left; Newton's iteration is the paper's
  Vector before_damping_, end_, direction_;  // frozen: zⁿ, Ψ₂z₁, Ψ₂q
};

//   z⁺ = Ez⁻ + ηFĝ,   V(z⁺) − V(z⁻) = ηĝᵀ(z⁺ − z⁻)                                                       (3.6), (4.5)
// solved for x = η − 1, about the explicit step z₁ = Ez⁻ + Fĝ.
StepReport LmClosure::advance(State& s, Propagators& propagators, double t, double h) {
  predictor().predict(s, propagators.at(h), h, start_.z_mid);  // ẑ
  start_.prepare(potential(), propagators.at(h), s.z);         // p − z⁻ = FMz⁻, q = Fĝ: (3.7)
  set_equation(s.z, t, h);                                     // in η: (3.9)
  if (solver_ == ScalarSolver::newton) return solve_by_newton(s.z, t);
  const std::optional<double> energy = conserves_ ? std::optional(s.energy) : std::nullopt;
  if (energy) equation_.make_up_for(system().energy(s.z) - *energy);
  return solve_robustly(s.z, propagators, h, energy);
}

// Frozen, as printed in the paper: V(Ψ₂z⁺) − V(zⁿ) on the left, both ends outside the damping half-flows.
void LmClosure::set_equation(const Vector& z, double t, double h) {
  const MultiplierEquation::Line line{
      .z = z, .z_plus = start_.z_plus, .delta = start_.delta, .q = start_.q, .g = start_.g, .e = start_.g};
  if (!frozen_) {
    equation_.set(line);
    return;
  }
  end_ = start_.z_plus;
  direction_ = start_.q;
  system().damping->flow(t + h / 2, h / 2, end_);
  system().damping->flow(t + h / 2, h / 2, direction_);
  const MultiplierEquation::MeasuredAt measured_at{before_damping_, end_, direction_};
  equation_.set(line, &measured_at);
}

// V(z⁺) − V(z) − ηĝᵀ(z⁺ − z), which the frozen scheme measures elsewhere.
double LmClosure::residual(const Vector& z, double x) {
  if (frozen_)
    equation_.set(
        {.z = z, .z_plus = start_.z_plus, .delta = start_.delta, .q = start_.q, .g = start_.g, .e = start_.g});
  return equation_.change(x);
}

StepReport LmClosure::solve_robustly(Vector& z, Propagators& propagators, double h, std::optional<double> energy) {
  constexpr int max_iterations = 8;
  StepReport report;
  MultiplierEquation::Root root;
  bool accepted = equation_.at(0).is_resolved();  // equilibria: a raw Newton divides 0 by 0
  if (!accepted && std::abs(equation_.cosine()) >= 0.1) {
    root = equation_.newton(max_iterations, MultiplierEquation::Stop::residual_or_update);
    report.scalar_iterations = root.iterations;
    accepted = root.converged && std::abs(root.x) <= 0.5;
  }
  if (accepted) {
    if (keeps_ledger()) report.ledger.scalar = residual(z, root.x);
    z = start_.z_plus + root.x * start_.q;  // z⁺ = p + ηq: (3.8)
    return report;
  }
  ++report.fallbacks;
  report += directed_.finish(z, start_, propagators, h, energy);
  return report;
}

StepReport LmClosure::solve_by_newton(Vector& z, double t) {
  constexpr int max_iterations = 50;
  StepReport report;
  const MultiplierEquation::Root root = equation_.newton(max_iterations, MultiplierEquation::Stop::residual_or_update);
  report.scalar_iterations = root.iterations;
  report.unresolved = root.converged ? 0 : 1;
  if (!std::isfinite(root.x)) {
    report.status = StepReport::Status::failed;
    report.message = fmt::format(
        "Newton's iteration for the multiplier η gave what is not finite at t = {:.6g}; "
        "scalar_solver = \"robust\" will do",
        t);
    return report;
  }
  if (keeps_ledger()) report.ledger.scalar = residual(z, root.x);
  z = start_.z_plus + root.x * start_.q;  // z⁺ = p + ηq: (3.8)
  return report;
}

}  // namespace

std::unique_ptr<Closure> make_lm_closure(const System& system, const MethodOptions& options) {
  return std::make_unique<LmClosure>(system, options);
}

}  // namespace seiche
