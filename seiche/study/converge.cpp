#include <seiche/core/base/error.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/study/converge.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <future>
#include <iterator>
#include <mutex>

namespace seiche {
namespace {

class ErrorObserver final : public Observer {
 public:
  ErrorObserver(const Space& space, const Reference& reference, const RunRequest& request, RunOutcome& outcome)
      : space_(space), reference_(reference), values_(space.physical_size()), outcome_(outcome) {
    const double steps = request.t_end / request.h;
    stride_ = request.record_points == 0
                  ? 0
                  : static_cast<std::int64_t>(std::ceil(steps / static_cast<double>(request.record_points)));
  }

  bool is_due(const State&, bool) const override { return true; }

  void observe(const State& state, const EnergyReading& energy) override {
    const std::size_t k = reference_.index_of(state.t);
    space_.to_physical(state.z, values_);
    const std::span<const double> exact = reference_.state(k);
    StudyRow& row = outcome_.row;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      row.error = std::max(row.error, std::abs(values_[static_cast<Index>(i)] - exact[i]));
    }
    const double energy_error = std::abs(energy.H - reference_.energy(k));
    row.energy_error = std::max(row.energy_error, energy_error);

    EnergyRecord& record = outcome_.record;
    record.max_modified_gap = std::max(record.max_modified_gap, std::abs(energy.modified - energy.H));
    if (stride_ == 0 || (state.n % stride_ != 0 && k + 1 != reference_.count())) return;
    record.t.push_back(state.t);
    record.H.push_back(energy.H);
    record.error.push_back(energy_error);
  }

  void finish(const RunReport&) override {}

 private:
  const Space& space_;
  const Reference& reference_;
  Vector values_;
  std::int64_t stride_ = 0;
  RunOutcome& outcome_;
};

RunOutcome run_one(Simulation& simulation, const RunRequest& request, const Reference& reference,
                   const std::atomic<bool>* stop) {
  RunOutcome outcome;
  StudyRow& row = outcome.row;
  row.method = request.contender.label;
  row.h = request.h;
  ErrorObserver observer(*simulation.system().space, reference, request, outcome);
  Observer* const observers[] = {&observer};
  // Promised here, so that the law is judged also where no theorem covers the problem.
  const IntegrateOptions options{.h = request.h,
                                 .t_end = request.t_end,
                                 .law = {true, "judged in any case"},
                                 .stop = stop};
  const RunReport report = integrate(simulation.system(), simulation.stepper(), simulation.state(), options, observers);
  row.max_energy_increase = report.energy.max_increase;
  row.max_modified_increase = report.has_modified_energy ? report.modified.max_increase : report.energy.max_increase;
  row.steps = report.steps;
  row.scalar_iterations = report.scalar_iterations;
  row.fallbacks = report.fallbacks;
  row.replaced = report.replaced.count;
  row.unresolved = report.unresolved;
  row.energy_law_held = report.law == LawVerdict::holds;
  if (report.status != RunReport::Status::success) row.failure = report.message;
  return outcome;
}

}  // namespace

MethodOptions options_for(std::string_view method, const MethodOptions& options) {
  return options.meant_for(find_method(method));
}

void in_threads(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  const auto share = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::future<void>> others;
  for (int i = 1; i < threads; ++i) others.push_back(std::async(std::launch::async, share));
  share();
  for (std::future<void>& other : others) other.get();
}

std::vector<RunOutcome> measure(const std::vector<RunRequest>& requests, const Reference& reference, int threads,
                                const std::atomic<bool>* stop) {
  std::vector<RunOutcome> outcomes(requests.size());
  std::mutex setting_up;  // FFTW makes and destroys plans in one thread at a time
  in_threads(requests.size(), threads, [&](std::size_t i) {
    std::unique_ptr<Simulation> simulation;
    {
      const std::lock_guard lock(setting_up);
      simulation = std::make_unique<Simulation>(*requests[i].problem, requests[i].contender.options);
    }
    outcomes[i] = run_one(*simulation, requests[i], reference, stop);
    const std::lock_guard lock(setting_up);
    simulation.reset();
  });
  return outcomes;
}

void fill_orders(std::vector<StudyRow>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    StudyRow& row = rows[i];
    row.order.reset();
    if (i == 0 || rows[i - 1].method != row.method || !rows[i - 1].failure.empty() || !row.failure.empty()) continue;
    const StudyRow& larger = rows[i - 1];
    if (larger.h > row.h && larger.error > 0 && row.error > 0) {
      row.order = std::log(larger.error / row.error) / std::log(larger.h / row.h);
    }
  }
}

void add_timings(std::vector<StudyRow>& rows, const Problem& problem, const std::vector<Contender>& contenders,
                 double t_end, const TimingOptions& options) {
  std::vector<std::unique_ptr<Simulation>> simulations;
  for (const Contender& contender : contenders) {
    simulations.push_back(std::make_unique<Simulation>(problem, contender.options));
  }
  const std::size_t sizes = rows.size() / contenders.size();
  for (std::size_t j = 0; j < sizes; ++j) {
    std::vector<Simulation*> runners;
    std::vector<StudyRow*> timed;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      StudyRow& row = rows[i * sizes + j];
      if (!row.failure.empty()) continue;
      runners.push_back(simulations[i].get());
      timed.push_back(&row);
    }
    if (timed.empty()) continue;
    const std::vector<double> seconds = time_runs(runners, timed.front()->h, t_end, options);
    for (std::size_t i = 0; i < timed.size(); ++i) timed[i]->cpu_seconds = seconds[i];
  }
}

std::string described(const Reference& reference, const std::vector<StudyRow>& rows) {
  constexpr double share = 0.01;  // of the smallest error, which the reference may be wrong by
  const StudyRow* smallest = nullptr;
  for (const StudyRow& row : rows) {
    if (row.failure.empty() && (!smallest || row.error < smallest->error)) smallest = &row;
  }
  if (!smallest || reference.error <= share * smallest->error) return reference.description;
  return fmt::format("{}; errors below {:.1e} are not resolved", reference.description, reference.error / share);
}

Convergence converge(const Problem& problem, const std::vector<std::string>& methods, std::vector<double> step_sizes,
                     const ConvergeOptions& options) {
  if (methods.empty()) throw Error("there must be at least one method");
  std::sort(step_sizes.rbegin(), step_sizes.rend());
  step_sizes.erase(std::unique(step_sizes.begin(), step_sizes.end()), step_sizes.end());

  std::vector<Contender> contenders;
  std::vector<RunRequest> requests;
  for (const std::string& method : methods) {
    contenders.push_back({method,
                          {.method = method,
                           .backend = options.backend,
                           .method_options = options_for(method, options.method_options),
                           .backend_options = options.backend_options}});
    static_cast<void>(Simulation(problem, contenders.back().options));  // refuses at once what does not apply
    for (const double h : step_sizes) {
      requests.push_back({.problem = &problem, .contender = contenders.back(), .h = h, .t_end = options.t_end});
    }
  }
  ReferenceOptions reference_options = options.reference;
  if (!reference_options.stop) reference_options.stop = options.stop;
  const Reference reference = make_reference(problem, sample_times(step_sizes, options.t_end), reference_options);

  Convergence study{.problem = problem.name, .reference = {}, .reference_error = reference.error, .rows = {}};
  for (RunOutcome& outcome : measure(requests, reference, options.threads, options.stop)) {
    study.rows.push_back(std::move(outcome.row));
  }
  fill_orders(study.rows);
  // Where the reference is wrong by more than a tenth of an error, or both are round-off, their ratio says nothing.
  const double unresolved = std::max(10 * reference.error, 100 * epsilon * problem.initial.lpNorm<Eigen::Infinity>());
  for (StudyRow& row : study.rows)
    if (row.error <= unresolved) row.order.reset();
  study.reference = described(reference, study.rows);
  if (options.timed) {
    TimingOptions timing = options.timing;
    timing.stop = options.stop;
    add_timings(study.rows, problem, contenders, options.t_end, timing);
  }
  return study;
}

std::string converge_json(const Convergence& study) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const StudyRow& row : study.rows) {
    nlohmann::ordered_json entry = {{"method", row.method},
                                    {"h", row.h},
                                    {"error", row.error},
                                    {"energy_error", row.energy_error},
                                    {"max_energy_increase", row.max_energy_increase},
                                    {"max_modified_increase", row.max_modified_increase},
                                    {"order",
                                     row.order ? nlohmann::ordered_json(*row.order) : nlohmann::ordered_json(nullptr)},
                                    {"scalar_iterations", row.scalar_iterations},
                                    {"fallbacks", row.fallbacks},
                                    {"replaced", row.replaced},
                                    {"unresolved", row.unresolved},
                                    {"steps", row.steps},
                                    {"cpu_seconds", row.cpu_seconds},
                                    {"energy_law_held", row.energy_law_held}};
    if (!row.failure.empty()) entry["failure"] = row.failure;
    rows.push_back(std::move(entry));
  }
  const nlohmann::ordered_json document = {{"problem", study.problem},
                                           {"reference", study.reference},
                                           {"reference_error", study.reference_error},
                                           {"rows", std::move(rows)}};
  return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string converge_table(const Convergence& study) {
  std::string text = fmt::format("{}, errors against {}\n\n", study.problem, study.reference);
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:<8} {:>11} {:>11} {:>6} {:>11} {:>11} {:>10} {:>10} {:>10}\n", "method", "h", "error", "order",
                 "|ΔH|", "rise of H", "iterations", "fallbacks", "CPU [ms]");
  const std::string* method = nullptr;
  for (const StudyRow& row : study.rows) {
    if (method && *method != row.method) text += '\n';
    method = &row.method;
    fmt::format_to(out, "{:<8} {:>11.5g} {:>11.3e} {:>6} {:>11.3e} {:>11.3e} {:>10} {:>10} {:>10.3f}{}{}{}\n",
                   row.method, row.h, row.error, row.order ? fmt::format("{:.2f}", *row.order) : "–", row.energy_error,
                   row.max_energy_increase, row.scalar_iterations, row.fallbacks, 1e3 * row.cpu_seconds,
                   row.replaced > 0 ? fmt::format("  {} of {} steps replaced", row.replaced, row.steps) : "",
                   row.unresolved > 0 ? fmt::format("  {} unresolved", row.unresolved) : "",
                   row.failure.empty() ? "" : "  " + row.failure);
  }
  return text;
}

}  // namespace seiche
