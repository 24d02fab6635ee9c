// seiche check: which hypotheses of the energy laws a case meets, and which law is promised.
#include "command_line.hpp"
#include "load_case.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <seiche/simulation/certificate.hpp>

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

ExitCode check(const CheckArguments& arguments) {
  const RunSpec spec = load_case(arguments.case_argument);
  const Problem problem = make_problem(spec);
  const Simulation simulation(problem, simulation_options(spec));  // refuses what `run` refuses
  const Certificate certificate = certify(problem, {.method = spec.method,
                                                    .method_options = spec.method_options,
                                                    .t_start = spec.t_start,
                                                    .t_end = spec.t_end,
                                                    .at_start = &simulation});
  print_data(arguments.json ? to_json(spec, certificate).dump(2) + "\n" : to_text(spec, certificate));
  return success;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command =
      app.add_subcommand("check", "The hypotheses that a case meets, how that is known, and the law they promise");
  add_case(*command, arguments->case_argument);
  command->add_flag("--json", arguments->json, "Print one JSON document on stdout");
  command->callback([arguments, &action] { action = [arguments] { return check(*arguments); }; });
}

}  // namespace seiche::cli
