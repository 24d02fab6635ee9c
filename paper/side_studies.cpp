#include <paper/findings.hpp>
#include <paper/multiplier_trace.hpp>
#include <paper/scheme.hpp>
#include <paper/side_studies.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/problem/gkdv.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>

namespace seiche {
namespace {

Contender contender(const char* label, const char* method, AuxiliaryMode auxiliary,
                    ScalarSolver solver = ScalarSolver::robust) {
  return {label, scheme(method, auxiliary, solver)};
}

Contender seisav_printed() { return contender("SEISAV as printed (r frozen)", "seisav", AuxiliaryMode::frozen); }
Contender seisav_repaired() { return contender("SEISAV, r² transported", "seisav", AuxiliaryMode::transport); }
Contender seilm_printed() {
  return contender("SEILM as printed (V frozen, Newton)", "seilm", AuxiliaryMode::frozen, ScalarSolver::newton);
}
Contender seilm_newton() {
  return contender("SEILM, V transported, Newton", "seilm", AuxiliaryMode::transport, ScalarSolver::newton);
}
Contender seilm_repaired() {
  return contender("SEILM, V transported, robust solve", "seilm", AuxiliaryMode::transport);
}

struct Setting {
  Problem problem;
  double t_end;
  std::vector<double> step_sizes;
};

std::vector<double> halved(int first, int last) {
  std::vector<double> h;
  for (int j = first; j <= last; ++j) h.push_back(std::ldexp(1.0, -j));
  return h;
}

std::vector<StudyRow> rows_of(const Setting& setting, const std::vector<Contender>& contenders,
                              const SideStudyOptions& options) {
  const Reference reference =
      make_reference(setting.problem, sample_times(setting.step_sizes, setting.t_end), options.reference);
  std::vector<RunRequest> requests;
  for (const Contender& c : contenders) {
    for (const double h : setting.step_sizes) {
      requests.push_back({.problem = &setting.problem, .contender = c, .h = h, .t_end = setting.t_end});
    }
  }
  std::vector<StudyRow> rows;
  for (RunOutcome& outcome : measure(requests, reference, options.threads, options.stop)) {
    rows.push_back(std::move(outcome.row));
  }
  return rows;
}

// One curve per method: `value` against h, for the runs that reached the end and have one.
std::vector<Curve> curves(const std::vector<StudyRow>& rows, double (*value)(const StudyRow&)) {
  std::vector<Curve> result;
  for (const StudyRow& row : rows) {
    if (result.empty() || result.back().name != row.method) result.push_back({row.method, {}, {}});
    const double y = value(row);
    if (!row.failure.empty() || !std::isfinite(y) || y < 0) continue;
    result.back().t.push_back(row.h);
    result.back().value.push_back(y);
  }
  return result;
}

double error(const StudyRow& row) { return row.error; }
double energy_error(const StudyRow& row) { return row.energy_error; }
double unsolved_share(const StudyRow& row) {
  return static_cast<double>(row.unresolved + row.fallbacks) / static_cast<double>(std::max(row.steps, 1LL));
}

SideStudy strong_nonlinearity(double mu, const char* key, const char* value_of_mu, const SideStudyOptions& options) {
  const Setting setting{gkdv({.sigma = 1.0, .mu = constant_rate(mu)}), 10.0, halved(5, options.quick ? 8 : 10)};
  const std::vector<StudyRow> rows =
      rows_of(setting, {seisav_printed(), seisav_repaired(), seilm_printed(), seilm_repaired()}, options);
  return {.key = key,
          .title = fmt::format("gKdV with σ = 1, μ = {}: printed and repaired schemes", value_of_mu),
          .explanation =
              "The damping of gKdV moves the field that V depends on. The printed schemes leave the auxiliary "
              "variable unchanged there and so converge to another equation, or to none: their error stops "
              "falling as h falls. Carried along with V across the damping, they are of order two. At the "
              "paper's σ = 0.001 this is nearly hidden.",
          .x_label = "time step h",
          .y_label = "maximal error",
          .curves = curves(rows, error)};
}

Setting fragile_setting(bool quick) { return {gkdv({.mu = constant_rate(0.1)}), quick ? 20.0 : 50.0, halved(6, 9)}; }

// In words, what the rows say.
std::string explained(const std::vector<StudyRow>& rows) {
  std::string text;
  for (const Contender& scheme : {seilm_printed(), seilm_newton(), seilm_repaired()}) {
    double smallest = std::numeric_limits<double>::infinity(), largest = 0;
    for (const StudyRow& row : rows) {
      if (row.method != scheme.label || !row.failure.empty()) continue;
      smallest = std::min(smallest, row.error);
      largest = std::max(largest, row.error);
    }
    const std::optional<double> order = observed_order(rows, scheme.label);
    text += fmt::format("{}{}: errors from {:.1e} to {:.1e}{}", text.empty() ? "" : "; ", scheme.label, smallest,
                        largest, order ? fmt::format(", slope {:.2f}", *order) : "");
  }
  return text + ". A convergent scheme of order two has slope 2.";
}

std::vector<SideStudy> fragile_solver(const SideStudyOptions& options) {
  const Setting setting = fragile_setting(options.quick);
  const std::vector<StudyRow> rows = rows_of(setting, {seilm_printed(), seilm_newton(), seilm_repaired()}, options);
  const std::string where = fmt::format("Example 3 with μ = 0.1, T = {:g}", setting.t_end);
  return {{.key = "gkdv_mu01_seilm_error",
           .title = where + ": error of SEILM",
           .explanation = explained(rows),
           .x_label = "time step h",
           .y_label = "maximal error",
           .curves = curves(rows, error)},
          {.key = "gkdv_mu01_seilm_energy_error",
           .title = where + ": energy error of SEILM",
           .explanation = "The same runs, max |H(zⁿ) − H(z(tₙ))|.",
           .x_label = "time step h",
           .y_label = "maximal energy error",
           .curves = curves(rows, energy_error)},
          {.key = "gkdv_mu01_seilm_solver",
           .title = where + ": steps that left the first choice",
           .explanation =
               "Share of the steps in which plain Newton found no root, or in which the robust solve turned to the "
               "directed multiplier, since near a turning point of V the equation for η is ill-conditioned.",
           .x_label = "time step h",
           .y_label = "share of steps",
           .curves = curves(rows, unsolved_share)}};
}

// |η − 1| over time; of each of some hundred stretches the largest, since single steps are what matters.
Curve multiplier_curve(const Problem& problem, const Contender& contender, double h, double t_end) {
  constexpr std::size_t points = 400;
  Simulation simulation(problem, contender.options);
  MultiplierTrace trace(simulation.system(), h);
  Observer* const observers[] = {&trace};
  integrate(simulation.system(), simulation.stepper(), simulation.state(), {.h = h, .t_end = t_end}, observers);
  Curve curve{contender.label, {}, {}};
  const std::size_t stretch = std::max<std::size_t>(1, trace.t().size() / points);
  for (std::size_t i = 0; i < trace.t().size(); i += stretch) {
    double largest = 0;
    for (std::size_t k = i; k < std::min(i + stretch, trace.t().size()); ++k) {
      largest = std::max(largest, std::abs(trace.eta()[k] - 1));
    }
    if (largest == 0) continue;  // no place on a logarithmic axis
    curve.t.push_back(trace.t()[i]);
    curve.value.push_back(largest);
  }
  return curve;
}

SideStudy multiplier_over_time(const SideStudyOptions& options) {
  const Setting setting = fragile_setting(options.quick);
  const double h = setting.step_sizes[1];
  SideStudy study{.key = "gkdv_mu01_multiplier",
                  .title = "Example 3 with μ = 0.1, h = 2⁻⁷: the multiplier of SEILM",
                  .explanation =
                      "|η − 1|, the largest in each stretch of steps; of size h² where the equation is well "
                      "conditioned. As printed, η also has to make up for the V that the damping took away. With V "
                      "carried along it leaves 1 only at the turning points of V, where the robust solve takes "
                      "another direction instead.",
                  .x_label = "t",
                  .y_label = "|η − 1|",
                  .log_x = false,
                  .curves = {}};
  for (const Contender& c : {seilm_printed(), seilm_newton(), seilm_repaired()}) {
    study.curves.push_back(multiplier_curve(setting.problem, c, h, setting.t_end));
  }
  return study;
}

}  // namespace

std::vector<SideStudy> side_studies(const SideStudyOptions& options) {
  std::vector<SideStudy> studies;
  const auto stopped = [&] { return options.stop && options.stop->load(); };
  const auto add = [&](const std::function<std::vector<SideStudy>()>& study) {
    if (stopped()) return;
    std::vector<SideStudy> done = study();
    if (!stopped()) std::move(done.begin(), done.end(), std::back_inserter(studies));  // else it was cut short
  };
  add([&] { return std::vector{strong_nonlinearity(0.5, "gkdv_sigma1", "0.5", options)}; });
  add([&] { return std::vector{strong_nonlinearity(0.1, "gkdv_sigma1_mu01", "0.1", options)}; });
  add([&] { return fragile_solver(options); });
  add([&] { return std::vector{multiplier_over_time(options)}; });
  return studies;
}

}  // namespace seiche
