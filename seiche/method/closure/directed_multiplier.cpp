#include <seiche/core/base/error.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/method/closure/directed_multiplier.hpp>

#include <cmath>

namespace seiche {

DirectedMultiplier::DirectedMultiplier(const System& system)
    : system_(system),
      start_(system.space->size()),
      equation_(*system.space, *system.potential),
      q_(system.space->size()) {}

StepReport DirectedMultiplier::advance(State& s, MidpointPredictor& predictor, Propagators& propagators, double h,
                                       std::optional<double> energy) {
  predictor.predict(s, propagators.at(h), h, start_.z_mid);
  start_.prepare(*system_.potential, propagators.at(h), s.z);
  return finish(s.z, start_, propagators, h, energy, max_depth);
}

StepReport DirectedMultiplier::advance_half(Vector& z, Propagators& propagators, double h, std::optional<double> energy,
                                            int depth) {
  system_.potential->gradient(z, start_.z_mid);
  propagators.at(h).predict(z, start_.z_mid, start_.z_mid);
  start_.prepare(*system_.potential, propagators.at(h), z);
  return finish(z, start_, propagators, h, energy, depth);
}

//   z⁺ = z₁ + λFd,   d = δ₁ = z₁ − z,   (ḡ(λ) − ĝ − λd)ᵀ(d + λFd) = 0                                   (D1), (D2)
StepReport DirectedMultiplier::finish(Vector& z, const ExplicitStep& start, Propagators& propagators, double h,
                                      std::optional<double> energy, int depth) {
  constexpr int max_iterations = 8;
  StepReport report;
  const Vector& d = start.delta;
  propagators.at(h).force(d, q_);
  equation_.set({.z = z, .z_plus = start.z_plus, .delta = d, .q = q_, .g = start.g, .e = d});
  if (energy) equation_.make_up_for(system_.energy(z) - *energy);
  const MultiplierEquation::Root root =
      equation_.newton(max_iterations, MultiplierEquation::Stop::residual);  // λ: (D2)
  report.scalar_iterations = root.iterations;

  // λd stands in for ḡ − ĝ: a root that asks for much more is another one.
  const Potential::Support support = system_.potential->support();
  const double correction = std::abs(root.x) * system_.space->stable_norm(d.segment(support.begin, support.size));
  const bool near =
      correction <= 4 * equation_.gradient_gap() &&
      (equation_.gradient_gap() <= equation_.mean_gradient_norm() || (root.converged && equation_.gap_is_round_off()));
  if (root.converged && (near || equation_.at(0).is_negligible())) {
    if (keeps_ledger_) report.ledger.scalar = equation_.change(root.x);
    z = start.z_plus + root.x * q_;  // (D1)
    return report;
  }
  if (depth == 0) {
    report.status = StepReport::Status::failed;
    report.message = fmt::format(
        "the directed multiplier was not found in a substep of h = {:.6g} (λ = {}, |λd| = "
        "{:.3g}, |ḡ − ĝ| = {:.3g}, |ḡ| = {:.3g}); a smaller h will do",
        h, number_text(root.x, 3), correction, equation_.gradient_gap(), equation_.mean_gradient_norm());
    return report;
  }
  ++report.fallbacks;
  for (int half = 0; half < 2 && report.solved(); ++half)
    report += advance_half(z, propagators, h / 2, energy, depth - 1);
  return report;
}

namespace {

class DmClosure final : public Closure {
 public:
  DmClosure(const System& system, const MethodOptions& options)
      : Closure(system, options.predictor), multiplier_(system), conserves_(nothing_changes_H()) {}
  void begin(State& s) override {
    Closure::begin(s);
    s.energy = system().energy(s.z);
  }
  StepReport advance(State& s, Propagators& propagators, double /*t*/, double h) override {
    StepReport report =
        multiplier_.advance(s, predictor(), propagators, h, conserves_ ? std::optional(s.energy) : std::nullopt);
    if (report.fallbacks > 0) predictor().discard();  // the last ĝ is that of a part of the step
    return report;
  }
  void keep_ledger() override { multiplier_.keep_ledger(); }

 private:
  Vector& midpoint_gradient() override { return multiplier_.midpoint_gradient(); }

  DirectedMultiplier multiplier_;
  bool conserves_;
};

}  // namespace

std::unique_ptr<Closure> make_dm_closure(const System& system, const MethodOptions& options) {
  return std::make_unique<DmClosure>(system, options);
}

}  // namespace seiche
