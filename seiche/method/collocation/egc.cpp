#include <seiche/core/generic_state.hpp>
#include <seiche/core/numerics/end_extrapolation.hpp>
#include <seiche/core/numerics/quadrature.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/method/adaptive/error_measure.hpp>
#include <seiche/method/collocation/collocation_weights.hpp>
#include <seiche/method/collocation/continuous_extension.hpp>
#include <seiche/method/collocation/egc.hpp>
#include <seiche/method/collocation/force_sums.hpp>
#include <seiche/method/collocation/sweep_control.hpp>
#include <seiche/method/common/nonlinear_force.hpp>
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
        may_save_sweeps_(stages > 2 && phi_->has_tables()),
        force_(system),
        rule_(stages),
        output_{.forces = stages,
                .order = stages,
                .kind = force_.kind(),
                .weights = [C = interpolation(rule_.nodes)](double theta) { return collocation_weights(C, theta); }},
        dissipation_(system, *phi_, output_, output_, {rule_, GaussRule(stages + 2), NestedRules(stages)}),
        projected_(system, *phi_, *this, law),
        extension_(*phi_, rule_, output_.kind, system.space->size()),
        measure_(system, phi_.get()),
        cache_(cached_step_sizes(system.space->size_of_all())),
        forces_(static_cast<std::size_t>(stages)),
        of_forces_(force_.kind() == PhiRows::Forces::gradients ? system.potential->support()
                                                               : Potential::Support{0, system.space->size()}),
        components_before_(of_forces_.size) {
    const Index size = system.space->size();
    if (dissipation_.follows_energies())
      energies_.resize(forces_.size());
    else if (dissipation_.kind() == StepDissipation::Kind::general)
      samples_.assign(forces_.size(), {Vector::Zero(size), Vector::Zero(size)});
    for (Vector& f : forces_) f.setZero(size);
    missing_.setZero(size);
    missed_.setZero(size);
    physical_.setZero(system.space->physical_size());
    for (Vector* v : {&moment_, &change_, &rate_}) v->setZero(size);
    if (output_.kind == PhiRows::Forces::gradients) {
      moment_ = generic_state(*system.space);
      apply_S(moment_);
      moves_itself_ = space().squared_norm(moment_.segment(of_forces_.begin, of_forces_.size)) > 0;
    }
  }

  void begin(State& s) override {
    projected_.begin(s);
    s.history.assign(forces_.size(), Vector::Zero(s.z.size()));
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
    const double of_linear_flow = measure_(extension_.defect(last_, forces_, s.history));
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
    s.history.swap(forces_);
    s.history_h = last_.history_h;
    projected_.undo(s);
  }

  // The extension is moved by θ^p times what it misses at the end, so that the solution is continuous from step to
  // step.
  void interpolate(const State& s, double t, Vector& z) override {
    const auto extended = [&](double theta, Vector& out) {
      extension_.evaluate(last_, theta, projected_.before(), forces_, s.history, out);
    };
    if (!missing_is_known_) {
      extended(1.0, missing_);
      missing_ = s.z - missing_;
      missing_is_known_ = true;
    }
    const double theta = (t - projected_.last().t) / last_.h;
    extended(theta, z);
    z += std::pow(theta, order()) * missing_;
    projected_.keep_between(s, z);
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
    extension_.moment(last_, forces_, s.history, moment_);
    as_rate(moment_);
    const double moved = space().norm(moment_);
    change_ = s.history.back() - forces_.back();
    as_rate(change_);
    const double steepness = space().norm(change_) / space().norm(s.z - projected_.before());
    constexpr double little = 0.25;
    if (!(little * steepness * moved * measure_.most() > of_linear_flow)) return 0;
    const double t = projected_.last().t + last_.h;
    moment_ += s.z;
    change_ = s.z;
    force_.evaluate(t, moment_);
    force_.evaluate(t, change_);
    moment_ -= change_;
    as_rate(moment_);
    constexpr double with_higher_moments = 2;  // of N′², N′³, …, and the quadrature of N itself: as large together
    return with_higher_moments * measure_(moment_);
  }

  // A force, as PhiRows has it, as Sf; in a gradient flow as φ₁(hL)Sf, by which it changes z in a step, over h.
  void as_rate(Vector& f) {
    if (!measure_.is_of_gradient_flow()) return apply_S(f);
    std::unique_ptr<PhiMap>& of_constant = tables(last_.h, steps_are_alike_).of_constant;
    if (!of_constant) of_constant = phi_->map(rows_of_constant_force(output_.kind), last_.h);
    of_constant->apply(rate_, {&f, 1}, {&rate_, 1});
    f = rate_ / last_.h;
  }

  void apply_S(Vector& f) {
    if (output_.kind == PhiRows::Forces::states) return;
    const Index behind = of_forces_.begin + of_forces_.size;
    f.head(of_forces_.begin).setZero();
    f.tail(f.size() - behind).setZero();
    system_.linear->apply_S(f, rate_);
    f.swap(rate_);
  }

  int stages() const { return static_cast<int>(forces_.size()); }

  // Of the last step: what more sweeps would change, which no polynomial of its forces tells. The last change times the
  // rate at which sweeps converge, calibrated, or something of at most `enough`.
  double unsolved(const State& s, double enough) {
    constexpr double calibration = 1.0 / 16;  // the force at the last node changes most
    change_.setZero();
    change_.segment(of_forces_.begin, of_forces_.size) =
        calibration * last_.h * convergence_ *
        (s.history.back().segment(of_forces_.begin, of_forces_.size) - components_before_);
    as_rate(change_);
    if (measure_.most() * space().norm(change_) <= enough) return enough;  // which bounds the max norm
    return measure_(change_);
  }

  struct Tables {
    std::unique_ptr<PhiMap> nodes;        // forces → Z_i
    std::unique_ptr<PhiMap> end;          // forces → ẑ
    std::unique_ptr<PhiMap> of_constant;  // a force → hφ₁(hL)S of it; when first asked for
  };

  // Steps of one length find all they need after the first of them.
  Tables& tables(double h, bool is_one_of_many) {
    return cache_.at(h, [&] {
      if (is_one_of_many && may_save_sweeps_) extension_.prepare(h);
      auto made = std::make_unique<Tables>();
      const bool all = evaluates_states();
      made->nodes = phi_->map(output_.at(rule_.nodes, all ? PhiRows::Outputs::all : PhiRows::Outputs::support), h);
      made->end = phi_->map(output_.at(Eigen::VectorXd::Ones(1), PhiRows::Outputs::all), h);
      return made;
    });
  }

  // Are all components of Z_i looked at, or those that V depends on?
  bool evaluates_states() const {
    return output_.kind == PhiRows::Forces::states || dissipation_.kind() == StepDissipation::Kind::general;
  }

  // First guess of the forces: those of the last step, extrapolated; or N(zⁿ) throughout. Returns the largest of their
  // norms.
  double predict(const State& s, double t, double h) {
    if (s.history_h == 0) {
      forces_[0] = s.z;
      force_.evaluate(t, forces_[0]);
      for (std::size_t i = 1; i < forces_.size(); ++i) forces_[i] = forces_[0];
      return space().norm(forces_[0].segment(of_forces_.begin, of_forces_.size));
    }
    const double ratio = h / s.history_h;
    const Eigen::MatrixXd& extrapolation = extrapolations_.at(ratio, [&] {
      return std::make_unique<Eigen::MatrixXd>(
          evaluation(rule_.nodes, Eigen::VectorXd::Ones(stages()) + ratio * rule_.nodes));
    });
    return combine(space(), extrapolation, s.history, of_forces_.begin, of_forces_.size, forces_);
  }

  // The collocation equations (E1), F_i = N(Z_i), by sweeps. The force at the last node, which follows from all the
  // others, stands for what a sweep changes.
  void sweep(const State& s, double t, double h, const PhiMap& nodes) {
    SweepControl control(stages(), s.history_h != 0, may_save_sweeps_);
    double change = 0, change_before = 0;
    const auto error = [&] { return space().norm(extension_.defect({h, s.history_h}, s.history, forces_)); };
    do {
      components_before_ = forces_.back().segment(of_forces_.begin, of_forces_.size);
      nodes.apply(s.z, forces_, forces_);  // Z_i: (E1)
      for (Index i = 0; i < stages(); ++i) {
        const double at = t + rule_.nodes[i] * h;
        const auto which = static_cast<std::size_t>(i);
        if (!energies_.empty() && control.may_be_last()) {
          energies_[which].K = system_.linear->quadratic_energy(forces_[which]);
          energies_[which].V = force_.evaluate(at, forces_[which]);
        } else if (!samples_.empty() && control.may_be_last()) {
          force_.evaluate(at, forces_[which], [&](const Vector& node, const Vector& gradient) {
            samples_[which].node = node;
            samples_[which].gradient = gradient;
          });
        } else {
          force_.evaluate(at, forces_[which]);
        }
      }
      change_before = change;
      change = h * distance(space(), forces_.back(), of_forces_.begin, components_before_);
    } while (control.wants_another(change, error));
    convergence_ = change_before > 0 ? std::min(1.0, change / change_before) : 0;  // one sweep tells no rate
  }

  bool compute(const State& s, double t, double h, Vector& z) override {
    const Tables& of_h = tables(h, steps_are_alike_);
    double pushed = predict(s, t, h);
    for (const double c : rule_.nodes) pushed = std::max(pushed, force_.external(t + c * h));
    const double size = space().norm(s.z) + h * pushed;
    sweep(s, t, h, *of_h.nodes);
    coarse_ = {};
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const auto at = static_cast<Index>(i);
      dissipation_.add(t + rule_.nodes[at] * h, samples_[i].node, samples_[i].gradient, h * rule_.weights[at], coarse_);
    }
    of_h.end->apply(s.z, forces_, {&z, 1});  // ẑ: (E2)
    return may_be_solution(space(), z, size);
  }

  std::string_view failure() const override { return "the collocation equations were not solved"; }
  StepDissipation::Kind dissipation_kind() const override { return dissipation_.kind(); }

  StepDissipation::Amount dissipated(const State& s, double t, double h, const Vector& z, double H) override {
    if (dissipation_.follows_energies())
      return dissipation_.measure(t, h, s.z, forces_, dissipation_.energies(s.z, s.energy), dissipation_.energies(z, H),
                                  energies_);
    return dissipation_.measure(t, h, s.z, forces_,
                                dissipation_.kind() == StepDissipation::Kind::general ? &coarse_ : nullptr);
  }

  void prepare_flow(double h) override { dissipation_.prepare_flow(h); }
  double flow_missed(const State& s, double h) override { return dissipation_.flow_missed(h, s, forces_); }

  // The forces before the step are left in forces_.
  void accept(State& s, double h, bool resolved) override {
    last_ = {h, s.history_h};
    missing_is_known_ = false;
    s.history.swap(forces_);
    s.history_h = resolved ? h : 0;
  }

  const Space& space() const { return *system_.space; }

  const System& system_;
  std::unique_ptr<PhiEvaluator> phi_;
  bool may_save_sweeps_;  // by a map that is worth less than a sweep
  NonlinearForce force_;
  GaussRule rule_;
  StepOutput output_;
  StepDissipation dissipation_;
  Projected projected_;
  ContinuousExtension extension_;
  ErrorMeasure measure_;
  StepCache<Tables> cache_;
  StepCache<Eigen::MatrixXd> extrapolations_{16};  // by the ratio of two step sizes
  std::vector<Vector> forces_;
  Potential::Support of_forces_;  // the components that may differ from zero
  Vector components_before_;      // of the last force, a sweep ago
  struct Sample {
    Vector node, gradient;  // Z_i and ∇V(Z_i)
  };
  std::vector<Sample> samples_;                      // where dissipation is evaluated node by node
  StepDissipation::Sum coarse_;                      // of these
  std::vector<StepDissipation::Energies> energies_;  // of Z_i, where dissipation follows from them
  double convergence_ = 1;                           // of the last two sweeps
  bool steps_are_alike_ = true;
  Vector physical_, missed_;
  bool moves_itself_ = true;  // does a force move what it depends on?
  Vector moment_, change_, rate_;
  ContinuousExtension::Step last_;  // the step taken last; the forces of the one before it are left in forces_
  Vector missing_;                  // what the extension misses at the end of it, once it was asked for
  bool missing_is_known_ = false;
};

}  // namespace

std::unique_ptr<AdaptiveStepper> make_egc(const System& system, int stages, EnergyLaw law) {
  return std::make_unique<Collocation>(system, stages, law);
}

}  // namespace seiche
