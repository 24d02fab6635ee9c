// seiche schema: what editors need to check and complete case files, as a JSON Schema.
#include "command_line.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <seiche/config/case/friction_kinds.hpp>
#include <seiche/config/case/key_rows.hpp>
#include <seiche/config/custom/custom_case.hpp>
#include <seiche/study/lists.hpp>
#include <seiche/version.hpp>

#include <cmath>

namespace seiche::cli {
namespace {

using Json = nlohmann::ordered_json;

// Numbers may be computed in quotes, as in "1/256".
template <class Key>
Json number(const char* type, const Key& key) {
  Json schema = {{"type", type}};
  if (std::isfinite(key.minimum)) schema[key.minimum_excluded ? "exclusiveMinimum" : "minimum"] = key.minimum;
  if (std::isfinite(key.maximum)) schema["maximum"] = key.maximum;
  return {{"anyOf", {schema, {{"type", "string"}, {"pattern", "[0-9]|pi|^auto$"}}}}};
}

const Json formula = {{"type", {"string", "number"}}};

Json value_of(const KeyRow& row) {
  switch (row.kind) {
    case KeyRow::Kind::choice: return {{"enum", row.choices}};
    case KeyRow::Kind::text: return {{"type", "string"}};
    case KeyRow::Kind::whole: return number("integer", row);
    case KeyRow::Kind::number: break;
  }
  return number("number", row);
}

Json value_of(const Parameter& p) {
  switch (p.kind) {
    case ParameterKind::choice: return {{"enum", p.choices}};
    case ParameterKind::matrix: return {{"type", "string"}};
    case ParameterKind::integer: return number("integer", p);
    case ParameterKind::rate:
    case ParameterKind::function: return formula;
    case ParameterKind::real: break;
  }
  return number("number", p);
}

// What a key is where it is not given, from its text in TOML.
Json default_of(const std::string& text) { return Json::parse(json_of_toml(text)); }

Json described(Json schema, const std::string& meaning) {
  schema["description"] = meaning;
  return schema;
}

Json table(Json keys) { return {{"type", "object"}, {"properties", std::move(keys)}, {"additionalProperties", false}}; }

// A kind, and the keys of this kind.
Json friction_table() {
  Json names = Json::array(), kinds = Json::array();
  for (const FrictionKind& kind : friction_kinds()) {
    names.push_back(kind.name);
    Json keys = {{"kind", Json::object()}}, required = {"kind"};
    for (const FrictionKey& key : kind.keys) {
      const Json bounds = {{"type", "number"}, {key.is_positive ? "exclusiveMinimum" : "minimum", 0}};
      keys[key.name] = key.is_formula ? formula : Json{{"anyOf", {bounds, {{"type", "string"}}}}};
      if (key.default_value.empty()) required.push_back(key.name);
    }
    Json of_kind = table(std::move(keys));
    of_kind["required"] = std::move(required);
    kinds.push_back({{"if", {{"properties", {{"kind", {{"const", kind.name}}}}}}}, {"then", std::move(of_kind)}});
  }
  return {{"type", "object"},
          {"required", {"kind"}},
          {"properties", {{"kind", {{"enum", std::move(names)}}}}},
          {"allOf", std::move(kinds)}};
}

Json keys_of_problem(const ProblemEntry& problem) {
  Json keys = {{"name", {{"const", problem.name}}}};
  for (const Parameter& parameter : problem.parameters) {
    Json one = value_of(parameter);
    if (parameter.per_axis) one = {{"anyOf", {one, {{"type", "array"}, {"items", one}}}}};
    if (!parameter.default_value.empty()) one["default"] = default_of(parameter.default_value);
    keys[parameter.name] = described(std::move(one), parameter.meaning);
  }
  keys["initial"] = described({{"anyOf", {{{"enum", problem.presets}}, {{"type", "object"}}}}},
                              "one of these, { file = … }, or a formula in x, y, z and j for every field");
  keys["friction"] = described(friction_table(), "friction beyond D: a kind and its coefficients");
  keys["force"] = described({{"type", {"string", "number", "object"}}, {"additionalProperties", formula}},
                            "a force on fields, by formulas in t, x, y and z");
  return keys;
}

// Numbers of one's own may stand beside the keys.
Json custom_problem_table() {
  Json keys = keys_of_problem(custom_in_list());
  const Json row = {{"type", "array"}, {"items", formula}};
  const Json of_fields = {{"type", {"object", "array", "string", "number"}},
                          {"additionalProperties", formula},
                          {"items", row}};
  for (const std::string& key : custom_keys()) keys[key] = of_fields;  // M, S and D
  keys["fields"] = {{"type", "array"}, {"items", {{"type", "string"}}}};
  keys["parameters"] = {{"type", "object"}, {"additionalProperties", formula}};
  keys["H"] = keys["V"] = formula;
  Json schema = table(std::move(keys));
  schema["additionalProperties"] = formula;
  return schema;
}

Json problem_section() {
  Json schema = {{"type", "object"},
                 {"required", {"name"}},
                 {"properties", {{"name", {{"enum", all_problem_names()}}}}},
                 {"allOf", Json::array()}};
  for (const std::string& name : all_problem_names()) {
    const Json is_named = {{"properties", {{"name", {{"const", name}}}}}};
    schema["allOf"].push_back(
        {{"if", is_named},
         {"then", name == custom_name ? custom_problem_table() : table(keys_of_problem(find_problem(name)))}});
  }
  return schema;
}

Json section(const std::string& name) {
  Json keys = Json::object();
  for (const KeyRow& row : key_rows()) {
    if (row.section != name) continue;
    Json one = value_of(row);
    if (row.is_default && !row.example.empty()) one["default"] = default_of(row.example);
    keys[row.name] = described(std::move(one), row.meaning);
  }
  return table(std::move(keys));
}

Json schema_of_case_files() {
  Json sections = {{"problem", problem_section()}};
  for (const std::string& name : case_sections())
    if (name != "problem") sections[name] = section(name);
  Json& ensemble = sections["ensemble"];
  ensemble["properties"]["initial"] = {{"type", "object"}, {"description", "{ files = […] }: a state for each member"}};
  ensemble["additionalProperties"] = {{"type", "object"},
                                      {"description", "{ from = …, to = … }, { uniform = […] } or { normal = […] }"}};
  Json schema = table(std::move(sections));
  Json whole = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                {"title", fmt::format("Case file of Seiche {}", version_number)},
                {"required", {"problem"}}};
  whole.update(schema);
  return whole;
}

}  // namespace

void add_schema(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("schema", "Print the JSON Schema of case files, for editors");
  command->callback([&action] {
    action = [] {
      print_data(schema_of_case_files().dump(2) + "\n");
      return success;
    };
  });
}

}  // namespace seiche::cli
