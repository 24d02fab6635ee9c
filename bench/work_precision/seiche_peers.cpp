#include <bench/work_precision/seiche_peers.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/loop/adaptive.hpp>
#include <seiche/simulation/simulation.hpp>

#include <algorithm>
#include <cmath>

namespace seiche::bench {
namespace {

struct Variant {
  std::string name, method;
  LinearTreatment linear = LinearTreatment::exact;
  Sweep sweep = Sweep::step_size;
};

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const std::string& name : method_names()) all.push_back({.name = name, .method = name});
  for (const char* method : {"crkn4", "crkn6"})
    all.push_back(
        {.name = fmt::format("{} explicit", method), .method = method, .linear = LinearTreatment::explicit_kicks});
  for (const char* method : {"egc4", "egc6", "egc8", "etdrk4", "crkn4", "crkn6", "auto"})
    all.push_back({.name = fmt::format("{} by tolerance", method), .method = method, .sweep = Sweep::tolerance});
  return all;
}

SimulationOptions options_of(const Variant& variant, double parameter, double t_end) {
  SimulationOptions options{.method = variant.method, .backend_options = {.measure_plans = true}, .duration = t_end};
  options.method_options.linear = variant.linear;
  if (variant.sweep == Sweep::step_size) return options;
  options.variable_steps = true;
  options.tolerance = parameter;
  return options;
}

class SeicheRun : public Run {
 public:
  SeicheRun(const Problem& problem, const Variant& variant, double parameter, double t_end)
      : problem_(problem),
        options_(options_of(variant, parameter, t_end)),
        sweep_(variant.sweep),
        parameter_(parameter),
        simulation_(std::make_unique<Simulation>(problem_, options_)) {
    if (sweep_ == Sweep::tolerance) return;
    simulation_->step(parameter);  // builds the propagators
    restart();
  }

  // Which steps a run by tolerance takes is not known before: what they need is a part of its cost, and nothing is
  // kept.
  void restart() override {
    if (sweep_ == Sweep::tolerance)
      simulation_ = std::make_unique<Simulation>(problem_, options_);
    else
      simulation_->restart();
    gradients_before_ = simulation_->system().potential->counts().gradients;
  }

  std::string advance(double t) override {
    const std::string failure = sweep_ == Sweep::step_size ? take_equal_steps(t) : take_fitting_steps(t);
    if (!failure.empty()) return failure;
    return simulation_->state().z.allFinite() ? "" : "not finite";
  }

  void values(std::span<double> z) const override {
    const Vector physical = simulation_->physical();
    std::copy(physical.begin(), physical.end(), z.begin());
  }

  Work work() const override {
    return {simulation_->state().n, simulation_->system().potential->counts().gradients - gradients_before_};
  }

  std::optional<OwnEnergy> own_energy() const override {
    if (!simulation_->stepper().has_modified_energy()) return std::nullopt;
    const EnergyReading reading = simulation_->energy();
    return OwnEnergy{reading.modified, reading.modified_round_off};
  }

  double energy_round_off() const override { return simulation_->energy().round_off; }

  // The library's own: with the damping in S for `whole` methods.
  void right_hand_side(std::span<const double> z, std::span<double> dz) override {
    const System& system = simulation_->system();
    const Vector values = Eigen::Map<const Vector>(z.data(), static_cast<Index>(z.size()));
    Vector coordinates(system.space->size());
    Vector rate(system.space->size());
    system.space->from_physical(values, coordinates);
    system.right_hand_side(0, coordinates, rate);
    const Vector physical = system.space->physical(rate);
    std::copy(physical.begin(), physical.end(), dz.begin());
  }

 private:
  std::string take_equal_steps(double t) {
    const std::int64_t last = std::llround(t / parameter_);
    while (simulation_->state().n < last) {
      const StepReport report = simulation_->step(parameter_);
      if (!report.solved()) return report.message;
    }
    return "";
  }

  std::string take_fitting_steps(double t) {
    const RunReport report = integrate_adaptive(simulation_->system(), simulation_->adaptive_stepper(),
                                                simulation_->state(), {.tolerance = parameter_, .t_end = t});
    return report.status == RunReport::Status::success ? "" : report.message;
  }

  Problem problem_;
  SimulationOptions options_;
  Sweep sweep_;
  double parameter_;  // h or the tolerance
  std::unique_ptr<Simulation> simulation_;
  std::int64_t gradients_before_ = 0;
};

bool applies(const Problem& problem, const Variant& variant) {
  constexpr double any_tolerance = 1e-6;
  SimulationOptions options = options_of(variant, any_tolerance, 1);
  options.backend_options.measure_plans = false;
  try {
    const Simulation simulation(problem, options);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::vector<std::string> seiche_peer_names() {
  std::vector<std::string> names;
  for (const Variant& variant : variants()) names.push_back(variant.name);
  return names;
}

std::vector<Peer> seiche_peers(const TestProblem& test) {
  std::vector<Peer> peers;
  for (const Variant& variant : variants()) {
    if (!applies(test.problem, variant)) continue;
    peers.push_back(
        {.name = variant.name,
         .library = "Seiche",
         .origin = Origin::seiche,
         .sweep = variant.sweep,
         .applies = any_equation,
         .make = [problem = test.problem, variant](const Equation& equation, double parameter) -> std::unique_ptr<Run> {
           return std::make_unique<SeicheRun>(problem, variant, parameter, equation.t_end);
         }});
  }
  return peers;
}

}  // namespace seiche::bench
