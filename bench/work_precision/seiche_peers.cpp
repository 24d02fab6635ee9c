#include <bench/work_precision/seiche_peers.hpp>
#include <seiche/config/simulation.hpp>
#include <seiche/core/error.hpp>

#include <algorithm>
#include <cmath>

namespace seiche::bench {
namespace {

SimulationOptions options_of(const std::string& method) {
  return {.method = method, .backend_options = {.measure_plans = true}};
}

class SeicheRun : public Run {
 public:
  SeicheRun(const Problem& problem, const std::string& method, double h)
      : simulation_(problem, options_of(method)), h_(h), has_own_(simulation_.stepper().has_modified_energy()) {
    simulation_.step(h);  // builds the propagators
    restart();
  }

  void restart() override {
    simulation_.restart();
    gradients_before_ = simulation_.system().potential->counts().gradients;
  }

  std::string advance(double t) override {
    const std::int64_t last = std::llround(t / h_);
    while (simulation_.state().n < last) {
      const StepReport report = simulation_.step(h_);
      if (!report.solved()) return report.message;
    }
    return simulation_.state().z.allFinite() ? "" : "not finite";
  }

  void values(std::span<double> z) const override {
    const Vector physical = simulation_.physical();
    std::copy(physical.begin(), physical.end(), z.begin());
  }

  Work work() const override {
    return {simulation_.state().n, simulation_.system().potential->counts().gradients - gradients_before_};
  }

  std::optional<OwnEnergy> own_energy() const override {
    if (!has_own_) return std::nullopt;
    const EnergyReading reading = simulation_.energy();
    return OwnEnergy{reading.modified, reading.modified_round_off};
  }

  // The library's own: with the damping in S for `whole` methods.
  void right_hand_side(std::span<const double> z, std::span<double> dz) override {
    const System& system = simulation_.system();
    const Vector values = Eigen::Map<const Vector>(z.data(), static_cast<Index>(z.size()));
    Vector coordinates(system.space->size());
    Vector rate(system.space->size());
    system.space->from_physical(values, coordinates);
    system.right_hand_side(0, coordinates, rate);
    const Vector physical = system.space->physical(rate);
    std::copy(physical.begin(), physical.end(), dz.begin());
  }

 private:
  Simulation simulation_;
  double h_;
  bool has_own_;
  std::int64_t gradients_before_ = 0;
};

bool method_applies(const Problem& problem, const std::string& method) {
  try {
    const Simulation simulation(problem, {.method = method});
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::vector<Peer> seiche_peers(const TestProblem& test) {
  std::vector<Peer> peers;
  for (const MethodEntry& method : methods()) {
    const std::string name(method.name);
    if (!method_applies(test.problem, name)) continue;
    peers.push_back({.name = name,
                     .library = "Seiche",
                     .origin = Origin::seiche,
                     .sweep = Sweep::step_size,
                     .applies = any_equation,
                     .make = [problem = test.problem, name](const Equation&, double h) -> std::unique_ptr<Run> {
                       return std::make_unique<SeicheRun>(problem, name, h);
                     }});
  }
  return peers;
}

}  // namespace seiche::bench
