#include <seiche/core/base/error.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/method/projection/flow_quadrature.hpp>
#include <seiche/method/splitting/crkn.hpp>
#include <seiche/method/splitting/end_gradient.hpp>
#include <seiche/method/splitting/momentum_form.hpp>
#include <seiche/method/splitting/nystrom_scheme.hpp>

#include <cmath>
#include <span>
#include <vector>

namespace seiche {
namespace {

class Nystrom : public BaseStep {
 public:
  Nystrom(const System& system, const PhiEvaluator& phi, int order)
      : system_(system),
        form_(momentum_form(system)),
        scheme_(nystrom_scheme(order)),
        kind_(StepDissipation::kind_of(system, phi)) {
    if (!form_.kicks)
      throw Error("it kicks momenta by ∇V of the positions, and here S∇V moves what V depends on; use etdrk4 or egc4");
    if (!system.damping->is_constant())
      throw Error(
          "its linear flow needs a damping that is linear and the same at all times and points; use etdrk4 or egc4");
    if (!phi.dissipation().is_quadratic)
      throw Error("its damping must act on momenta alone, and here it moves what V depends on; use etdrk4 or egc4");
  }

  std::string_view failure() const override { return "the result of the Runge–Kutta–Nyström splitting is not finite"; }
  StepDissipation::Kind dissipation_kind() const override { return kind_; }
  StepDissipation::Amount dissipated(const State&, double, double, const Vector&, double) override {
    return {.fine = taken_, .negative = kind_ == StepDissipation::Kind::general};
  }

 protected:
  const System& system() const { return system_; }
  const Space& space() const { return *system_.space; }
  const MomentumForm& form() const { return form_; }
  const NystromScheme& scheme() const { return scheme_; }
  void set_taken(double by_damping) { taken_ = by_damping; }  // of the step
  bool dissipates() const { return kind_ != StepDissipation::Kind::none; }

 private:
  const System& system_;
  MomentumForm form_;
  const NystromScheme& scheme_;
  StepDissipation::Kind kind_;
  double taken_ = 0;
};

// A kick, a flow, a kick, …, each by the operators of the system: the force of the last kick is that of the next step's
// first one.
class OneByOne : public Nystrom {
 public:
  OneByOne(const System& system, const PhiEvaluator& phi, int order)
      : Nystrom(system, phi, order), end_(system), kick_(system, form()) {}

  bool compute(const State& s, double, double h, Vector& z) override {
    z = s.z;
    prepare(h);
    const Vector& first = force(z, end_.at_start(s));
    const double size = space().norm(s.z) + h * kick_.length(first);
    set_taken(go_through(
        h, first, [&]() -> const Vector& { return force_at(z); }, z));
    return may_be_solution(space(), z, size) || flow_alone(s, h, z);
  }

  void remember_nothing(State& s) override { end_.begin(s); }
  const double* potential_energy(const Vector&) override { return &end_.V(); }
  void accept(State& s, double h, const Taken& taken) override { end_.accept(s, h, taken.factor); }

 protected:
  // The kicks and flows of a step, the first by this force and the others by next(). What damping takes from H in them:
  // of a sum that kicks and flows change, what it loses.
  template <class Next>
  double go_through(double h, const Vector& first, const Next& next, Vector& z) {
    const std::vector<double>& b = scheme().b;
    double sum = account(z);
    sum += kick(b[0] * h, first, z);
    for (std::size_t i = 0; i < scheme().flows(); ++i) {
      sum += flow(i, z);
      sum += kick(b[i + 1] * h, next(), z);
    }
    return sum - account(z);
  }

  virtual void prepare(double h) = 0;
  // A solution that has faded: backward flows of its damping overflow in long steps, and kicks are nothing beside it.
  // Then all flows are one, forward. False where that is not so.
  virtual bool flow_alone(const State& /*s*/, double /*h*/, Vector& /*z*/) { return false; }
  // The i-th A-flow of a step, a kick and an energy of z. What damping takes from H in all flows is what the first two
  // return and what the third falls by.
  virtual double flow(std::size_t i, Vector& z) = 0;
  virtual double kick(double a, const Vector& force, Vector& z) {
    kick_.apply(a, force, z, z);
    return 0;
  }
  virtual double account(const Vector& /*z*/) { return 0; }
  // What z is kicked by, S before it, from ∇V(z); zero outside the positions.
  virtual const Vector& force(const Vector& /*z*/, const Vector& gradient) { return gradient; }

  const Vector& force_at(const Vector& z) { return force(z, end_.take(z)); }
  EndGradient& end() { return end_; }
  MomentumKick& kicker() { return kick_; }

 private:
  EndGradient end_;
  MomentumKick kick_;
};

class ExactFlows final : public OneByOne {
 public:
  ExactFlows(const System& system, const PhiEvaluator& phi, int order)
      : OneByOne(system, phi, order),
        phi_(phi),
        cache_(cached_step_sizes(system.space->size_of_all())),
        work_(Vector::Zero(system.space->size())) {
    if (!dissipates()) return;
    const Eigen::VectorXd start = Eigen::VectorXd::Zero(1);
    exact_ = std::make_unique<FlowQuadrature>(system, phi, PhiRows::Forces::gradients, start, start);
    pushed_ = work_;
  }

  void prepare_flow(double h) override {
    if (exact_) exact_->prepare(h);
  }
  // The same flows under kicks by the force of the start alone, which solve a linear equation: what they take less what
  // that takes.
  double flow_missed(const State& s, double h) override {
    if (!exact_ || exact_->resolves(h)) return 0;
    pushed_ = s.z;
    const Vector& gradient = end().at_start(s);
    const double taken = go_through(
        h, gradient, [&]() -> const Vector& { return gradient; }, pushed_);
    return taken + exact_->miss(h, s.z, gradient, s.energy_terms);  // of a rule of no weight: less all there is
  }

 private:
  using Flows = std::vector<std::unique_ptr<PhiMap>>;

  void prepare(double h) override {
    flows_ = &cache_.at(h, [&] {
      auto flows = std::make_unique<Flows>();
      for (std::size_t i = 0; i < scheme().distinct_flows(); ++i)
        flows->push_back(phi_.map({.rows = {PhiRow{}}, .outputs = PhiRows::Outputs::all}, scheme().a[i] * h));
      return flows;
    });
  }

  double flow(std::size_t i, Vector& z) override {
    (*flows_)[scheme().which(i)]->apply(z, {}, {&work_, 1});
    z.swap(work_);
    return 0;
  }
  // ½zᵀMz changes by kicks and by damping alone.
  double kick(double a, const Vector& gradient, Vector& z) override {
    return dissipates() ? kicker().lift(a, gradient, z) : OneByOne::kick(a, gradient, z);
  }
  double account(const Vector& z) override { return dissipates() ? system().linear->quadratic_energy(z) : 0; }

  // Every stage is a time inside the step, although some flows lead back.
  bool flow_alone(const State& s, double h, Vector& z) override {
    const double nothing = epsilon * space().max_norm(s.z);
    const double before = system().linear->quadratic_energy(s.z);
    double time = 0;
    z = s.z;
    for (std::size_t i = 0; i <= scheme().flows(); ++i) {
      if (!(std::abs(h) * kicker().length(force_at(z)) <= nothing)) return false;
      if (i == scheme().flows()) break;
      time = i + 1 < scheme().flows() ? time + scheme().a[i] : 1;
      phi_.map({.rows = {PhiRow{}}, .outputs = PhiRows::Outputs::all}, time * h)->apply(s.z, {}, {&work_, 1});
      z = work_;
      if (!space().is_finite(z)) return false;
    }
    set_taken(dissipates() ? before - system().linear->quadratic_energy(z) : 0);
    return true;
  }

  const PhiEvaluator& phi_;
  StepCache<Flows> cache_;
  const Flows* flows_ = nullptr;
  Vector work_, pushed_;
  std::unique_ptr<FlowQuadrature> exact_;  // null: nothing dissipates
};

constexpr std::string_view remedy_of_kicks = "a smaller h, or linear = \"exact\"";

// The kicks by all forces and the drifts u += length · ∇T(v), v *= decay of a step without exponentials.
class ExplicitStages {
 public:
  ExplicitStages(const MomentumForm& form, const NystromScheme& scheme) : scheme_(scheme) {
    if (!form.separable)
      throw Error(
          "linear = \"explicit\" needs H = T(v) + U(u), with S that couples u and v alone; use linear = \"exact\"");
    if (!form.rate)
      throw Error("linear = \"explicit\" needs a damping that is one number on all momenta; use linear = \"exact\"");
    gamma_ = *form.rate;
  }

  // All but the last kick. Made anew where h is another than before.
  const std::vector<Kicks::KickAndDrift>& at(double h) {
    if (h == h_) return stages_;
    h_ = h;
    stages_.clear();
    for (std::size_t i = 0; i < scheme_.flows(); ++i) {
      const double t = scheme_.a[i] * h;
      const double length = gamma_ == 0 ? t : -std::expm1(-gamma_ * t) / gamma_;
      stages_.push_back({scheme_.b[i] * h, length, std::exp(-gamma_ * t)});
    }
    return stages_;
  }

 private:
  const NystromScheme& scheme_;
  double gamma_ = 0, h_ = 0;
  std::vector<Kicks::KickAndDrift> stages_;
};

class Drifts final : public OneByOne {
 public:
  Drifts(const System& system, const PhiEvaluator& phi, int order)
      : OneByOne(system, phi, order), stages_(form(), scheme()) {
    for (Vector* v : {&Mz_, &momenta_, &force_, &drift_}) v->setZero(system.space->size());
  }

  std::string_view remedy() const override { return remedy_of_kicks; }

 private:
  void prepare(double h) override { of_h_ = stages_.at(h); }

  double flow(std::size_t i, Vector& z) override {
    const double length = of_h_[i].length;
    const double decay = of_h_[i].decay;
    const Potential::Support u = form().positions;
    if (form().canonical) {
      const double twice_T = dissipates() ? space().squared_norm(z.tail(u.size)) : 0;
      z.head(u.size) += length * z.tail(u.size);
      z.tail(u.size) *= decay;
      return twice_T * (1 - decay * decay) / 2;
    }
    momenta_ = z;
    momenta_.segment(u.begin, u.size).setZero();
    system().linear->apply_M(momenta_, Mz_);
    const double twice_T = space().dot(momenta_, Mz_);
    system().linear->apply_S(Mz_, drift_);
    z += (decay - 1) * momenta_ + length * drift_;
    return twice_T * (1 - decay * decay) / 2;
  }

  const Vector& force(const Vector& z, const Vector& gradient) override {
    const Potential::Support u = form().positions;
    system().linear->apply_M(z, Mz_);
    force_.segment(u.begin, u.size) = gradient.segment(u.begin, u.size) + Mz_.segment(u.begin, u.size);
    return force_;
  }

  ExplicitStages stages_;
  std::span<const Kicks::KickAndDrift> of_h_;
  Vector Mz_, momenta_, force_, drift_;
};

// The same where the backend has kicks of its own.
class FewPasses final : public Nystrom {
 public:
  FewPasses(const System& system, const PhiEvaluator& phi, int order)
      : Nystrom(system, phi, order), stages_(form(), scheme()), kicks_(system.make_kicks()) {}

  std::string_view remedy() const override { return remedy_of_kicks; }

  bool compute(const State& s, double, double h, Vector& z) override {
    const std::vector<double>& b = scheme().b;
    const Kicks::Report report = kicks_->split(stages_.at(h), b.back() * h, s.z, z);
    set_taken(space().sum(report.taken));
    // |p| and |p − b₀hF| bound b₀h|F|. That is looser than |zⁿ| + h|F|, and costs no pass of its own.
    const double before = std::sqrt(space().squared_norm(s.z));
    return may_be_solution(space(), z, before + (before + std::sqrt(space().sum(report.kicked))) / std::abs(b[0]));
  }

 private:
  ExplicitStages stages_;
  std::unique_ptr<Kicks> kicks_;
};

}  // namespace

std::unique_ptr<BaseStep> conformal_nystrom(const System& system, const PhiEvaluator& phi, int order) {
  return std::make_unique<ExactFlows>(system, phi, order);
}

std::unique_ptr<BaseStep> explicit_nystrom(const System& system, const PhiEvaluator& phi, int order) {
  if (system.make_kicks) return std::make_unique<FewPasses>(system, phi, order);
  return std::make_unique<Drifts>(system, phi, order);
}

}  // namespace seiche
