#include <paper/law_checks.hpp>
#include <paper/scheme.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/klein_gordon.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

class DriftObserver final : public Observer {
 public:
  bool is_due(const State&, bool) const override { return true; }
  void observe(const State& state, const EnergyReading& energy) override {
    if (state.n == 0) first_ = energy.modified;
    drift_ = std::max(drift_, std::abs(energy.modified - first_));
  }
  void finish(const RunReport&) override {}
  double relative() const { return first_ == 0 ? drift_ : drift_ / std::abs(first_); }

 private:
  double first_ = 0, drift_ = 0;
};

void add_run(LawCheck& check, const Problem& problem, const SimulationOptions& options, double h, double t_end) {
  Simulation simulation(problem, options);
  DriftObserver observer;
  Observer* const observers[] = {&observer};
  const RunReport report = integrate(simulation.system(), simulation.stepper(), simulation.state(),
                                     {.h = h, .t_end = t_end, .law = {true, "judged in any case"}}, observers);
  ++check.runs;
  check.steps += report.steps;
  check.unresolved += report.unresolved;
  if (report.status != RunReport::Status::success && report.law != LawVerdict::violated) ++check.failed;
  if (report.status == RunReport::Status::success && report.law == LawVerdict::holds) ++check.held;
  const EnergySummary& energy = report.has_modified_energy ? report.modified : report.energy;
  const double scale = energy.initial == 0 ? 1 : std::abs(energy.initial);
  check.largest_rise = std::max(check.largest_rise, energy.max_increase / scale);
  check.largest_drift = std::max(check.largest_drift, observer.relative());
}

LawCheck over_examples(const char* name, const SimulationOptions& options, const std::vector<PaperExample>& examples,
                       int steps) {
  LawCheck check{.scheme = name};
  for (const PaperExample& example : examples) {
    for (const double h : {1.0 / 64, 1.0 / 8, 1.0, 3.0, 10.0}) add_run(check, example.problem, options, h, steps * h);
  }
  return check;
}

struct Named {
  const char* name;
  Problem problem;
  double t_end;
};

std::vector<LawCheck> over_undamped(const std::vector<Named>& problems) {
  std::vector<LawCheck> checks;
  for (const char* method : {"eisav", "eilm", "lm", "avf"}) {
    for (const Named& named : problems) {
      LawCheck check{.scheme = fmt::format("{} on {}", method, named.name)};
      for (const double h : {1.0 / 64, 1.0 / 16}) add_run(check, named.problem, scheme(method), h, named.t_end);
      checks.push_back(std::move(check));
    }
  }
  return checks;
}

// A state close to a constant: ½zᵀMz is small against |V|, V < 0, and the damping lifts H towards 0.
Problem gkdv_near_constant() {
  Problem problem = gkdv({.sigma = 1.0, .mu = constant_rate(0.5)});
  problem.initial.array() += 1.0;
  return problem;
}

void check_without_ecld(Evidence& evidence) {
  const Problem problem = gkdv_near_constant();
  const double h = 1.0 / 64;
  const double t_end = 4;
  const Reference reference = make_reference(problem, sample_times(std::vector<double>{h}, t_end));
  for (std::size_t k = 0; k < reference.count(); ++k) {
    evidence.without_ecld_exact_rise =
        std::max(evidence.without_ecld_exact_rise,
                 (reference.energy(k) - reference.energy(0)) / std::abs(reference.energy(0)));
  }
  std::vector<RunRequest> requests;
  using enum AuxiliaryMode;
  const std::vector<Contender> contenders = {{"seilm", scheme("seilm", transport)},
                                             {"seisav", scheme("seisav", transport)},
                                             {"seilm frozen newton", scheme("seilm", frozen, ScalarSolver::newton)},
                                             {"seisav frozen", scheme("seisav", frozen)}};
  for (const Contender& contender : contenders) {
    requests.push_back({.problem = &problem, .contender = contender, .h = h, .t_end = t_end, .record_points = 0});
  }
  for (RunOutcome& outcome : measure(requests, reference, 1)) evidence.without_ecld.push_back(std::move(outcome.row));
}

}  // namespace

void check_laws(Evidence& evidence, const std::vector<PaperExample>& examples, bool quick) {
  const int steps = quick ? 64 : 256;
  using enum AuxiliaryMode;
  evidence.seisav_laws = {over_examples("r² transported", scheme("seisav", transport), examples, steps),
                          over_examples("as printed (r frozen)", scheme("seisav", frozen), examples, steps)};
  evidence.seilm_laws = {over_examples("V transported, robust solve", scheme("seilm", transport), examples, steps),
                         over_examples("as printed (V frozen, Newton)", scheme("seilm", frozen, ScalarSolver::newton),
                                       examples, steps)};

  // Without damping, focusing Klein–Gordon blows up at t ≈ 12.7.
  const RatePointer none;
  evidence.conserved = over_undamped({{"Klein–Gordon", klein_gordon({.gamma = none}), 5.0},
                                      {"α-FPU", alpha_fpu({.beta = 0.0, .gamma = none}), 10.0},
                                      {"gKdV", gkdv({.mu = none}), 10.0}});
  evidence.dissipated = over_undamped(
      {{"α-FPU with γ in S",
        alpha_fpu({.beta = 0.0, .gamma = constant_rate(0.5), .formulation = AlphaFpu::Formulation::dissipative}),
        10.0}});
  check_without_ecld(evidence);
}

}  // namespace seiche
