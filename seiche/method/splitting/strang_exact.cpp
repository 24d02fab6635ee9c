#include <seiche/core/step_cache.hpp>
#include <seiche/method/common/nonlinear_force.hpp>
#include <seiche/method/splitting/momentum_form.hpp>
#include <seiche/method/splitting/strang_exact.hpp>

namespace seiche {
namespace {

class StrangExact final : public BaseStep {
 public:
  StrangExact(const System& system, const PhiEvaluator& phi)
      : system_(system),
        phi_(phi),
        force_(system, PhiRows::Forces::states),
        kind_(StepDissipation::kind_of(system, phi)),
        is_kick_(system.damping->is_constant() && momentum_form(system).kicks &&
                 !(system.force && system.force->touches_potential())),
        halves_(cached_step_sizes(system.space->size_of_all())) {
    for (Vector* v : {&gradient_, &rate_, &rest_, &middle_, &scratch_}) v->setZero(system.space->size());
  }

  bool compute(const State& s, double t, double h, Vector& z) override {
    const PhiMap& half =
        halves_.at(h, [&] { return phi_.map({.rows = {PhiRow{}}, .outputs = PhiRows::Outputs::all}, h / 2); });
    half.apply(s.z, {}, {&z, 1});
    evaluate(t + h / 2, z);
    const double size = system_.space->norm(s.z) + h * system_.space->norm(rate_);
    if (!is_kick_) {
      middle_ = z + h / 2 * rate_;
      evaluate(t + h / 2, middle_);
    }
    middle_ = z + h * rate_;
    half.apply(middle_, {}, {&z, 1});
    return may_be_solution(*system_.space, z, size);
  }

  std::string_view failure() const override { return "the result of the splitting is not finite"; }
  StepDissipation::Kind dissipation_kind() const override { return kind_; }

  // By the values of Q at both ends, which is all that is known.
  StepDissipation::Amount dissipated(const State& s, double t, double h, const Vector& z, double) override {
    StepDissipation::Sum sum;
    add_end(t, s.z, h / 2, sum);
    add_end(t + h, z, h / 2, sum);
    return {.fine = sum.taken, .work = sum.work, .negative = sum.negative, .gain = sum.gain};
  }

 private:
  // rate_ ← N(z) at time t
  void evaluate(double t, const Vector& z) {
    rate_ = z;
    force_.evaluate(t, rate_);
  }

  void add_end(double t, const Vector& z, double weight, StepDissipation::Sum& sum) {
    system_.potential->gradient(z, gradient_);
    sum.add(weight, system_.dissipation(t, z, gradient_, scratch_, rest_));
  }

  const System& system_;
  const PhiEvaluator& phi_;
  NonlinearForce force_;
  StepDissipation::Kind kind_;
  bool is_kick_;
  StepCache<PhiMap> halves_;  // e^{hL/2}
  Vector gradient_, rate_, rest_, middle_, scratch_;
};

}  // namespace

std::unique_ptr<BaseStep> strang_exact(const System& system, const PhiEvaluator& phi) {
  return std::make_unique<StrangExact>(system, phi);
}

}  // namespace seiche
