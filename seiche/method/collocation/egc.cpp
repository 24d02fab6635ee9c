#include <seiche/core/generic_state.hpp>
#include <seiche/core/numerics/end_extrapolation.hpp>
#include <seiche/core/numerics/quadrature.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/method/adaptive/error_measure.hpp>
#include <seiche/method/collocation/collocation_equations.hpp>
#include <seiche/method/collocation/collocation_weights.hpp>
#include <seiche/method/collocation/continuous_extension.hpp>
#include <seiche/method/collocation/egc.hpp>
#include <seiche/method/projection/projected.hpp>
#include <seiche/method/projection/step_dissipation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

class Collocation final : public AdaptiveStepper, private BaseStep {
 public:
  Collocation(const System& system, int stages, EnergyLaw law)
      : system_(system),
        phi_(system.make_phi()),
        rule_(stages),
        output_{.forces = stages,
                .order = stages,
                .kind = NonlinearForce::kind_of(system),
                .weights = [C = interpolation(rule_.nodes)](double theta) { return collocation_weights(C, theta); }},
        dissipation_(system, *phi_, output_, output_, {rule_, GaussRule(stages + 2), NestedRules(stages)}),
        projected_(system, *phi_, *this, law),
        equations_(system, rule_, kept(), phi_->has_tables()),
        extension_(*phi_, rule_, output_.kind, system.space->size()),
        measure_(system, phi_.get()),
        cache_(cached_step_sizes(system.space->size_of_all())) {
    const Index size = system.space->size();
    missing_.setZero(size);
    missed_.setZero(size);
    physical_.setZero(system.space->physical_size());
    for (Vector* v : {&moment_, &change_, &rate_}) v->setZero(size);
    if (output_.kind == PhiRows::Forces::gradients) {
      moment_ = generic_state(*system.space);
      equations_.apply_S(moment_);
      const Potential::Support part = equations_.of_forces();
      moves_itself_ = space().squared_norm(moment_.segment(part.begin, part.size)) > 0;
    }
  }

  void begin(State& s) override {
    projected_.begin(s);
    s.history.assign(forces().size(), Vector::Zero(s.z.size()));
    s.history_h = 0;
  }

  StepReport step(State& s, double h) override {
    steps_are_alike_ = true;
    return projected_.step(s, h);
  }
  int order() const override { return 2 * stages(); }
  StepReport attempt(State& s, double h) override {
    steps_are_alike_ = false;
    return projected_.attempt(s, h);
  }

  std::optional<double> error(const State& s) override {
    if (last_.history_h == 0) return std::nullopt;
    measure_.start(projected_.before(), s.z, last_.h);
    const double quadrature_error = measure_.most() * this->quadrature_error(s);
    const double of_linear_flow = measure_(extension_.defect(last_, forces(), s.history));
    if (!std::isfinite(of_linear_flow)) return of_linear_flow;
    const double of_polynomial = std::max({of_linear_flow, of_nonlinear_part(s, of_linear_flow), quadrature_error});
    const double of_forces = std::max(of_polynomial, unsolved(s, of_polynomial));
    // Orthonormal coordinates: the Euclidean norm bounds the max norm, and mostly that is enough to know. Where it is
    // not, the move is taken to be as spread out as the solution, which it is parallel to but for Casimirs.
    const double displacement = measure_.most() * (projected_.last().displacement - projected_.last().blur);
    if (displacement <= of_forces) return of_forces;
    system_.space->to_physical(s.z, physical_);
    const double share = space().max_norm(physical_) / space().norm_of_values(physical_);
    return std::max(of_forces, displacement * (std::isfinite(share) ? share : 1.0));
  }

  double quadrature_error(const State& s) override {
    if (system_.damping->is_constant() && !system_.force) return 0;
    const double t = projected_.last().t, h = last_.h;
    missed_.setZero();
    if (system_.force) {
      system_.force->impulse(t, h, missed_);
      for (Index i = 0; i < stages(); ++i) system_.force->add(t + rule_.nodes[i] * h, -h * rule_.weights[i], missed_);
      const EndExtrapolation& ends = end_extrapolation();
      const double width = h * EndExtrapolation::width;
      system_.force->add(t, width, missed_);
      system_.force->add(t + h, width, missed_);
      for (std::size_t i = 0; i < EndExtrapolation::count; ++i)
        system_.force->add(t + ends.points[i] * h, -width * (ends.to_begin[i] + ends.to_end[i]), missed_);
    }
    const auto of_rule = [](const Eigen::VectorXd& v) {
      return std::span(v.data(), static_cast<std::size_t>(v.size()));
    };
    system_.damping->add_quadrature_error(space(), t, h, of_rule(rule_.nodes), of_rule(rule_.weights),
                                          projected_.before(), s.z, missed_);
    system_.space->to_physical(missed_, physical_);
    const double largest = space().max_norm(physical_);
    return std::isfinite(largest) ? largest : std::numeric_limits<double>::infinity();
  }

  void undo(State& s) override {
    s.history.swap(forces());
    s.history_h = last_.history_h;
    projected_.undo(s);
  }

  // The extension is moved by θ^p times what it misses at the end, so that the solution is continuous from step to
  // step.
  void interpolate(const State& s, double t, State& between) override {
    const auto extended = [&](double theta, Vector& out) {
      extension_.evaluate(last_, theta, projected_.before(), forces(), s.history, out);
    };
    if (!missing_is_known_) {
      extended(1.0, missing_);
      missing_ = s.z - missing_;
      missing_is_known_ = true;
    }
    const double theta = (t - projected_.last().t) / last_.h;
    between.start_from(s);
    between.t = t;
    extended(theta, between.z);
    between.z += std::pow(theta, order()) * missing_;
    projected_.keep_between(s, between.z);
  }

  void forget(State& s) override { s.history_h = 0; }

  void restart(State& s) override {
    projected_.restart(s);
    s.history_h = 0;
  }

  EnergyReading energy(const State& s) const override { return projected_.energy(s); }
  bool has_modified_energy() const override { return false; }
  void keep_ledger() override { projected_.keep_ledger(); }

 private:
  // N′m, where m is the first moment of the defect: all there is to the error where L = 0. Two values of N, and only
  // where L has little part in the error; 0 where a force does not move what it depends on.
  double of_nonlinear_part(const State& s, double of_linear_flow) {
    if (!moves_itself_) return 0;
    extension_.moment(last_, forces(), s.history, moment_);
    as_rate(moment_);
    const double moved = space().norm(moment_);
    change_ = s.history.back() - forces().back();
    as_rate(change_);
    const double steepness = space().norm(change_) / space().norm(s.z - projected_.before());
    constexpr double little = 0.25;
    if (!(little * steepness * moved * measure_.most() > of_linear_flow)) return 0;
    const double t = projected_.last().t + last_.h;
    moment_ += s.z;
    change_ = s.z;
    equations_.force_at(t, moment_);
    equations_.force_at(t, change_);
    moment_ -= change_;
    as_rate(moment_);
    constexpr double with_higher_moments = 2;  // of N′², N′³, …, and the quadrature of N itself: as large together
    return with_higher_moments * measure_(moment_);
  }

  // A force, as PhiRows has it, as Sf; in a gradient flow as φ₁(hL)Sf, by which it changes z in a step, over h.
  void as_rate(Vector& f) {
    if (!measure_.is_of_gradient_flow()) return equations_.apply_S(f);
    std::unique_ptr<PhiMap>& of_constant = tables(last_.h, steps_are_alike_).of_constant;
    if (!of_constant) of_constant = phi_->map(rows_of_constant_force(output_.kind), last_.h);
    of_constant->apply(rate_, {&f, 1}, {&rate_, 1});
    f = rate_ / last_.h;
  }

  int stages() const { return static_cast<int>(rule_.nodes.size()); }
  std::vector<Vector>& forces() { return equations_.forces(); }

  // Of the last step: what more sweeps would change, or something of at most `enough`.
  double unsolved(const State& s, double enough) {
    const Vector& left = equations_.unsolved(last_.h, s.history.back());
    return measure_.most() * space().norm(left) <= enough ? enough : measure_(left);  // that bounds the max norm
  }

  CollocationEquations::Kept kept() const {
    using Kept = CollocationEquations::Kept;
    if (dissipation_.follows_energies()) return Kept::energies;
    return dissipation_.kind() == StepDissipation::Kind::general ? Kept::samples : Kept::nothing;
  }

  struct Tables {
    std::unique_ptr<PhiMap> nodes;        // forces → Z_i
    std::unique_ptr<PhiMap> end;          // forces → ẑ
    std::unique_ptr<PhiMap> of_constant;  // a force → hφ₁(hL)S of it; when first asked for
  };

  // Steps of one length find all they need after the first of them.
  Tables& tables(double h, bool is_one_of_many) {
    return cache_.at(h, [&] {
      if (is_one_of_many && equations_.asks_for_errors()) extension_.prepare(h);
      auto made = std::make_unique<Tables>();
      made->nodes = phi_->map(output_.at(rule_.nodes, equations_.outputs()), h);
      made->end = phi_->map(output_.at(Eigen::VectorXd::Ones(1), PhiRows::Outputs::all), h);
      return made;
    });
  }

  bool compute(const State& s, double t, double h, Vector& z) override {
    const Tables& of_h = tables(h, steps_are_alike_);
    double pushed = equations_.predict(s, t, h);
    for (const double c : rule_.nodes) pushed = std::max(pushed, equations_.external(t + c * h));
    const double size = space().norm(s.z) + h * pushed;
    const bool solved = equations_.solve(s, t, h, *of_h.nodes, [&] {
      return space().norm(extension_.defect({h, s.history_h}, s.history, forces()));
    });
    coarse_ = {};
    Index at = 0;
    for (const CollocationEquations::Sample& sample : equations_.samples()) {
      dissipation_.add(t + rule_.nodes[at] * h, sample.node, sample.gradient, h * rule_.weights[at], coarse_);
      ++at;
    }
    of_h.end->apply(s.z, forces(), {&z, 1});  // ẑ: (E2)
    return solved && may_be_solution(space(), z, size);
  }

  std::string_view failure() const override { return "the collocation equations were not solved"; }
  bool may_be_solved_in_parts() const override { return equations_.are_accelerated(); }
  StepDissipation::Kind dissipation_kind() const override { return dissipation_.kind(); }

  StepDissipation::Amount dissipated(const State& s, double t, double h, const Vector& z, double H) override {
    if (dissipation_.follows_energies())
      return dissipation_.measure(t, h, s.z, forces(), dissipation_.energies(s.z, s.energy),
                                  dissipation_.energies(z, H), equations_.energies());
    return dissipation_.measure(t, h, s.z, forces(),
                                dissipation_.kind() == StepDissipation::Kind::general ? &coarse_ : nullptr);
  }

  void prepare_flow(double h) override { dissipation_.prepare_flow(h); }
  double flow_missed(const State& s, double h) override { return dissipation_.flow_missed(h, s, forces()); }

  // The forces before the step are left in forces().
  void accept(State& s, double h, const Taken& taken) override {
    last_ = {h, s.history_h};
    missing_is_known_ = false;
    s.history.swap(forces());
    s.history_h = taken.resolved ? h : 0;
  }

  const Space& space() const { return *system_.space; }

  const System& system_;
  std::unique_ptr<PhiEvaluator> phi_;
  GaussRule rule_;
  StepOutput output_;
  StepDissipation dissipation_;
  Projected projected_;
  CollocationEquations equations_;
  ContinuousExtension extension_;
  ErrorMeasure measure_;
  StepCache<Tables> cache_;
  StepDissipation::Sum coarse_;  // of these
  bool steps_are_alike_ = true;
  Vector physical_, missed_;
  bool moves_itself_ = true;  // does a force move what it depends on?
  Vector moment_, change_, rate_;
  ContinuousExtension::Step last_;  // the step taken last; those before it left its forces in forces()
  Vector missing_;                  // what the extension misses at the end of it, once it was asked for
  bool missing_is_known_ = false;
};

}  // namespace

std::unique_ptr<AdaptiveStepper> make_egc(const System& system, int stages, EnergyLaw law) {
  return std::make_unique<Collocation>(system, stages, law);
}

}  // namespace seiche
