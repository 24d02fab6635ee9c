#include <seiche/core/error.hpp>
#include <seiche/core/step_cache.hpp>
#include <seiche/core/tabulated_phi.hpp>
#include <seiche/method/collocation_weights.hpp>
#include <seiche/method/continuous_extension.hpp>
#include <seiche/method/egc.hpp>
#include <seiche/method/energy_interval.hpp>
#include <seiche/method/energy_projection.hpp>
#include <seiche/method/force_sums.hpp>
#include <seiche/method/gauss.hpp>
#include <seiche/method/nonlinear_force.hpp>
#include <seiche/method/step_dissipation.hpp>
#include <seiche/method/sweep_control.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

constexpr int max_halvings = 8;
constexpr double gross_growth = 1e3;  // |ẑ| beyond this many |zⁿ| + h|F|, with F as predicted, is no solution

class Collocation final : public AdaptiveStepper {
 public:
  Collocation(const System& system, int stages)
      : system_(system),
        phi_(system.make_phi()),
        may_save_sweeps_(stages > 2 && dynamic_cast<const TabulatedPhi*>(phi_.get()) != nullptr),
        force_(system),
        rule_(stages),
        output_{.forces = stages,
                .order = stages,
                .kind = force_.kind(),
                .weights = [C = interpolation(rule_.nodes)](double theta) { return collocation_weights(C, theta); }},
        dissipation_(system, *phi_, output_, rule_, GaussRule(stages + 2)),
        projection_(system, *phi_),
        extension_(*phi_, rule_, output_.kind, system.space->size()),
        cache_(cached_step_sizes(system.space->size())),
        forces_(static_cast<std::size_t>(stages)),
        of_forces_(force_.kind() == PhiRows::Forces::gradients ? system.potential->support()
                                                               : Potential::Support{0, system.space->size()}),
        components_before_(of_forces_.size) {
    const Index size = system.space->size();
    if (dissipation_.kind() == StepDissipation::Kind::general)
      seen_.assign(forces_.size(), {Vector::Zero(size), Vector::Zero(size)});
    for (Vector& f : forces_) f.setZero(size);
    result_.assign(1, Vector::Zero(size));
    missing_.setZero(size);
    physical_.setZero(system.space->physical_size());
  }

  void begin(State& s) override {
    s.energy = system_.energy(s.z);
    if (!std::isfinite(s.energy))
      throw Error("the energy of the initial state is not a finite number (H = {})", s.energy);
    s.history.assign(forces_.size(), Vector::Zero(s.z.size()));
    s.history_h = 0;
  }

  StepReport step(State& s, double h) override {
    StepReport report;
    const double t = s.t;
    const std::int64_t n = s.n;
    if (take(s, t, h, false, report) != Taken::whole) {
      saved_ = s;
      if (!take_halves(s, t, h, 1, report)) {
        s = saved_;
        fail(report, s, h, Taken::inadmissible, max_halvings);
        return report;
      }
    }
    s.n = n + 1;
    s.t = t + h;
    return report;
  }

  int order() const override { return 2 * stages(); }

  StepReport attempt(State& s, double h) override {
    StepReport report;
    const Taken taken = take(s, s.t, h, true, report);
    if (taken != Taken::whole) {
      fail(report, s, h, taken, 0);
      return report;
    }
    ++s.n;
    s.t += h;
    return report;
  }

  std::optional<double> error(const State& s) override {
    if (last_.history_h == 0) return std::nullopt;
    system_.space->to_physical(extension_.defect(last_, forces_, s.history), physical_);
    if (!physical_.allFinite()) return std::numeric_limits<double>::infinity();
    const double of_forces = physical_.lpNorm<Eigen::Infinity>();
    // Orthonormal coordinates: the Euclidean norm bounds the max norm, and mostly that is enough to know. Where it is not,
    // the move is taken to be as spread out as the solution, which it is parallel to but for Casimirs.
    if (last_displacement_ <= of_forces) return of_forces;
    system_.space->to_physical(s.z, physical_);
    const double share = physical_.lpNorm<Eigen::Infinity>() / physical_.norm();
    return std::max(of_forces, last_displacement_ * (std::isfinite(share) ? share : 1.0));
  }

  void undo(State& s) override {
    s.z.swap(result_[0]);
    s.history.swap(forces_);
    s.history_h = last_.history_h;
    s.energy = last_energy_;
    s.t = last_t_;
    --s.n;
  }

  // The extension is moved by θ^p times what it misses at the end, so that the solution is continuous from step to step.
  void interpolate(const State& s, double t, Vector& z) override {
    const auto extended = [&](double theta, Vector& out) {
      extension_.evaluate(last_, theta, result_[0], forces_, s.history, out);
    };
    if (!missing_is_known_) {
      extended(1.0, missing_);
      missing_ = s.z - missing_;
      missing_is_known_ = true;
    }
    const double theta = (t - last_t_) / last_.h;
    extended(theta, z);
    z += std::pow(theta, order()) * missing_;
    if (last_dissipated_negative_) return;  // H may rise between: no law to keep
    const double low = std::min(s.energy, last_energy_);
    projection_.project(z, [&](double computed) {
      return EnergyTarget{std::clamp(computed, low, last_energy_), last_energy_};
    });
  }

  void forget(State& s) override { s.history_h = 0; }

  void restart(State& s) override {
    s.energy = system_.energy(s.z);
    s.history_h = 0;
  }

  EnergyReading energy(const State& s) const override {
    EnergyReading reading;
    const EnergyTerms terms = system_.energy_terms(s.z);
    reading.H = reading.modified = terms.sum();
    reading.round_off = reading.modified_round_off = terms.round_off();
    return reading;
  }
  bool has_modified_energy() const override { return false; }
  void keep_ledger() override {}  // every step knows

 private:
  int stages() const { return static_cast<int>(forces_.size()); }

  enum class Taken {
    whole,         // the step was taken
    unresolved,    // not: `strict`, and ẑ is no solution
    inadmissible,  // not: no point near ẑ has an energy that the law allows
  };

  void fail(StepReport& report, const State& s, double h, Taken taken, int halvings) const {
    report.status = StepReport::Status::failed;
    if (taken == Taken::unresolved)
      report.message =
          fmt::format("the collocation equations were not solved in the step from t = {:.6g} with h = {:.6g}", s.t, h);
    else
      report.message = fmt::format(
          "no point near the solution has an energy H ≤ {:.9g} in the step from t = {:.6g} with h = {:.6g}{}: H(0) = {:.6g}",
          s.energy, s.t, h, halvings > 0 ? fmt::format(", nor after {} halvings of it", halvings) : "",
          projection_.energy_of_rest());
  }

  struct Tables {
    std::unique_ptr<PhiMap> nodes;  // forces → Z_i
    std::unique_ptr<PhiMap> end;    // forces → ẑ
    std::unique_ptr<PhiMap> free;   // e^{hL}z, once it was needed
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

  // First guess of the forces: those of the last step, extrapolated; or N(zⁿ) throughout. Returns the largest of their norms.
  double predict(const State& s, double t, double h) {
    if (s.history_h == 0) {
      forces_[0] = s.z;
      force_.evaluate(t, forces_[0]);
      for (std::size_t i = 1; i < forces_.size(); ++i) forces_[i] = forces_[0];
      return forces_[0].segment(of_forces_.begin, of_forces_.size).norm();
    }
    const double ratio = h / s.history_h;
    const Eigen::MatrixXd& extrapolation = extrapolations_.at(ratio, [&] {
      return std::make_unique<Eigen::MatrixXd>(
          evaluation(rule_.nodes, Eigen::VectorXd::Ones(stages()) + ratio * rule_.nodes));
    });
    return combine(extrapolation, s.history, of_forces_.begin, of_forces_.size, forces_);
  }

  // The collocation equations F_i = N(Z_i), by sweeps. The force at the last node, which follows from all the others, stands for
  // what a sweep changes.
  void sweep(const State& s, double t, double h, const PhiMap& nodes) {
    SweepControl control(stages(), s.history_h != 0, may_save_sweeps_);
    double change = 0;
    const auto error = [&] { return extension_.defect({h, s.history_h}, s.history, forces_).norm(); };
    do {
      components_before_ = forces_.back().segment(of_forces_.begin, of_forces_.size);
      nodes.apply(s.z, forces_, forces_);
      for (Index i = 0; i < stages(); ++i) {
        const double at = t + rule_.nodes[i] * h;
        const auto which = static_cast<std::size_t>(i);
        if (!seen_.empty() && control.may_be_last())
          force_.evaluate(at, forces_[which], [&](const Vector& node, const Vector& gradient) {
            seen_[which].node = node;
            seen_[which].gradient = gradient;
          });
        else
          force_.evaluate(at, forces_[which]);
      }
      change = h * distance(forces_.back(), of_forces_.begin, components_before_);
    } while (control.wants_another(change, error));
  }

  // One step; s stays as it was where it is not taken. t and n are the caller's.
  Taken take(State& s, double t, double h, bool strict, StepReport& report) {
    Tables& of_h = tables(h, !strict);
    const double size = s.z.norm() + h * predict(s, t, h);
    const bool general = dissipation_.kind() == StepDissipation::Kind::general;
    sweep(s, t, h, *of_h.nodes);
    StepDissipation::Amount coarse;
    for (Index i = 0; general && i < stages(); ++i) {
      const auto& [node, gradient] = seen_[static_cast<std::size_t>(i)];
      dissipation_.add(t + rule_.nodes[i] * h, node, gradient, h * rule_.weights[i], coarse.coarse, coarse.negative);
    }
    of_h.end->apply(s.z, forces_, result_);
    Vector& z = result_[0];

    const bool resolved = z.norm() <= gross_growth * size;  // false for NaN
    StepDissipation::Amount amount;
    if (resolved) {
      amount = dissipation_.measure(t, h, s.z, forces_, general ? &coarse : nullptr);
    } else {
      if (strict) return Taken::unresolved;
      if (!of_h.free) of_h.free = phi_->map({.rows = {PhiRow{}}, .outputs = PhiRows::Outputs::all}, h);
      of_h.free->apply(s.z, {}, result_);
      ++report.fallbacks;
    }
    const EnergyProjection::Outcome outcome = projection_.project(z, [&](double computed) {
      if (!resolved) return EnergyTarget{s.energy, s.energy};
      return energy_target(s.energy, computed, projection_.energy_of_rest(), amount, dissipation_.kind());
    });
    report.scalar_iterations += outcome.iterations;
    report.fallbacks += outcome.by_bisection ? 1 : 0;
    if (!outcome.admissible || !z.allFinite()) return Taken::inadmissible;
    last_ = {h, s.history_h};
    last_displacement_ = outcome.displacement;
    last_energy_ = s.energy;
    last_t_ = t;
    last_dissipated_negative_ = amount.negative;
    missing_is_known_ = false;
    s.energy = outcome.H;
    report.ledger += {.damping_left = -amount.fine,
                      .substep = outcome.computed - last_energy_ + amount.fine,
                      .projection = outcome.H - outcome.computed};
    s.z.swap(z);
    s.history.swap(forces_);
    s.history_h = resolved ? h : 0;
    return Taken::whole;
  }

  // The same time in two steps, or more where that does not help either.
  bool take_halves(State& s, double t, double h, int depth, StepReport& report) {
    if (depth > max_halvings) return false;
    ++report.fallbacks;
    for (const double begin : {t, t + h / 2}) {
      s.history_h = 0;
      if (take(s, begin, h / 2, false, report) != Taken::whole && !take_halves(s, begin, h / 2, depth + 1, report))
        return false;
    }
    s.history_h = 0;
    return true;
  }

  const System& system_;
  std::unique_ptr<PhiEvaluator> phi_;
  bool may_save_sweeps_;  // by a map that is worth less than a sweep
  NonlinearForce force_;
  GaussRule rule_;
  DenseOutput output_;
  StepDissipation dissipation_;
  EnergyProjection projection_;
  ContinuousExtension extension_;
  StepCache<Tables> cache_;
  StepCache<Eigen::MatrixXd> extrapolations_{16};  // by the ratio of two step sizes
  std::vector<Vector> forces_, result_;
  Potential::Support of_forces_;  // the components that may differ from zero
  Vector components_before_;      // of the last force, a sweep ago
  struct Seen {
    Vector node, gradient;  // Z_i and ∇V(Z_i)
  };
  std::vector<Seen> seen_;  // where dissipation is evaluated node by node
  Vector physical_;
  State saved_;
  // The last step: zⁿ and the forces before it are left in result_ and forces_.
  ContinuousExtension::Step last_;
  double last_displacement_ = 0, last_energy_ = 0, last_t_ = 0;
  bool last_dissipated_negative_ = false;
  Vector missing_;  // what the extension misses at the end of it, once it was asked for
  bool missing_is_known_ = false;
};

}  // namespace

std::unique_ptr<AdaptiveStepper> make_egc(const System& system, int stages) {
  return std::make_unique<Collocation>(system, stages);
}

}  // namespace seiche
