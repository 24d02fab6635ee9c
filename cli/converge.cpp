// seiche converge: errors, orders, energies and cost of methods at several step sizes.
#include "command_line.hpp"
#include "load_case.hpp"
#include "reference_name.hpp"
#include "stop_signal.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <seiche/config/data/case_value.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/simd/thread_count.hpp>
#include <seiche/law/law.hpp>
#include <seiche/study/converge.hpp>

#include <algorithm>
#include <memory>

namespace seiche::cli {
namespace {

struct ConvergeArguments {
  CaseArgument case_argument;
  std::vector<std::string> methods;
  std::vector<std::string> step_sizes;
  std::string reference = "odeint";
  int threads = 1;
  bool json = false;
};

std::string without_blanks(std::string text) {
  std::erase(text, ' ');
  return text;
}

double step_size(const std::string& text) {
  CaseValue value;
  value.kind = CaseValue::Kind::text;
  value.text = text;
  double h = 0;
  try {
    h = read_number("--h", value);
  } catch (const Error&) {
    throw Error("--h {} must be finite numbers or fractions, with commas between: --h 1/32,1/64", text);
  }
  if (!(h > 0) || !std::isfinite(h)) throw Error("--h {} must be a finite number > 0", text);
  return h;
}

// Options of the case that some of the methods do not know, and by whom they are left out; "" if all know them.
std::string options_left_out(const std::vector<std::string>& methods, const MethodOptions& given) {
  const MethodOptions defaults;
  std::vector<std::string> all;
  const auto look_at = [&](const char* name, auto MethodOptions::*option) {
    std::vector<std::string> without;
    for (const std::string& method : methods)
      if (given.*option != defaults.*option && options_for(method, given).*option == defaults.*option)
        without.push_back(method);
    if (!without.empty()) all.push_back(fmt::format("method.{} is left out by {}", name, fmt::join(without, ", ")));
  };
  look_at("C", &MethodOptions::C);
  look_at("auxiliary", &MethodOptions::auxiliary);
  look_at("scalar_solver", &MethodOptions::scalar_solver);
  look_at("law", &MethodOptions::law);
  look_at("linear", &MethodOptions::linear);
  look_at("predictor", &MethodOptions::predictor);
  return all.empty() ? "" : fmt::format("{}, to which that means nothing", fmt::join(all, ", "));
}

// A law that does not hold where it was promised outweighs nothing but a run that failed.
ExitCode exit_code(const Convergence& study, const RunSpec& spec, const LawPromise& law) {
  const auto failed = [](const StudyRow& row) { return !row.failure.empty(); };
  const auto unlawful = [&](const StudyRow& row) {
    const MethodOptions options = options_for(row.method, spec.method_options);
    return !row.energy_law_held && row.unresolved == 0 && options.objection(find_method(row.method)).empty();
  };
  if (std::any_of(study.rows.begin(), study.rows.end(), failed)) return computation_failed;
  return law.promised && std::any_of(study.rows.begin(), study.rows.end(), unlawful) ? law_violated : success;
}

ExitCode converge_case(const ConvergeArguments& arguments) {
  std::vector<std::string> methods = arguments.methods;
  for (std::string& name : methods) {
    name = without_blanks(name);
    find_method(name);
  }
  RunSpec spec = load_case(arguments.case_argument, methods);
  refuse_noise(spec, "converge");
  const Problem problem = make_problem(spec);
  if (spec.t_start != 0)
    throw Error("{} has time.start = {}, and converge compares runs from t = 0: leave it out", spec.source,
                spec.t_start);
  if (methods.empty()) methods = {spec.method};
  for (auto name = methods.begin(); name != methods.end(); ++name)
    if (std::find(methods.begin(), name, *name) != name) throw Error("--methods names {} twice", *name);
  std::vector<double> step_sizes;
  for (const std::string& text : arguments.step_sizes) step_sizes.push_back(step_size(text));
  if (step_sizes.empty() && spec.h == 0)
    throw Error("{} has a tolerance and no h, and converge compares steps of one size: give --h 1/4,1/8,1/16",
                spec.source);
  if (step_sizes.empty()) step_sizes = {spec.h, spec.h / 2, spec.h / 4};
  for (const double h : step_sizes)
    if (h > spec.t_end) throw Error("--h {} must be ≤ time.end = {}", h, spec.t_end);

  ConvergeOptions options;
  options.t_end = spec.t_end;
  options.backend = spec.backend;
  options.backend_options = simulation_options(spec).backend_options;
  options.method_options = spec.method_options;
  options.threads = arguments.threads;
  options.reference.kind = find_reference(arguments.reference);
  if (const std::string unknown = options_left_out(methods, spec.method_options); !unknown.empty())
    spec.notes.push_back(unknown);
  if (!arguments.step_sizes.empty()) spec.h_is_default = false;
  print_notes(case_notes(spec, problem));

  // What does not exist or does not apply is refused here; what goes wrong from now on is a failed computation.
  for (const std::string& method : methods) {
    Simulation(problem, {.method = method,
                         .backend = spec.backend,
                         .method_options = options_for(method, spec.method_options),
                         .backend_options = options.backend_options});
  }
  const std::atomic<bool>& stop = stop_on_signal();  // until here, a signal simply ends the program
  options.stop = &stop;
  options.reference.stop = &stop;
  Convergence study;
  try {
    study = converge(problem, methods, step_sizes, options);
  } catch (const Error& error) {
    print_failure(error.what());
    return stop ? interrupted : computation_failed;
  }
  print_data(arguments.json ? converge_json(study) : converge_table(study));
  LawPromise law = promise_energy_law(problem, spec.t_end);
  if (!negative_rate(problem).empty()) law.promised = false;  // the runs looked closer
  return stop ? interrupted : exit_code(study, spec, law);
}

}  // namespace

void add_converge(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ConvergeArguments>();
  CLI::App* command = app.add_subcommand("converge", "Errors, orders and cost of methods at several step sizes");
  add_case(*command, arguments->case_argument);
  command->add_option("--methods", arguments->methods, "Methods, by commas; without it, that of the case")
      ->type_name("A,B,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--h", arguments->step_sizes, "Step sizes, by commas; without it h, h/2, h/4 of the case")
      ->type_name("1/32,1/64,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--reference", arguments->reference, reference_help);
  command->add_option("--threads", arguments->threads, "Threads of the error runs; timed runs are alone")
      ->type_name("N")
      ->check(whole_number(1, most_threads));
  command->add_flag("--json", arguments->json, "One JSON document on stdout");
  command->callback([arguments, &action] { action = [arguments] { return converge_case(*arguments); }; });
}

}  // namespace seiche::cli
