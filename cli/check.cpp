// seiche check: which hypotheses of the energy laws a case meets, and which law is promised; or what a checkpoint
// holds, and whether a run can go on from it.
#include "command_line.hpp"
#include "load_case.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/record/saved_run.hpp>
#include <seiche/simulation/certificate.hpp>
#include <seiche/simulation/kick_stability.hpp>

#include <filesystem>
#include <memory>

namespace seiche::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckArguments {
  CaseArgument case_argument;
  bool json = false;
};

Json to_json(const RunSpec& spec, const Certificate& certificate) {
  Json document = {{"problem", spec.problem}, {"method", spec.method}};
  document.update(Json::parse(certificate_json(certificate)));
  return document;
}

std::string to_text(const RunSpec& spec, const Certificate& certificate) {
  std::string text;
  for (const Hypothesis& hypothesis : certificate.hypotheses) {
    text += fmt::format("{:<30} {}\n", hypothesis.name, to_string(hypothesis.grade));
    text += fmt::format("  {}\n", hypothesis.statement);
    if (!hypothesis.witness.empty()) text += fmt::format("  witness: {}\n", hypothesis.witness);
  }
  text += certificate.law.promised
              ? fmt::format("\nThe energy law of {} is promised: {}.\n  {}\n", spec.method, certificate.law.reason,
                            certificate.theorem)
              : fmt::format("\nNo energy law is promised for {}: {}.\n", spec.method, certificate.law.reason);
  return text;
}

ExitCode check_checkpoint(const CheckArguments& arguments) {
  if (!arguments.case_argument.overrides.empty())
    throw Error("--set changes a case, and {} is a checkpoint, which keeps its own", arguments.case_argument.file);
  const std::filesystem::path file = std::filesystem::absolute(arguments.case_argument.file);
  const SavedRun saved = read_checkpoint(file).run;
  const std::filesystem::path folder = file.parent_path();
  require_case(folder, saved);
  const RunSpec spec = parse_case(saved.case_text, file.string(), {}, folder);
  std::string complaint;
  try {
    complaint = complaint_about(Folder(folder), saved);
  } catch (const Error& error) {
    complaint = error.what();
  }
  const std::uint64_t rows = saved.solution ? saved.solution->rows.rows() : 0;
  std::vector<double> resumed_at;
  for (const ResumedWith& resumed : saved.resumed_with) resumed_at.push_back(resumed.t);
  const double part = 100 * (saved.t - spec.t_start) / (spec.t_end - spec.t_start);
  const Json document = {{"checkpoint", file.filename().string()},
                         {"problem", spec.problem},
                         {"method", spec.method},
                         {"t", saved.t},
                         {"steps", saved.steps},
                         {"end", spec.t_end},
                         {"rows_of_solution", rows},
                         {"bytes_of_energies", saved.energies.file.length},
                         {"resumed_at", resumed_at},
                         {"versions", saved.versions},
                         {"notes", saved.notes},
                         {"usable", complaint.empty()},
                         {"complaint", complaint}};
  std::string text = fmt::format("{} by {}: t = {:.9g} of {:.9g} ({:.3g} %), step {}\n", spec.problem, spec.method,
                                 saved.t, spec.t_end, part, saved.steps);
  text += fmt::format("{}energy.csv had {} bytes\n",
                      saved.solution ? fmt::format("{} states were recorded; ", rows) : "", saved.energies.file.length);
  for (const double t : resumed_at) text += fmt::format("the run had gone on from a checkpoint at t = {:.9g}\n", t);
  text += complaint.empty() ? fmt::format("`seiche resume {}` goes on from there\n", folder.string())
                            : fmt::format("no run can go on from it: {}\n", complaint);
  print_data(arguments.json ? document.dump(2) + "\n" : text);
  return complaint.empty() ? success : computation_failed;
}

ExitCode check(const CheckArguments& arguments) {
  if (is_checkpoint(arguments.case_argument.file)) return check_checkpoint(arguments);
  const RunSpec spec = load_case(arguments.case_argument);
  const Problem problem = make_problem(spec);
  const Simulation simulation(problem, simulation_options(spec));  // refuses what `run` refuses
  const Certificate certificate = certify(problem, {.method = spec.method,
                                                    .method_options = spec.method_options,
                                                    .noise = spec.noise,
                                                    .t_start = spec.t_start,
                                                    .t_end = spec.t_end,
                                                    .at_start = &simulation});
  if (!spec.tolerance)
    print_notes(notes_on_step_size(simulation, spec.sparse, spec.h, {spec.t_start, spec.duration()}));
  print_data(arguments.json ? to_json(spec, certificate).dump(2) + "\n" : to_text(spec, certificate));
  return success;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command =
      app.add_subcommand("check",
                         "The hypotheses that a case meets, how that is known, and the law they promise; or "
                         "what a checkpoint holds");
  add_case(*command, arguments->case_argument);
  command->add_flag("--json", arguments->json, "Print one JSON document on stdout");
  command->callback([arguments, &action] { action = [arguments] { return check(*arguments); }; });
}

}  // namespace seiche::cli
