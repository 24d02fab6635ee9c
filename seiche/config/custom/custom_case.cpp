#include <seiche/config/custom/custom_case.hpp>
#include <seiche/config/custom/custom_names.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/formula/formula_text.hpp>

#include <fmt/ranges.h>

#include <algorithm>

namespace seiche {
namespace {

// A formula in quotes, or a number.
std::string read_formula(const std::string& key, const CaseValue& value) {
  if (value.kind != CaseValue::Kind::text && value.kind != CaseValue::Kind::number)
    throw Error("{} = {} must be a formula in quotes, or a number", key, value.shown());
  if (value.text.empty()) throw Error("{} is an empty formula", key);
  return value.text;
}

std::vector<std::string> read_names(const std::string& key, const CaseValue& value) {
  if (value.kind == CaseValue::Kind::text) return {value.text};
  if (value.kind != CaseValue::Kind::list || value.entries.empty())
    throw Error("{} = {} must be a list of names, as in [\"u\", \"v\"]", key, value.shown());
  std::vector<std::string> names;
  for (const auto& [none, name] : value.entries) names.push_back(read_text(key, name));
  return names;
}

FormulaConstants read_parameters(const std::string& key, const CaseValue& value) {
  if (value.kind != CaseValue::Kind::table)
    throw Error("{} = {} must be a table of numbers, as in {{ kappa = 0.04, alpha = -1.0 }}", key, value.shown());
  FormulaConstants parameters;
  for (const auto& [name, number] : value.entries)
    parameters[name] = read_number(fmt::format("{}.{}", key, shortened(name)), number);
  return parameters;
}

std::size_t index_of(const std::string& key, const std::string& field, const std::vector<std::string>& fields) {
  const auto found = std::find(fields.begin(), fields.end(), field);
  if (found == fields.end()) throw unknown_name("field in " + key, field, fields);
  return static_cast<std::size_t>(found - fields.begin());
}

// A list of rows, { field = "entry" } for a diagonal, or the one entry of a single field.
FormulaTable read_table(const std::string& key, const CaseValue& value, const std::vector<std::string>& fields) {
  const std::size_t n = fields.size();
  FormulaTable table(n, std::vector<std::string>(n, "0"));
  switch (value.kind) {
    case CaseValue::Kind::table:
      for (const auto& [field, entry] : value.entries) {
        const std::size_t i = index_of(key, field, fields);
        table[i][i] = read_formula(fmt::format("{}.{}", key, field), entry);
      }
      return table;
    case CaseValue::Kind::list: {
      table.clear();
      for (std::size_t i = 0; i < value.entries.size(); ++i) {
        const CaseValue& row = value.entries[i].second;
        if (row.kind != CaseValue::Kind::list)
          throw Error(
              "{} is a list of numbers, and must be one of {} rows with {} entries each, or name the diagonal: {{ {} = … }}",
              key, n, n, fields.back());
        table.emplace_back();
        for (std::size_t j = 0; j < row.entries.size(); ++j)
          table.back().push_back(
              read_formula(fmt::format("{}, row {}, column {}", key, i + 1, j + 1), row.entries[j].second));
      }
      return table;
    }
    default:
      if (n != 1)
        throw Error("{} = {} must be a table such as {{ {} = {} }}, or a list of {} rows", key, value.shown(),
                    fields.back(), shortened(toml_string(value.text)), n);
      return {{read_formula(key, value)}};
  }
}

std::string table_text(const FormulaTable& table) {
  if (table.size() == 1) return toml_string(table[0][0]);
  std::vector<std::string> rows;
  for (const auto& row : table) {
    std::vector<std::string> entries;
    for (const std::string& entry : row) entries.push_back(toml_string(entry));
    rows.push_back(fmt::format("[{}]", fmt::join(entries, ", ")));
  }
  return fmt::format("[{}]", fmt::join(rows, ", "));
}

std::vector<std::string> all_formulas(const CustomProblem& custom) {
  std::vector<std::string> formulas = {custom.H, custom.V};
  for (const FormulaTable* table : {&custom.M, &custom.S, &custom.D})
    for (const auto& row : *table) formulas.insert(formulas.end(), row.begin(), row.end());
  for (const auto& [field, formula] : custom.initial) formulas.push_back(formula);
  return formulas;
}

}  // namespace

std::vector<std::string> all_problem_names() {
  std::vector<std::string> names = problem_names();
  names.emplace_back(custom_name);
  return names;
}

const std::vector<std::string>& custom_keys() {
  static const std::vector<std::string> keys = {"fields", "parameters", "H", "M", "V", "S", "D"};
  return keys;
}

void read_custom_key(CustomProblem& custom, const std::string& key, const CaseValue& value) {
  const std::string full = "problem." + key;
  if (key == "fields") {
    custom.fields = read_names(full, value);
    field_names(custom);
  } else if (key == "parameters") {
    custom.parameters = read_parameters(full, value);
    field_names(custom);
  } else if (key == "H") {
    custom.H = read_formula(full, value);
  } else if (key == "V") {
    custom.V = read_formula(full, value);
  } else if (key == "M") {
    custom.M = read_table(full, value, field_names(custom));
  } else if (key == "D") {
    custom.D = read_table(full, value, field_names(custom));
  } else if (value.kind != CaseValue::Kind::text || value.text != "canonical") {
    custom.S = read_table(full, value, field_names(custom));
  }
}

ProblemEntry custom_entry(const CustomProblem& custom, bool has_grid) {
  require_structure(custom);
  ProblemEntry entry{
      .name = custom_name,
      .equation = "ż = S∇H(z) − Dz with H, S and D by formulas",
      .reference = "the case file, with your own H, S and D",
      .fields = field_names(custom),
      .parameters = has_grid ? grid_parameters("64", "1.0") : std::vector<Parameter>{},
      .presets = {"zero"},
      .make = nullptr,
      .default_h = "1/64",
      .default_end = 50.0,
  };
  std::vector<std::string> keys = {"name", "initial", "friction", "force", "x", "y", "z"};
  keys.insert(keys.end(), custom_keys().begin(), custom_keys().end());
  for (const Parameter& parameter : grid_parameters("", "")) keys.push_back(parameter.name);
  for (const auto& [name, value] : custom.parameters) {
    if (std::find(keys.begin(), keys.end(), name) != keys.end())
      throw Error("problem.parameters: the name {} is taken by a key of [problem], or a place", name);
    entry.parameters.push_back(
        {.name = name, .default_value = toml_real(value), .meaning = "a number in the formulas"});
  }
  entry.make = [custom, has_grid](const ParameterValues& values, const std::string&) {
    CustomProblem problem = custom;
    if (has_grid) problem.grid = grid_options(values);
    for (auto& [name, value] : problem.parameters) value = values.real(name);
    return custom_problem(problem);
  };
  return entry;
}

void try_formulas(const CustomProblem& custom, const ParameterValues& values) {
  CustomProblem small = custom;
  small.initial.clear();
  small.is_trial = small.grid.has_value();
  for (auto& [name, value] : small.parameters) value = values.real(name);
  if (small.grid) {
    constexpr Index points = 8;
    GridOptions& grid = small.grid.emplace(grid_options(values));
    grid.points.assign(std::max(grid.points.size(), grid.length.size()), points);
    grid.two_thirds = false;
  }
  custom_problem(small);
}

std::string write_custom(const CustomProblem& custom, const std::map<std::string, std::string>& texts) {
  std::vector<std::string> fields;
  for (const std::string& field : field_names(custom)) fields.push_back(toml_string(field));
  std::string text = fmt::format("fields = [{}]\n", fmt::join(fields, ", "));
  if (!custom.parameters.empty()) {
    std::vector<std::string> entries;
    for (const auto& [name, value] : custom.parameters) {
      const auto written = texts.find(name);
      const std::string number = written != texts.end() ? written->second : toml_real(value);
      entries.push_back(fmt::format("{} = {}", name, is_toml_number(number) ? number : toml_string(number)));
    }
    text += fmt::format("parameters = {{ {} }}\n", fmt::join(entries, ", "));
  }
  if (!custom.H.empty()) text += fmt::format("H = {}\n", toml_string(custom.H));
  if (!custom.M.empty()) text += fmt::format("M = {}\n", table_text(custom.M));
  if (!custom.V.empty()) text += fmt::format("V = {}\n", toml_string(custom.V));
  if (!custom.S.empty()) text += fmt::format("S = {}\n", table_text(custom.S));
  if (!custom.D.empty()) text += fmt::format("D = {}\n", table_text(custom.D));
  return text;
}

std::vector<std::string> unused_parameters(const CustomProblem& custom, const std::vector<std::string>& others) {
  std::vector<std::string> formulas = all_formulas(custom);
  formulas.insert(formulas.end(), others.begin(), others.end());
  std::vector<std::string> unused;
  for (const auto& [name, value] : custom.parameters) {
    const bool named = std::any_of(formulas.begin(), formulas.end(), [&name = name](const std::string& formula) {
      const std::vector<FormulaToken> tokens = tokenise_formula(formula);
      return std::any_of(tokens.begin(), tokens.end(), [&](const FormulaToken& token) { return token.text == name; });
    });
    if (!named) unused.push_back(name);
  }
  return unused;
}

std::string example_custom() {
  return R"case(# ż = S∇H(z) − Dz, written down

[problem]
name = "custom"
fields = ["u", "v"]               # coordinates, then their momenta; or as S says
length = 2.0                      # leave length, points, boundary, discretisation and dealias out for a few
points = 64                       #   degrees of freedom, and name the fields q, p
boundary = "periodic"             # periodic | dirichlet | neumann, or a list for several axes
discretisation = "fd2"            # fd2 | fd4 | spectral
parameters = { kappa = 0.04, alpha = 1.0, gamma = 0.1 }  # [problem] and --set may say kappa = 0.05, [ensemble] vary it
H = "v^2/2 + kappa/2*u_x^2 + alpha/4*u^4"  # energy of a point; u_x, u_xx: derivatives, du = u_{j+1} − u_j
# M = [["-kappa*laplacian", 0], [0, 1]]    # or apart: H = ½zᵀMz + V
# V = "alpha/4*u^4"
# S = [[0, 1], [-1, 0]]           # entries: numbers, derivatives d_x, d_x^3, laplacian, and functions of the
                                  #   wave number, sqrt(tanh(k)/k), where spectral; not given: this
D = { v = "gamma" }               # of fields, or rows like S; also "gamma - 0.01*laplacian", "0.1 + 0.05*sin(t)"
initial = { u = "exp(-10*(x-1)^2)", v = 0 }
)case";
}

const ProblemEntry& custom_in_list() {
  static const ProblemEntry entry = custom_entry({}, true);
  return entry;
}

}  // namespace seiche
