#include <paper/examples.hpp>
#include <paper/scheme.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/problems.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

constexpr std::size_t curve_points = 800;
constexpr const char* plain_newton = "seilm newton";

// 2^{−first}, 2^{−first−1}, …, four of them.
std::vector<double> halved_from(int first) {
  std::vector<double> h;
  for (int j = 0; j < 4; ++j) h.push_back(std::ldexp(1.0, -(first + j)));
  return h;
}

// Schemes that verdicts need beside the paper's eight: the scheme without splitting, and what the paper prints.
std::vector<Contender> studied_beside() {
  using enum AuxiliaryMode;
  using enum ScalarSolver;
  return {{"eavf", scheme("eavf")},
          {"seisav frozen", scheme("seisav", frozen, robust)},
          {plain_newton, scheme("seilm", transport, newton)},
          {"seilm frozen newton", scheme("seilm", frozen, newton)}};
}

bool applies(const Contender& contender, const Problem& problem) {
  try {
    static_cast<void>(Simulation(problem, contender.options));
    return true;
  } catch (const Error&) {
    return false;
  }
}

// How far the paper's reference, SEAVF with its tiny step, lies from ours at the end of a short run.
double seavf_distance(const Problem& problem, double t_end) {
  const std::vector<double> times{0.0, t_end};
  const Reference ours = make_reference(problem, times);
  const Reference paper = make_reference(problem, times, {.kind = ReferenceKind::seavf});
  double distance = 0;
  for (std::size_t i = 0; i < ours.state(1).size(); ++i) {
    distance = std::max(distance, std::abs(ours.state(1)[i] - paper.state(1)[i]));
  }
  return distance;
}

void describe_reference(ExampleEvidence& evidence, const Reference& reference) {
  constexpr double tolerance_of_the_paper = 1e-15;
  evidence.initial_energy = reference.energy(0);
  evidence.initial_potential = reference.potential(0);
  evidence.reference_energy_error = reference.energy_error;
  evidence.max_reference_increase = reference.energy(1) - reference.energy(0);
  std::size_t tiny = 0;
  for (std::size_t k = 1; k < reference.count(); ++k) {
    evidence.max_reference_increase =
        std::max(evidence.max_reference_increase, reference.energy(k) - reference.energy(k - 1));
    if (std::abs(reference.potential(k)) < tolerance_of_the_paper) ++tiny;
  }
  evidence.share_of_tiny_potential = static_cast<double>(tiny) / static_cast<double>(reference.count() - 1);
}

void add_curves(ExampleResult& result, const RunOutcome& outcome) {
  const EnergyRecord& record = outcome.record;
  result.energy.push_back({outcome.row.method, record.t, record.H});
  result.energy_errors.push_back({outcome.row.method, record.t, record.error});
}

}  // namespace

// The paper's eight, and SEILM with the paper's scalar solver, in one series so that their times compare.
void add_times(ExampleStudy& study, const PaperExample& example, const TimingOptions& options) {
  std::vector<Contender> contenders;
  for (const std::string& method : study.result.methods) contenders.push_back({method, scheme(method)});
  std::vector<StudyRow> rows = study.result.rows;
  const std::vector<Contender> beside = studied_beside();
  for (const StudyRow& row : study.evidence.others) {
    if (row.method == plain_newton) rows.push_back(row);
  }
  contenders.push_back(*std::find_if(beside.begin(), beside.end(),
                                     [](const Contender& contender) { return contender.label == plain_newton; }));
  add_timings(rows, example.problem, contenders, example.t_end, options);
  std::size_t i = 0;
  for (StudyRow& row : study.result.rows) row.cpu_seconds = rows[i++].cpu_seconds;
  for (StudyRow& row : study.evidence.others) {
    if (row.method == plain_newton) row.cpu_seconds = rows[i++].cpu_seconds;
  }
}

const std::vector<std::string>& paper_methods() {
  static const std::vector<std::string> names = {"avf", "sav", "savf", "seavf", "ssav", "slm", "seisav", "seilm"};
  return names;
}

std::vector<PaperExample> paper_examples(bool quick) {
  const double t_end = quick ? 10 : 50;
  const auto parameters = [&](const char* own) {
    return fmt::format("{}, N = 20, T = {:g}{}; SAV constant C automatic", own, t_end,
                       quick ? " (quick; the paper: 50)" : "");
  };
  const char* fpu = "k = 1, L = 2, ε = 0.005, β = 0.01, γ = 0.5, m = 1, u(0) with α = 0.1";
  return {
      {"klein_gordon", "Example 1: damped nonlinear Klein–Gordon equation",
       parameters("L = 2, ω² = 0.2, κ = 0.04, α = −1, γ = 0.1"), klein_gordon({.gamma = constant_rate(0.1)}), t_end,
       halved_from(5)},
      {"alpha_fpu_conservative", "Example 2.1: damped α-FPU equation, conservative formulation", parameters(fpu),
       alpha_fpu({.gamma = constant_rate(0.5)}), t_end, halved_from(5)},
      {"alpha_fpu_dissipative", "Example 2.2: damped α-FPU equation, dissipative formulation", parameters(fpu),
       alpha_fpu({.gamma = constant_rate(0.5), .formulation = AlphaFpu::Formulation::dissipative}), t_end,
       halved_from(5)},
      {"gkdv", "Example 3: damped generalised KdV equation", parameters("L = 10, σ = 0.001, ε = 1, k = 2, μ = 0.5"),
       gkdv({.mu = constant_rate(0.5)}), t_end, halved_from(6)},
      {"gkdv_mu01", "Example 3 with μ = 0.1, where the paper finds SEILM fragile",
       parameters("L = 10, σ = 0.001, ε = 1, k = 2, μ = 0.1"), gkdv({.mu = constant_rate(0.1)}), t_end, halved_from(6)},
  };
}

ExampleStudy study_errors(const PaperExample& example, const ExampleOptions& options) {
  ExampleStudy study;
  ExampleResult& result = study.result;
  ExampleEvidence& evidence = study.evidence;
  evidence.key = result.key = example.key;
  result.title = example.title;
  result.equation = find_problem(example.problem.name).equation;
  result.parameters = example.parameters;
  result.t_end = example.t_end;
  result.step_sizes = example.step_sizes;
  result.curve_h = example.step_sizes.front();

  std::vector<Contender> contenders;
  for (const std::string& method : paper_methods()) {
    const Contender contender{method, scheme(method)};
    if (!applies(contender, example.problem)) {
      evidence.refused.push_back(method);
      continue;
    }
    contenders.push_back(contender);
    result.methods.push_back(method);
  }
  std::vector<Contender> all = contenders;
  for (const Contender& contender : studied_beside()) {
    if (applies(contender, example.problem)) all.push_back(contender);
  }

  const Reference reference =
      make_reference(example.problem, sample_times(example.step_sizes, example.t_end), options.reference);
  result.reference_error = reference.error;
  describe_reference(evidence, reference);

  std::vector<RunRequest> requests;
  for (const Contender& contender : all) {
    for (const double h : example.step_sizes) {
      requests.push_back({.problem = &example.problem,
                          .contender = contender,
                          .h = h,
                          .t_end = example.t_end,
                          .record_points = h == result.curve_h ? curve_points : 0});
    }
  }
  const std::vector<RunOutcome> outcomes = measure(requests, reference, options.threads, options.stop);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const bool of_the_paper = i < contenders.size() * example.step_sizes.size();
    (of_the_paper ? result.rows : evidence.others).push_back(outcomes[i].row);
    if (!of_the_paper || requests[i].record_points == 0) continue;
    add_curves(result, outcomes[i]);
    if (outcomes[i].row.method == "seisav") evidence.seisav_modified_gap = outcomes[i].record.max_modified_gap;
  }
  fill_orders(result.rows);
  fill_orders(evidence.others);
  result.reference = described(reference, result.rows);

  Curve exact{"reference", {}, {}};
  const auto longest = std::max_element(result.energy.begin(), result.energy.end(), [](const Curve& a, const Curve& b) {
    return a.t.size() < b.t.size();  // a run that failed left a shorter one
  });
  for (const double t : longest->t) {
    exact.t.push_back(t);
    exact.value.push_back(reference.energy(reference.index_of(t)));
  }
  result.energy.push_back(std::move(exact));

  if (!options.stop || !options.stop->load()) {
    evidence.seavf_reference_end = options.seavf_end;
    evidence.seavf_reference_distance = seavf_distance(example.problem, options.seavf_end);
  }
  return study;
}

}  // namespace seiche
