#include <seiche/backend/backends.hpp>
#include <seiche/config/case/key_rows.hpp>
#include <seiche/config/custom/custom_case.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/study/lists.hpp>

#include <nlohmann/json.hpp>

namespace seiche {
namespace {
using Json = nlohmann::ordered_json;
}  // namespace

std::string json_of_toml(const std::string& text) { return Json::accept(text) ? text : Json(text).dump(); }

std::vector<ProblemEntry> listed_problems() {
  std::vector<ProblemEntry> list(problems().begin(), problems().end());
  list.push_back(custom_in_list());
  return list;
}

std::string methods_json() {
  Json list = Json::array();
  for (const MethodEntry& method : methods()) {
    list.push_back({{"name", method.name},
                    {"closure", method.kind.closure},
                    {"propagator", to_string(method.propagator)},
                    {"composition", method.kind.composition},
                    {"order", method.order},
                    {"law", method.kept_energy},
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
  return list.dump(2);
}

std::string problems_json() {
  Json list = Json::array();
  for (const ProblemEntry& problem : listed_problems()) {
    Json parameters = Json::array();
    for (const Parameter& parameter : problem.parameters) {
      parameters.push_back(
          {{"name", parameter.name}, {"default", parameter.default_value}, {"meaning", parameter.meaning}});
    }
    list.push_back({{"name", problem.name},
                    {"title", problem.title},
                    {"equation", problem.equation},
                    {"reference", problem.reference},
                    {"fields", problem.fields},
                    {"initial", problem.presets},
                    {"parameters", parameters}});
  }
  return list.dump(2);
}

std::string backends_json() {
  Json list = Json::array();
  for (const std::string& name : backend_names())
    list.push_back({{"name", name}, {"summary", find_backend(name).summary}});
  return list.dump(2);
}

std::string keys_json() {
  Json list = Json::array();
  for (const KeyRow& row : key_rows())
    list.push_back(
        {{"name", fmt::format("{}.{}", row.section, row.name)},
         {"default", row.is_default && !row.example.empty() ? Json::parse(json_of_toml(row.example)) : Json(nullptr)},
         {"choices", row.choices},
         {"meaning", row.meaning}});
  return list.dump(2);
}

}  // namespace seiche
