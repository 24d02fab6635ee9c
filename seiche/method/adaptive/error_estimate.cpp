#include <seiche/core/base/error.hpp>
#include <seiche/core/control/archive.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/method/adaptive/error_estimate.hpp>
#include <seiche/method/adaptive/error_measure.hpp>
#include <seiche/method/common/nonlinear_force.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace seiche {
namespace {

struct LastStep {
  const State& left;
  const State& right;
};
// A shorter step from `between`, which lies in the last one, to t; where it fails, a point between two states that are
// good.
void step_within(Stepper& stepper, LastStep last, double t, State& between) {
  if (t != between.t && !stepper.step(between, t - between.t).solved()) {
    between = last.right;
    between.z = last.left.z + ((t - last.left.t) / (last.right.t - last.left.t)) * (last.right.z - last.left.z);
  }
  between.t = t;
  between.n = last.right.n;
}

class Estimated final : public AdaptiveStepper {
 public:
  Estimated(const System& system, std::unique_ptr<Stepper> stepper)
      : stepper_(std::move(stepper)),
        phi_(system.make_phi()),
        force_(system),
        measure_(system, phi_.get()),
        cache_(cached_step_sizes(system.space->size_of_all())) {
    const Index size = system.space->size();
    forces_.assign(3, Vector::Zero(size));
    out_.assign(1, Vector::Zero(size));
  }

  void begin(State& s) override {
    stepper_->begin(s);
    end_force_is_known_ = false;
  }
  StepReport step(State& s, double h) override { return stepper_->step(s, h); }
  EnergyReading energy(const State& s) const override { return stepper_->energy(s); }
  bool has_modified_energy() const override { return stepper_->has_modified_energy(); }
  void keep_ledger() override { stepper_->keep_ledger(); }
  void expect(double error_rate) override { stepper_->expect(error_rate); }
  int order() const override { return 2; }

  StepReport attempt(State& s, double h) override {
    before_ = s;
    h_ = h;
    StepReport report = stepper_->step(s, h);
    if (!report.solved()) end_force_is_known_ = false;
    return report;
  }

  std::optional<double> error(const State& s) override {
    const Maps& maps = cache_.at(h_, [this] { return std::make_unique<Maps>(make_maps()); });
    if (end_force_is_known_)
      forces_[0].swap(forces_[2]);
    else
      force(before_.t, before_.z, forces_[0]);
    maps.middle->apply(before_.z, {forces_.data(), 1}, out_);
    force(before_.t + h_ / 2, out_[0], forces_[1]);
    force(s.t, s.z, forces_[2]);
    end_force_is_known_ = true;
    maps.end->apply(before_.z, forces_, out_);
    out_[0] -= s.z;
    measure_.start(before_.z, s.z, h_);
    return measure_(out_[0]);
  }

  void undo(State& s) override {
    s = before_;
    if (end_force_is_known_) forces_[0].swap(forces_[2]);  // that of the left end, which is the end again
  }

  void interpolate(const State& s, double t, State& between) override {
    between = before_;
    step_within(*stepper_, {.left = before_, .right = s}, t, between);
  }

  void forget(State&) override { end_force_is_known_ = false; }
  void restart(State& s) override { begin(s); }
  void archive_memory(Archive& a, const State& s) override {
    a(end_force_is_known_);
    if (a.reads() && end_force_is_known_) force(s.t, s.z, forces_[2]);
  }

 private:
  void force(double t, const Vector& z, Vector& out) {
    out = z;
    force_.evaluate(t, out);
  }

  struct Maps {
    std::unique_ptr<PhiMap> middle, end;
  };
  Maps make_maps() const {
    const PhiRows middle{.rows = {{0.5, {0.5}}}, .forces = 1, .order = 1, .kind = force_.kind()};
    const PhiRows end{.rows = {{1.0, {1, -3, 4, 0, 4, -8, 0, -1, 4}}}, .forces = 3, .order = 3, .kind = force_.kind()};
    return {phi_->map(middle, h_), phi_->map(end, h_)};
  }

  std::unique_ptr<Stepper> stepper_;
  std::unique_ptr<PhiEvaluator> phi_;
  NonlinearForce force_;
  ErrorMeasure measure_;
  StepCache<Maps> cache_;
  State before_;
  double h_ = 0;
  bool end_force_is_known_ = false;  // forces_[2] is N at the state
  std::vector<Vector> forces_, out_;
};

class Doubled final : public AdaptiveStepper {
 public:
  // A step that may fail instead of being taken another way; one of `stepper`.
  using Attempt = std::function<StepReport(State&, double h)>;
  using Blur = std::function<double()>;  // how far round-off in H may have moved what it gave

  Doubled(const System& system, std::unique_ptr<Stepper> stepper, Attempt attempt, Blur blur, int order)
      : stepper_(std::move(stepper)),
        attempt_(std::move(attempt)),
        blur_(std::move(blur)),
        order_(order),
        space_(*system.space),
        phi_(is_gradient_flow(system) ? system.make_phi() : nullptr),
        measure_(system, phi_.get()) {
    difference_.setZero(system.space->size());
    physical_.setZero(system.space->physical_size());
  }

  void begin(State& s) override { stepper_->begin(s); }
  StepReport step(State& s, double h) override { return stepper_->step(s, h); }
  EnergyReading energy(const State& s) const override { return stepper_->energy(s); }
  bool has_modified_energy() const override { return stepper_->has_modified_energy(); }
  void keep_ledger() override { stepper_->keep_ledger(); }
  void expect(double error_rate) override { stepper_->expect(error_rate); }
  int order() const override { return order_; }

  StepReport attempt(State& s, double h) override {
    before_ = whole_ = s;
    h_ = h;
    StepReport report = attempt_(whole_, h);
    if (!report.solved()) return report;
    moved_ = blur_();
    const StepReport first = attempt_(s, h / 2);
    moved_ += blur_();
    middle_ = s;
    const StepReport second = first.solved() ? attempt_(s, h / 2) : StepReport{};
    moved_ += blur_();
    report.ledger = {};
    report += first;
    report += second;
    s.n = before_.n + 1;
    if (!report.solved()) s = before_;
    return report;
  }

  std::optional<double> error(const State& s) override {
    difference_ = whole_.z - s.z;
    measure_.start(before_.z, s.z, h_);
    const double size = measure_(difference_) / (std::exp2(order_) - 1);
    if (moved_ == 0 || !std::isfinite(size)) return size;
    // What round-off in H has moved is no error of the scheme.
    space_.to_physical(difference_, physical_);
    return size * std::max(0.0, 1 - moved_ / space_.max_norm(physical_));
  }

  void undo(State& s) override { s = before_; }

  void interpolate(const State& s, double t, State& between) override {
    between = t <= middle_.t ? before_ : middle_;
    step_within(*stepper_, {.left = before_, .right = s}, t, between);
  }

  void forget(State&) override {}
  void restart(State& s) override { begin(s); }

 private:
  std::unique_ptr<Stepper> stepper_;
  Attempt attempt_;
  Blur blur_;
  int order_;
  const Space& space_;
  std::unique_ptr<PhiEvaluator> phi_;  // of gradient flows
  ErrorMeasure measure_;
  State before_, middle_, whole_;
  double h_ = 0, moved_ = 0;
  Vector difference_, physical_;
};

}  // namespace

std::unique_ptr<AdaptiveStepper> with_error_estimate(const System& system, std::unique_ptr<Stepper> stepper) {
  return std::make_unique<Estimated>(system, std::move(stepper));
}

std::unique_ptr<AdaptiveStepper> with_step_doubling(const System& system, std::unique_ptr<ProjectedStepper> stepper,
                                                    int order) {
  ProjectedStepper& projected = *stepper;
  return std::make_unique<Doubled>(
      system, std::move(stepper), [&projected](State& s, double h) { return projected.attempt(s, h); },
      [&projected] { return projected.blur(); }, order);
}

std::unique_ptr<AdaptiveStepper> with_step_doubling(const System& system, std::unique_ptr<Stepper> stepper, int order) {
  Stepper& plain = *stepper;
  return std::make_unique<Doubled>(
      system, std::move(stepper), [&plain](State& s, double h) { return plain.step(s, h); }, [] { return 0.0; }, order);
}

}  // namespace seiche
