// write_case and example_case: the same layout, the second with every meaning and bound beside its key.
#include <seiche/config/case/case_value.hpp>
#include <seiche/config/case/case_writer.hpp>
#include <seiche/config/custom/custom_case.hpp>
#include <seiche/core/error.hpp>
#include <seiche/problem/problems.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

std::string number_or_string(const std::string& text) { return is_toml_number(text) ? text : toml_string(text); }

// Step sizes are fractions by nature: 1/256 says more than 0.00390625.
std::string step_size(double h) {
  const double parts = std::round(1 / h);
  const bool is_fraction = parts >= 2 && parts < 1e9 && 1 / parts == h;
  return is_fraction ? fmt::format("\"1/{}\"", static_cast<long>(parts)) : toml_real(h);
}

std::string initial_text(const InitialData& initial) {
  if (const auto* preset = std::get_if<PresetData>(&initial)) return toml_string(preset->name);
  if (const auto* data = std::get_if<FileData>(&initial))
    return fmt::format("{{ file = {} }}", toml_string(data->file.string()));
  std::vector<std::string> entries;
  for (const auto& [field, formula] : std::get<FormulaData>(initial).formulas)
    entries.push_back(fmt::format("{} = {}", field, toml_string(formula)));
  return fmt::format("{{ {} }}", fmt::join(entries, ", "));
}

std::string_view to_text(AuxiliaryMode mode) {
  switch (mode) {
    case AuxiliaryMode::frozen: return "frozen";
    case AuxiliaryMode::refresh: return "refresh";
    default: return "transport";
  }
}

std::string bounds(const Parameter& p) {
  std::vector<std::string> parts;
  if (p.kind == ParameterKind::integer) parts.emplace_back("whole");
  if (p.kind == ParameterKind::rate) parts.emplace_back("a number, or a formula in t (and x, y, z) in quotes");
  if (std::isfinite(p.minimum)) parts.push_back(fmt::format("{} {}", p.minimum_excluded ? ">" : "≥", p.minimum));
  if (std::isfinite(p.maximum)) parts.push_back(fmt::format("≤ {}", p.maximum));
  if (p.kind == ParameterKind::choice) parts.push_back(fmt::format("\"{}\"", fmt::join(p.choices, "\" | \"")));
  if (p.per_axis) parts.emplace_back("one, or a list for several axes");
  return parts.empty() ? "" : fmt::format(" ({})", fmt::join(parts, ", "));
}

std::string parameter_literal(const Parameter& parameter, const std::string& text) {
  if (parameter.per_axis && text.starts_with('[')) return text;
  const bool is_text = parameter.kind == ParameterKind::choice || parameter.kind == ParameterKind::matrix;
  return is_text ? toml_string(text) : number_or_string(text);
}

std::vector<std::string_view> projecting_methods() {
  std::vector<std::string_view> names;
  for (const MethodEntry& method : methods())
    if (method.projects()) names.push_back(method.name);
  return names;
}

// "key = value" with the comment in one column.
std::string line(const std::string& key, const std::string& value, const std::string& comment) {
  return fmt::format("{:<34}# {}\n", fmt::format("{} = {}", key, value), comment);
}

// As comments: with it a case is many runs.
std::string example_ensemble(const ProblemEntry& entry) {
  std::string text =
      "\n# [ensemble]                      # many runs at once, which leave statistics instead of a solution\n";
  text += line("# members", "64", "how many; as many as there are files, if not given");
  text += line("# seed", "1", "of all random numbers");
  text += line("# perturb_initial", "1e-3", "standard deviation of what is added to every initial value");
  for (const Parameter& parameter : entry.parameters)
    if (may_vary(parameter)) {
      text += line("# " + parameter.name, "{ from = 0.1, to = 0.2 }",
                   "any number of [problem]; or { uniform = [0.1, 0.2] }, { normal = [0.1, 0.01] }");
      break;
    }
  return text + line("# initial", "{ files = [\"a.txt\", \"b.txt\"] }", "a state for each member");
}

// [method] and what follows it.
std::string example_sections(const ProblemEntry& entry) {
  std::string text;
  text += "\n[method]\n";
  text += line("name", toml_string(entry.default_method), fmt::format("auto | {}", fmt::join(method_names(), " | ")));
  text += line("h", number_or_string(entry.default_h), "step size, time; a number, or a fraction in quotes");
  text += line(
      "# tolerance", "1e-8",
      "steps of variable size, each adding at most this error per time (max norm); h is then the first step tried");
  text += line("# h_max", "0.5", "with a tolerance: no longer step");
  text += line("C", "\"auto\"", "sav family: the shift in √(V + C), energy; \"auto\" or a number");
  text +=
      line("auxiliary", "\"transport\"", "transport | frozen | refresh: what the damping does to r (sav, lm family)");
  text += line("scalar_solver", "\"robust\"", "lm family: robust | newton (the paper's)");
  text += line("predictor", "\"remembered\"",
               "avf, sav, lm, dm: remembered (one gradient a step) | gradient (the paper's: two)");
  text += line("# law", "\"interval\"",
               fmt::format("methods that end with a projection ({}): {}; the strongest they can have if not given",
                           fmt::join(projecting_methods(), ", "), fmt::join(energy_law_names(), " | ")));
  text += line("# linear", "\"exact\"",
               "crkn4, crkn6: exact | explicit (all forces as kicks: fastest where nothing is stiff)");

  text += "\n[backend]\n";
  text += line("name", "\"auto\"", fmt::format("auto | {}", fmt::join(backend_names(), " | ")));
  text += line("plan", "\"estimate\"", "FFTW: estimate (repeatable to the bit) | measure (fastest)");
  text += line("exponential", "\"pade\"", "sparse: pade (factorises) | lanczos (does not; S skew, M definite)");
  text += line("pade_degree", "0", "sparse: 1 to 12; 0: whatever round-off asks for");
  text += line("lanczos_dimension", "0", "sparse: pairs of vectors, at least 2; 0: until nothing changes");
  text += "\n[time]\n";
  text += line("# start", "0.0", "time of the initial state, which γ(t) and forces know");
  text += line("end", toml_real(entry.default_end), "time");
  text += "\n[output]\n";
  text += line("directory", toml_string("out/" + entry.name), "made if it is not there");
  text += line("energy_every", "1", "steps");
  text += line("snapshot_every", "64", "steps; 0: the first and the last state only");
  text += line("ledger", "\"off\"", "on: columns of energy.csv that say where the change of H comes from");
  text += line("report", "\"on\"", "report.html, to which seiche plot adds pictures; off: none");
  text += line("# snapshot_interval", "0.5", "time between snapshots; 0: by steps; with a tolerance");
  text +=
      "#   by default 1024 in all up to 16 unknowns, else 512, fewer of very large states, unless snapshot_every is given\n";
  text += "\n[checkpoint]\n";
  text += line("every_seconds", "600", "from which `seiche resume` goes on; 0: when a signal asks for one");
  text += line("every_steps", "0", "steps; 0: by the clock alone");
  text += line("keep", "2", "files: 2, the newest and the one before it, or 1");
  return text + example_ensemble(entry);
}

}  // namespace

std::string write_case(const RunSpec& spec) {
  std::string text = fmt::format("[problem]\nname = {}\n", toml_string(spec.problem));
  if (spec.custom) text += write_custom(*spec.custom, spec.parameter_texts);
  for (const Parameter& parameter : problem_entry(spec).parameters) {
    if (spec.custom && spec.custom->parameters.contains(parameter.name)) continue;  // written already
    const auto value = spec.parameter_texts.find(parameter.name);
    if (value == spec.parameter_texts.end()) throw Error("the case has no parameter {}", parameter.name);
    text += fmt::format("{} = {}\n", parameter.name, parameter_literal(parameter, value->second));
  }
  text += fmt::format("initial = {}\n", initial_text(spec.initial));
  text += write_drives(spec.drives);

  const MethodOptions& options = spec.method_options;
  text += fmt::format("\n[method]\nname = {}\n", toml_string(spec.method));
  if (spec.h > 0) text += fmt::format("h = {}\n", step_size(spec.h));
  if (spec.tolerance) text += fmt::format("tolerance = {}\n", toml_real(*spec.tolerance));
  if (spec.h_max > 0) text += fmt::format("h_max = {}\n", toml_real(spec.h_max));
  text += fmt::format("C = {}\n", options.C ? toml_real(*options.C) : "\"auto\"");
  text += fmt::format("auxiliary = \"{}\"\n", to_text(options.auxiliary));
  text += fmt::format("scalar_solver = \"{}\"\n", options.scalar_solver == ScalarSolver::newton ? "newton" : "robust");

  if (options.predictor == Predictor::gradient) text += "predictor = \"gradient\"\n";
  if (options.law) text += fmt::format("law = \"{}\"\n", to_string(*options.law));
  if (options.linear == LinearTreatment::explicit_kicks) text += "linear = \"explicit\"\n";

  text += fmt::format("\n[backend]\nname = {}\nplan = \"{}\"\n", toml_string(spec.backend),
                      spec.measure_plans ? "measure" : "estimate");
  text += fmt::format("exponential = \"{}\"\npade_degree = {}\nlanczos_dimension = {}\n",
                      spec.sparse.exponential == ExponentialKind::lanczos ? "lanczos" : "pade", spec.sparse.pade_degree,
                      spec.sparse.lanczos_dimension);
  text += "\n[time]\n";
  if (spec.t_start != 0) text += fmt::format("start = {}\n", toml_real(spec.t_start));
  text += fmt::format("end = {}\n", toml_real(spec.t_end));
  text += fmt::format("\n[output]\ndirectory = {}\nenergy_every = {}\nsnapshot_every = {}\n",
                      toml_string(spec.output_directory), spec.energy_every, spec.snapshot_every);
  if (spec.ledger) text += "ledger = \"on\"\n";
  if (!spec.report) text += "report = \"off\"\n";
  if (spec.snapshot_interval > 0) text += fmt::format("snapshot_interval = {}\n", toml_real(spec.snapshot_interval));
  if (const CheckpointSpec& when = spec.checkpoint; when != CheckpointSpec{})
    text += fmt::format("\n[checkpoint]\nevery_seconds = {}\nevery_steps = {}\nkeep = {}\n",
                        toml_real(when.every_seconds), when.every_steps, when.keep);
  if (spec.ensemble) text += write_ensemble(*spec.ensemble);
  return text;
}

std::string case_in_any_folder(RunSpec spec) {
  spec.output_directory = std::string(".");  // GCC 12 sees an overflow in the assignment of a literal
  if (auto* data = std::get_if<FileData>(&spec.initial)) data->file = data->file.filename();
  for (const Parameter& parameter : problem_entry(spec).parameters)
    if (const auto text = spec.parameter_texts.find(parameter.name);
        parameter.kind == ParameterKind::matrix && text != spec.parameter_texts.end())
      text->second = std::filesystem::path(text->second).filename().string();
  if (spec.ensemble)
    for (std::filesystem::path& file : spec.ensemble->files) file = file.filename();
  return write_case(spec);
}

std::string example_case(const std::string& problem) {
  if (problem == custom_name) return example_custom() + example_drives() + example_sections(custom_in_list());
  const std::vector<std::string> names = all_problem_names();
  if (std::find(names.begin(), names.end(), problem) == names.end()) throw unknown_name("problem", problem, names);
  const ProblemEntry& entry = find_problem(problem);
  std::string text = fmt::format("# {}\n# {}\n\n[problem]\n", entry.equation, entry.reference);
  text += fmt::format("name = {}\n", toml_string(entry.name));
  for (const Parameter& parameter : entry.parameters) {
    text += line(parameter.name, parameter_literal(parameter, parameter.default_value),
                 parameter.meaning + bounds(parameter));
  }
  std::vector<std::string> formulas;
  for (const std::string& field : entry.fields) formulas.push_back(fmt::format("{} = \"0\"", field));
  text += line("initial", toml_string(entry.presets.front()),
               fmt::format("{}; or {{ file = \"z0.txt\" }}; or formulas in x (y, z), j: {{ {} }}",
                           fmt::join(entry.presets, " | "), fmt::join(formulas, ", ")));
  text += example_drives();

  return text + example_sections(entry);
}

}  // namespace seiche
