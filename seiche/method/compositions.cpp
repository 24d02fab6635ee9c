#include <seiche/core/error.hpp>
#include <seiche/method/compositions.hpp>

#include <cmath>
#include <vector>

namespace seiche {
namespace {

class Composed : public Stepper {
 public:
  Composed(const System& system, PropagatorKind propagator, std::unique_ptr<Closure> closure)
      : propagators_(*system.linear, propagator), closure_(std::move(closure)) {}

  void begin(State& s) override {
    const double H = closure_->energy(s).H;
    if (!std::isfinite(H)) throw Error("the energy of the initial state is not a finite number (H = {})", H);
    closure_->begin(s);
  }

  StepReport step(State& s, double h) override {
    StepReport report = compose(s, h);
    if (!report.solved()) return report;
    s.t += h;
    ++s.n;
    return report;
  }

  EnergyReading energy(const State& s) const override { return closure_->energy(s); }
  bool has_modified_energy() const override { return closure_->has_modified_energy(); }

 protected:
  // On failure s is left as it was.
  virtual StepReport compose(State& s, double h) = 0;

  // The same around parts that may fail with s anywhere between.
  template <class Parts>
  StepReport or_restore(State& s, double h, const Parts& parts) {
    saved_ = s;
    StepReport report = parts();
    if (report.solved() && !s.z.allFinite()) {
      report.status = StepReport::Status::failed;
      report.message = fmt::format("the solution left the numbers in the step from t = {:.6g} with h = {:.6g}", s.t, h);
    }
    if (!report.solved()) s = saved_;
    return report;
  }

  Closure& closure() { return *closure_; }
  Propagators& propagators() { return propagators_; }

 private:
  Propagators propagators_;
  std::unique_ptr<Closure> closure_;
  State saved_;
};

class Whole final : public Composed {
 public:
  using Composed::Composed;

 private:
  StepReport compose(State& s, double h) override {
    if (closure().takes_half_flows()) return closure().advance_damped(s, propagators(), s.t, h, {});
    return or_restore(s, h, [&] { return closure().advance(s, propagators(), s.t, h); });
  }
};

class Strang final : public Composed {
 public:
  Strang(const System& system, PropagatorKind propagator, std::unique_ptr<Closure> closure)
      : Composed(system, propagator, std::move(closure)), damping_(*system.damping) {
    const auto fields = static_cast<std::size_t>(system.fields);
    before_.resize(fields);
    after_.resize(fields);
  }

 private:
  StepReport compose(State& s, double h) override {
    const double middle = s.t + h / 2;
    if (closure().takes_half_flows() && damping_.field_factors(s.t, h / 2, before_) &&
        damping_.field_factors(middle, h / 2, after_))
      return closure().advance_damped(s, propagators(), s.t, h, {before_, after_});
    return or_restore(s, h, [&] {
      closure().damp(s, s.t, h / 2);
      StepReport report = closure().advance(s, propagators(), s.t, h);
      if (report.solved()) closure().damp(s, middle, h / 2);
      return report;
    });
  }

  const Damping& damping_;
  std::vector<double> before_, after_;  // of each field
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
