// seiche list: what there is, for people and for programs.
#include "command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <seiche/backend/backends.hpp>
#include <seiche/config/case/key_rows.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/study/lists.hpp>

#include <memory>

namespace seiche::cli {
namespace {

std::string methods_text() {
  constexpr auto row = "{:<13} {:<8} {:<12} {:<12} {:>5}  {:<11} {:<11} {}\n";
  std::string text =
      fmt::format(row, "name", "closure", "propagator", "composition", "order", "law", "projection", "reference");
  for (const MethodEntry& method : methods()) {
    text += fmt::format(row, method.name, method.kind.closure, to_string(method.propagator), method.kind.composition,
                        method.order, method.kept_energy, method.projects() ? to_string(method.projection) : "",
                        method.reference);
  }
  return text + fmt::format("{:<13} {}\n", "auto", what_auto_is);
}

std::string problems_text() {
  std::string text;
  for (const ProblemEntry& problem : listed_problems()) {
    std::vector<std::string> names;
    for (const Parameter& parameter : problem.parameters) names.push_back(parameter.name);
    text += fmt::format("{:<14} {}\n{:14} from {}\n{:14} parameters {}; initial {}\n", problem.name, problem.equation,
                        "", problem.reference, "", fmt::join(names, ", "), fmt::join(problem.presets, ", "));
  }
  return text;
}

std::string backends_text() {
  std::string text;
  for (const std::string& name : backend_names()) text += fmt::format("{:<9} {}\n", name, find_backend(name).summary);
  return text;
}

std::string keys_text() {
  std::string text;
  for (const KeyRow& row : key_rows())
    text += fmt::format("{:<26} {}\n", fmt::format("{}.{}", row.section, row.name), row.meaning);
  return text;
}

struct List {
  std::string name;
  std::string (*json)();
  std::string (*text)();
};
const std::vector<List> lists = {{"methods", methods_json, methods_text},
                                 {"problems", problems_json, problems_text},
                                 {"backends", backends_json, backends_text},
                                 {"keys", keys_json, keys_text}};

ExitCode print_list(const std::string& name, bool json) {
  std::vector<std::string> names;
  for (const List& list : lists) {
    names.push_back(list.name);
    if (list.name != name) continue;
    print_data(json ? list.json() + "\n" : list.text());
    return success;
  }
  if (name.empty()) throw Error("say what to list: seiche list {}", fmt::join(names, ", seiche list "));
  throw unknown_name("list", name, names);
}

}  // namespace

void add_list(CLI::App& app, Action& action) {
  struct Arguments {
    std::string name;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("list", "List methods, problems, backends, or keys of case files");
  command->add_option("WHAT", arguments->name, "methods, problems, backends or keys");
  command->add_flag("--json", arguments->json, "One JSON array on stdout");
  command->callback(
      [arguments, &action] { action = [arguments] { return print_list(arguments->name, arguments->json); }; });
}

}  // namespace seiche::cli
