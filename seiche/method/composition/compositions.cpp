#include <seiche/core/base/error.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/method/composition/compositions.hpp>

#include <cmath>
#include <optional>
#include <vector>

namespace seiche {
namespace {

class Composed : public Stepper {
 public:
  Composed(const System& system, PropagatorKind propagator, std::unique_ptr<Closure> closure)
      : space_(*system.space),
        propagators_(*system.linear, propagator, cached_step_sizes(system.space->size_of_all())),
        closure_(std::move(closure)) {}

  void begin(State& s) override {
    const double H = closure_->energy(s).H;
    if (!std::isfinite(H))
      throw Error("the energy of the initial state is not a finite number (H = {})", number_text(H));
    closure_->begin(s);
  }
  void restart(State& s) override { closure_->restart(s); }

  StepReport step(State& s, double h) override {
    StepReport report = compose(s, h);
    if (!report.solved()) return report;
    closure_->settle(s);
    closure_->keep(s, h);
    s.t += h;
    ++s.n;
    return report;
  }

  EnergyReading energy(const State& s) const override { return closure_->energy(s); }
  bool has_modified_energy() const override { return closure_->has_modified_energy(); }
  void keep_ledger() override {
    keeps_ledger_ = true;
    closure_->keep_ledger();
  }
  void expect(double error_rate) override { closure_->expect(error_rate); }

 protected:
  // The change of H in a part of the step, where a ledger is kept.
  template <class Part>
  double change(const State& s, const Part& part) {
    if (!keeps_ledger_) {
      part();
      return 0;
    }
    const double before = closure_->energy(s).H;
    part();
    return closure_->energy(s).H - before;
  }

  StepReport substep(State& s, double t, double h) {
    if (!keeps_ledger_) return closure_->advance(s, propagators_, t, h);
    const EnergyReading before = closure_->energy(s);
    StepReport report = closure_->advance(s, propagators_, t, h);
    enter(before, closure_->energy(s), report.ledger);
    return report;
  }

  // Half-flows and substep in one. What the ledger measures is computed beside it: a solution does not depend, to the
  // bit, on what is recorded.
  StepReport fused(State& s, double h, const Closure::HalfFlows& flows) {
    if (!keeps_ledger_) return closure_->advance_damped(s, propagators_, s.t, h, flows);
    const double H = closure_->energy(s).H;
    saved_.start_from(s);
    multiply_fields(flows.before, saved_.z);
    const EnergyReading before = closure_->energy(saved_);
    StepReport report = closure_->advance_damped(s, propagators_, s.t, h, {flows.before, flows.after, &saved_});
    if (!report.solved()) return report;
    const EnergyReading after = closure_->energy(saved_);
    report.ledger.damping_left = before.H - H;
    enter(before, after, report.ledger);
    report.ledger.damping_right = closure_->energy(s).H - after.H;
    return report;
  }

  // On failure s is left as it was.
  virtual StepReport compose(State& s, double h) = 0;

  // The same around parts that may fail with s anywhere between.
  template <class Parts>
  StepReport or_restore(State& s, double h, const Parts& parts) {
    saved_.start_from(s);
    StepReport report = parts();
    if (report.solved() && !space_.is_finite(s.z)) {
      report.status = StepReport::Status::failed;
      report.message =
          fmt::format("the solution is no longer finite in the step from t = {:.6g} with h = {:.6g}", s.t, h);
    }
    if (!report.solved()) {
      std::swap(saved_.midpoints, s.midpoints);  // which no part of a step changes
      s = saved_;
    }
    return report;
  }

  Closure& closure() { return *closure_; }
  Propagators& propagators() { return propagators_; }

 private:
  // The substep, between these two readings.
  static void enter(const EnergyReading& before, const EnergyReading& after, StepLedger& ledger) {
    ledger.substep = (after.modified - before.modified) - ledger.scalar;
    ledger.auxiliary = (after.H - after.modified) - (before.H - before.modified);
  }

  const Space& space_;
  Propagators propagators_;
  std::unique_ptr<Closure> closure_;
  State saved_;
  bool keeps_ledger_ = false;
};

class Whole final : public Composed {
 public:
  using Composed::Composed;

 private:
  StepReport compose(State& s, double h) override {
    if (closure().takes_half_flows()) return fused(s, h, {});
    return or_restore(s, h, [&] { return substep(s, s.t, h); });
  }
};

class Strang final : public Composed {
 public:
  Strang(const System& system, PropagatorKind propagator, std::unique_ptr<Closure> closure)
      : Composed(system, propagator, std::move(closure)),
        damping_(*system.damping),
        has_force_(system.force != nullptr) {
    const auto fields = static_cast<std::size_t>(system.fields);
    before_.resize(fields);
    after_.resize(fields);
  }

 private:
  StepReport compose(State& s, double h) override {
    if (closure().takes_half_flows() && !has_force_ && find_factors(s.t, h)) return fused(s, h, {before_, after_});
    return compose_of_parts(s, h);
  }

  // Apart, so that steps in one pass do not prepare for it.
  [[gnu::noinline]] StepReport compose_of_parts(State& s, double h) {
    const double middle = s.t + h / 2;
    return or_restore(s, h, [&] {
      const std::int64_t corrections = damping_.corrections();
      const double pushed = impulse(s, s.t, h / 2);
      const double left = damp(s, s.t, h / 2);  // z⁻ = Ψ(t, t + h/2)zⁿ: (4.1), (4.4)
      StepReport report = substep(s, s.t, h);   // z⁺: (4.2), (4.5)
      report.ledger.work = pushed;
      report.ledger.damping_left = left;
      if (report.solved()) {
        report.ledger.damping_right = damp(s, middle, h / 2);  // zⁿ⁺¹ = Ψ(t + h/2, t + h)z⁺: (4.3), (4.6)
        report.ledger.work += impulse(s, middle, h / 2);
      }
      report.fallbacks += static_cast<int>(damping_.corrections() - corrections);
      return report;
    });
  }

  // Of the half-flows in a step from t, where there are any: what does not depend on t is asked for once.
  bool find_factors(double t, double h) {
    if (factors_of_ == h) return true;
    factors_of_.reset();
    if (!damping_.field_factors(t, h / 2, before_) || !damping_.field_factors(t + h / 2, h / 2, after_)) return false;
    if (damping_.is_constant()) factors_of_ = h;
    return true;
  }

  double damp(State& s, double t, double h) {
    return change(s, [&] { closure().damp(s, t, h); });
  }
  double impulse(State& s, double t, double h) {
    return has_force_ ? change(s, [&] { closure().impulse(s, t, h); }) : 0.0;
  }

  const Damping& damping_;
  bool has_force_;
  std::vector<double> before_, after_;  // of each field
  std::optional<double> factors_of_;    // the h whose factors these are, at any t
};

}  // namespace

std::unique_ptr<Stepper> make_whole(const System& system, PropagatorKind propagator, std::unique_ptr<Closure> closure) {
  return std::make_unique<Whole>(system, propagator, std::move(closure));
}

std::unique_ptr<Stepper> make_strang(const System& system, PropagatorKind propagator,
                                     std::unique_ptr<Closure> closure) {
  return std::make_unique<Strang>(system, propagator, std::move(closure));
}

}  // namespace seiche
