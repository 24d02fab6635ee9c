#include <seiche/core/error.hpp>
#include <seiche/method/compositions.hpp>

#include <cmath>

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
    saved_ = s;
  }

  StepReport step(State& s, double h) override {
    saved_ = s;
    StepReport report = compose(s, h);
    if (report.solved() && !s.z.allFinite()) {
      report.status = StepReport::Status::failed;
      report.message = fmt::format("the solution left the numbers in the step from t = {:.6g} with h = {:.6g}", s.t, h);
    }
    if (report.solved()) {
      s.t += h;
      ++s.n;
    } else {
      s = saved_;
    }
    return report;
  }

  EnergyReading energy(const State& s) const override { return closure_->energy(s); }
  bool has_modified_energy() const override { return closure_->has_modified_energy(); }

 protected:
  virtual StepReport compose(State& s, double h) = 0;
  StepReport advance(State& s, double h) { return closure_->advance(s, propagators_, s.t, h); }
  void damp(State& s, double t, double h) { closure_->damp(s, t, h); }

 private:
  Propagators propagators_;
  std::unique_ptr<Closure> closure_;
  State saved_;
};

class Whole final : public Composed {
 public:
  using Composed::Composed;

 private:
  StepReport compose(State& s, double h) override { return advance(s, h); }
};

class Strang final : public Composed {
 public:
  using Composed::Composed;

 private:
  StepReport compose(State& s, double h) override {
    damp(s, s.t, h / 2);
    StepReport report = advance(s, h);
    if (report.solved()) damp(s, s.t + h / 2, h / 2);
    return report;
  }
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
