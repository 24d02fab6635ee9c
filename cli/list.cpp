// seiche list: what there is, for people and for programs.
#include "command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <seiche/backend/backends.hpp>
#include <seiche/config/custom_case.hpp>
#include <seiche/core/error.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/problem/problems.hpp>

#include <iterator>
#include <memory>

namespace seiche::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto what_auto_is =
    "one of these, chosen by tolerance, stiffness, damping and friction of the case; a run says which and why";

Json methods_json() {
  Json list = Json::array();
  for (const MethodEntry& method : methods()) {
    list.push_back({{"name", method.name},
                    {"closure", to_string(method.closure)},
                    {"propagator", to_string(method.propagator)},
                    {"composition", to_string(method.composition)},
                    {"order", method.order},
                    {"law", method.law},
                    {"projection", method.projects() ? Json(to_string(method.projection)) : Json(nullptr)},
                    {"reference", method.reference}});
  }
  list.push_back({{"name", "auto"},
                  {"closure", nullptr},
                  {"propagator", nullptr},
                  {"composition", nullptr},
                  {"order", nullptr},
                  {"law", nullptr},
                  {"projection", nullptr},
                  {"reference", what_auto_is}});
  return list;
}

std::vector<ProblemEntry> listed_problems() {
  std::vector<ProblemEntry> list(problems().begin(), problems().end());
  list.push_back(custom_in_list());
  return list;
}

Json problems_json() {
  Json list = Json::array();
  for (const ProblemEntry& problem : listed_problems()) {
    Json parameters = Json::array();
    for (const Parameter& parameter : problem.parameters) {
      parameters.push_back(
          {{"name", parameter.name}, {"default", parameter.default_value}, {"meaning", parameter.meaning}});
    }
    list.push_back({{"name", problem.name},
                    {"equation", problem.equation},
                    {"reference", problem.reference},
                    {"fields", problem.fields},
                    {"initial", problem.presets},
                    {"parameters", parameters}});
  }
  return list;
}

Json backends_json() {
  Json list = Json::array();
  for (const BackendEntry& backend : backends()) list.push_back({{"name", backend.name}, {"summary", backend.summary}});
  return list;
}

std::string methods_text() {
  constexpr auto row = "{:<13} {:<8} {:<12} {:<12} {:>5}  {:<11} {:<11} {}\n";
  std::string text =
      fmt::format(row, "name", "closure", "propagator", "composition", "order", "law", "projection", "reference");
  for (const MethodEntry& method : methods()) {
    text += fmt::format(row, method.name, to_string(method.closure), to_string(method.propagator),
                        to_string(method.composition), method.order, method.law,
                        method.projects() ? to_string(method.projection) : "", method.reference);
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
  for (const BackendEntry& backend : backends()) text += fmt::format("{:<8} {}\n", backend.name, backend.summary);
  return text;
}

struct List {
  std::string name;
  Json (*json)();
  std::string (*text)();
};
const std::vector<List> lists = {{"methods", methods_json, methods_text},
                                 {"problems", problems_json, problems_text},
                                 {"backends", backends_json, backends_text}};

ExitCode print_list(const std::string& name, bool json) {
  std::vector<std::string> names;
  for (const List& list : lists) {
    names.push_back(list.name);
    if (list.name != name) continue;
    print_data(json ? list.json().dump(2) + "\n" : list.text());
    return success;
  }
  throw unknown_name("list", name, names);
}

}  // namespace

void add_list(CLI::App& app, Action& action) {
  struct Arguments {
    std::string name;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("list", "List methods, problems or backends");
  command->add_option("WHAT", arguments->name, "methods, problems or backends")->required();
  command->add_flag("--json", arguments->json, "One JSON array on stdout");
  command->callback(
      [arguments, &action] { action = [arguments] { return print_list(arguments->name, arguments->json); }; });
}

}  // namespace seiche::cli
