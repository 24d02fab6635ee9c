#include <seiche/core/simd/add_scaled.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/method/common/nonlinear_force.hpp>
#include <seiche/method/splitting/end_gradient.hpp>
#include <seiche/method/splitting/momentum_form.hpp>
#include <seiche/method/splitting/strang_exact.hpp>

namespace seiche {
namespace {

class StrangExact : public BaseStep {
 public:
  StrangExact(const System& system, const PhiEvaluator& phi)
      : system_(system),
        phi_(phi),
        kind_(StepDissipation::kind_of(system, phi)),
        energies_tell_(StepDissipation::energies_tell(system, phi)),
        end_(system),
        flows_(cached_step_sizes(system.space->size_of_all())) {
    for (Vector* v : {&rest_, &middle_, &scratch_}) v->setZero(system.space->size());
  }

  void remember_nothing(State& s) override { end_.begin(s); }
  std::string_view failure() const override { return "the result of the splitting is not finite"; }
  StepDissipation::Kind dissipation_kind() const override { return kind_; }

  // By the values of Q at both ends, which is all that is known.
  StepDissipation::Amount dissipated(const State& s, double t, double h, const Vector& z, double H) override {
    StepDissipation::Sum sum;
    if (energies_tell_) {
      sum.add(h / 2, StepDissipation::of_energies(system_, t, StepDissipation::energies(system_, s.z, s.energy)));
      sum.add(h / 2, StepDissipation::of_energies(system_, t + h, StepDissipation::energies(system_, z, H)));
    } else {
      sum.add(h / 2, system_.dissipation(t, s.z, end_.at_start(s), scratch_, rest_));
      sum.add(h / 2, system_.dissipation(t + h, z, gradient_at(z), scratch_, rest_));
    }
    return {.fine = sum.taken, .work = sum.work, .negative = sum.negative, .gain = sum.gain};
  }

 protected:
  const System& system() const { return system_; }
  const Space& space() const { return *system_.space; }
  bool asks_for_gradients() const { return kind_ == StepDissipation::Kind::general && !energies_tell_; }
  virtual const Vector& gradient_at(const Vector& z) = 0;  // ∇V(ẑ) of the step just computed
  const PhiMap& flow(double h) {                           // e^{hL}
    return flows_.at(h, [&] { return phi_.map({.rows = {PhiRow{}}, .outputs = PhiRows::Outputs::all}, h); });
  }

  EndGradient& end() { return end_; }
  Vector& middle() { return middle_; }

 private:
  const System& system_;
  const PhiEvaluator& phi_;
  StepDissipation::Kind kind_;
  bool energies_tell_;
  EndGradient end_;
  StepCache<PhiMap> flows_;
  Vector rest_, middle_, scratch_;
};

class KickFlowKick final : public StrangExact {
 public:
  KickFlowKick(const System& system, const PhiEvaluator& phi, EnergyLaw law, const MomentumForm& form)
      : StrangExact(system, phi), kick_(system, form), has_law_(law != EnergyLaw::none) {}

  bool compute(const State& s, double t, double h, Vector& z) override {
    const Vector& first = end().at_start(s);
    const double size = has_law_ ? 0 : space().norm(s.z) + h * kick_.length(first);
    kick(t, h, first, s.z, middle());
    flow(h).apply(middle(), {}, {&z, 1});
    kick(t, h, end().take(z), z, z);
    // Terms of H that have grown beyond reason tell the same of ẑ, and a law asks for them anyway.
    return has_law_ || may_be_solution(space(), z, size);
  }

  const double* potential_energy(const Vector&) override { return &end().V(); }
  void accept(State& s, double h, const Taken& taken) override { end().accept(s, h, taken.factor); }

 private:
  const Vector& gradient_at(const Vector&) override { return end().last(); }

  // One of the two of the step from t.
  void kick(double t, double h, const Vector& gradient, const Vector& before, Vector& after) {
    kick_.apply(h / 2, gradient, before, after);
    if (system().force) system().force->add(t + h / 2, h / 2, after);
  }

  MomentumKick kick_;
  bool has_law_;
};

class FlowForceFlow final : public StrangExact {
 public:
  FlowForceFlow(const System& system, const PhiEvaluator& phi)
      : StrangExact(system, phi),
        force_(system, PhiRows::Forces::states),
        stages_(system.damping->is_constant() ? 4 : 2) {
    const bool is_gradient_alone = stages_ == 4 && !system.force && !system.structure;
    if (is_gradient_alone && system.make_nodal_force) nodal_force_ = system.make_nodal_force();
    const Index size = nodal_force_ ? space().physical_size() : space().size();
    for (Vector* v : {&rate_, &stage_, &sum_}) v->setZero(size);
    if (nodal_force_) values_.setZero(size);
  }

  bool compute(const State& s, double t, double h, Vector& z) override {
    looked_ = false;
    flow(h / 2).apply(s.z, {}, {&z, 1});
    if (nodal_force_) space().to_physical(z, values_);
    const Vector& y = nodal_force_ ? values_ : z;
    evaluate(t + h / 2, y);
    const double size = space().norm(s.z) + h * (nodal_force_ ? space().norm_of_values(rate_) : space().norm(rate_));
    sum_ = y;
    for (int i = 1; i < stages_; ++i) {  // the classical scheme of order four, or the midpoint rule
      const double weight = stages_ == 2 ? 0 : i == 1 ? h / 6 : h / 3;
      if (weight != 0) add(sum_, weight, rate_, sum_);
      add(y, i < 3 ? h / 2 : h, rate_, stage_);
      evaluate(t + h / 2, stage_);
    }
    add(sum_, stages_ == 2 ? h : h / 6, rate_, sum_);
    if (nodal_force_) space().from_physical(sum_, middle());
    flow(h / 2).apply(nodal_force_ ? middle() : sum_, {}, {&z, 1});
    return may_be_solution(space(), z, size);
  }

  // Where `dissipated` asks for the gradient anyway.
  const double* potential_energy(const Vector& z) override {
    if (!asks_for_gradients()) return nullptr;
    gradient_at(z);
    return &end().V();
  }
  void accept(State& s, double h, const Taken& taken) override { end().accept(s, h, looked_ ? taken.factor : 0); }

 private:
  const Vector& gradient_at(const Vector& z) override {
    if (!looked_) end().take(z);
    looked_ = true;
    return end().last();
  }

  static void add(const Vector& x, double a, const Vector& y, Vector& out) {  // out ← x + ay
    add_scaled(x.data(), a, y.data(), x.size(), out.data());
  }

  // rate_ ← N(z) at time t, both in values where N is S∇V and that takes no transform
  void evaluate(double t, const Vector& z) {
    if (nodal_force_) return nodal_force_(z, rate_);
    rate_ = z;
    force_.evaluate(t, rate_);
  }

  NonlinearForce force_;
  int stages_;
  System::NodalForce nodal_force_;
  Vector values_;  // with a nodal force
  Vector rate_, stage_, sum_;
  bool looked_ = false;  // at ∇V(ẑ)
};

}  // namespace

std::unique_ptr<BaseStep> strang_exact(const System& system, const PhiEvaluator& phi, EnergyLaw law) {
  const MomentumForm form = momentum_form(system);
  const bool force_moves_positions = system.force && system.force->touches_potential();
  if (form.kicks && system.damping->is_constant() && !force_moves_positions)
    return std::make_unique<KickFlowKick>(system, phi, law, form);
  return std::make_unique<FlowForceFlow>(system, phi);
}

}  // namespace seiche
