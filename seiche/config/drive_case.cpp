#include <seiche/config/case_parameters.hpp>
#include <seiche/config/drive_case.hpp>
#include <seiche/config/formula_compiler.hpp>
#include <seiche/core/error.hpp>
#include <seiche/core/momenta.hpp>
#include <seiche/damping/field_rates.hpp>
#include <seiche/damping/formula_frictions.hpp>
#include <seiche/damping/frictions.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace seiche {
namespace {

struct FrictionKey {
  std::string name;
  bool is_formula = false;
  std::string default_value = {};  // empty: it must be given
};

struct FrictionKind {
  std::string name;
  std::vector<FrictionKey> keys;
};

const std::vector<FrictionKind>& friction_kinds() {
  static const std::vector<FrictionKind> kinds = {
      {"quadratic", {{"coefficient"}, {"linear", false, "0"}}},
      {"cubic", {{"coefficient"}}},
      {"tanh", {{"coefficient"}, {"width"}}},
      {"dry", {{"coefficient"}}},
      {"isotropic", {{"coefficient"}}},
      {"position", {{"coefficient", true}}},
      {"formula", {{"r", true}}},
  };
  return kinds;
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const FrictionKind& kind : friction_kinds()) names.push_back(kind.name);
  return names;
}

const FrictionKind& find_kind(const std::string& name) {
  return *std::find_if(friction_kinds().begin(), friction_kinds().end(),
                       [&](const FrictionKind& kind) { return kind.name == name; });
}

const std::vector<std::string>& friction_variables() {
  static const std::vector<std::string> names = {"v", "u", "t", "x", "y", "z"};
  return names;
}

double constant(const std::string& text) { return (*compile_formula(text, {}))(std::span<const double>()); }

bool compiles_without(const std::string& text, const std::vector<std::string>& absent) {
  std::vector<std::string> names = friction_variables();
  std::erase_if(names,
                [&](const std::string& n) { return std::find(absent.begin(), absent.end(), n) != absent.end(); });
  try {
    compile_formula(text, names);
    return true;
  } catch (const Error&) {
    return false;
  }
}

FrictionFormula friction_formula(const std::string& text, const Grid& grid) {
  constexpr std::array axes = {"x", "y", "z"};
  for (std::size_t a = static_cast<std::size_t>(grid.dimension()); a < axes.size(); ++a)
    if (!compiles_without(text, {axes[a]}))
      throw Error("problem.friction: {} names {}, but the grid has {} ax{}", text, axes[a], grid.dimension(),
                  grid.dimension() == 1 ? "is" : "es");
  return {.formula = compile_formula(text, friction_variables()),
          .uses_u = !compiles_without(text, {"u"}),
          .uses_t = !compiles_without(text, {"t"}),
          .uses_place = !compiles_without(text, {"x", "y", "z"})};
}

FrictionPointer make_friction(const FrictionSpec& spec, const Problem& problem) {
  const auto number = [&](const char* key) { return constant(spec.texts.at(key)); };
  const auto formula = [&](const char* key) { return friction_formula(spec.texts.at(key), problem.grid); };
  if (spec.kind == "quadratic") return quadratic_friction(number("linear"), number("coefficient"));
  if (spec.kind == "cubic") return cubic_friction(number("coefficient"));
  if (spec.kind == "tanh") return saturating_friction(number("coefficient"), number("width"));
  if (spec.kind == "dry") return dry_friction(number("coefficient"));
  if (spec.kind == "isotropic")
    return isotropic_friction(number("coefficient"), static_cast<std::size_t>(problem.field_count() / 2));
  if (spec.kind == "position") return position_friction(formula("coefficient"), problem.grid);
  return formula_friction(formula("r"), problem.grid);
}

// The momentum where there is one, or the only field.
Index obvious_field(const Problem& problem) {
  if (problem.field_count() == 1) return 0;
  const std::optional<Momenta> found = momenta(problem);
  if (found && found->count == 1) return found->first;
  throw Error("problem.force: say which of the fields {} it acts on, as in force = {{ {} = \"sin(t)\" }}",
              fmt::join(problem.fields, ", "), problem.fields.back());
}

std::string literal(const std::string& text) { return is_toml_number(text) ? text : toml_string(text); }

}  // namespace

FrictionSpec read_friction(const std::string& key, const CaseValue& value) {
  if (value.kind != CaseValue::Kind::table)
    throw Error("{} = {} must be a table such as {{ kind = \"quadratic\", coefficient = 0.1 }}, with kind one of {}",
                key, value.shown(), fmt::join(kind_names(), ", "));
  const auto entry = [&](const std::string& name) -> const CaseValue* {
    for (const auto& [given, inner] : value.entries)
      if (given == name) return &inner;
    return nullptr;
  };
  const CaseValue* given_kind = entry("kind");
  if (given_kind == nullptr)
    throw Error("{} has no kind; write kind = \"…\" with one of {}", key, fmt::join(kind_names(), ", "));
  FrictionSpec spec{.kind = read_name(key + ".kind", *given_kind, kind_names()), .texts = {}};
  const FrictionKind& kind = find_kind(spec.kind);
  std::vector<std::string> allowed = {"kind"};
  for (const FrictionKey& k : kind.keys) allowed.push_back(k.name);
  for (const auto& [name, inner] : value.entries)
    if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
      throw unknown_name(fmt::format("key of a {} friction", spec.kind), name, allowed);
  for (const FrictionKey& k : kind.keys) {
    const CaseValue* given = entry(k.name);
    const std::string name = key + "." + k.name;
    if (given == nullptr && k.default_value.empty())
      throw Error("{} has no {}; a {} friction needs it", key, k.name, spec.kind);
    if (given == nullptr) {
      spec.texts[k.name] = k.default_value;
    } else if (!k.is_formula) {
      const double number = read_number(name, *given);
      if (number < 0 || (k.name == "width" && number == 0))
        throw Error("{} = {} must be {} 0", name, given->shown(), k.name == "width" ? ">" : "≥");
      spec.texts[k.name] = given->text;
    } else {
      if (given->kind != CaseValue::Kind::text && given->kind != CaseValue::Kind::number)
        throw Error("{} = {} must be a formula in quotes, or a number", name, given->shown());
      try {
        compile_formula(given->text, friction_variables());
      } catch (const Error& error) {
        throw Error("{}: {}", name, error.what());
      }
      if (k.name == "coefficient" && !compiles_without(given->text, {"v"}))
        throw Error("{} = {} must not name v: it stands before v already; for other laws write kind = \"formula\"",
                    name, given->shown());
      spec.texts[k.name] = given->text;
    }
  }
  return spec;
}

std::map<std::string, std::string> read_forces(const std::string& key, const CaseValue& value,
                                               const ProblemEntry& problem) {
  std::map<std::string, std::string> forces;
  const auto add = [&](const std::string& name, const std::string& field, const CaseValue& formula) {
    if (formula.kind != CaseValue::Kind::text && formula.kind != CaseValue::Kind::number)
      throw Error("{} = {} must be a formula in t and x, y, z, such as \"0.3*cos(1.2*t)\"", name, formula.shown());
    compile_space_rate(name, formula.text);
    forces[field] = formula.text;
  };
  if (value.kind != CaseValue::Kind::table) {
    add(key, "", value);
    return forces;
  }
  for (const auto& [field, formula] : value.entries) {
    if (std::find(problem.fields.begin(), problem.fields.end(), field) == problem.fields.end())
      throw unknown_name("field in " + key, field, problem.fields);
    add(fmt::format("{}.{}", key, field), field, formula);
  }
  return forces;
}

void add_drives(const DriveSpec& spec, Problem& problem) {
  if (spec.friction) {
    if (!momenta(problem))
      throw Error(
          "problem.friction acts on velocities, and {} has none: its fields are {}, and friction needs q̇ = wp, ṗ = −∂H/∂q",
          problem.name, fmt::join(problem.fields, ", "));
    problem.friction = make_friction(*spec.friction, problem);
  }
  if (spec.forces.empty()) return;
  problem.forces.assign(static_cast<std::size_t>(problem.field_count()), nullptr);
  for (const auto& [field, text] : spec.forces) {
    const auto found = std::find(problem.fields.begin(), problem.fields.end(), field);
    if (!field.empty() && found == problem.fields.end())
      throw unknown_name("field in problem.force", field, problem.fields);
    const auto at = field.empty() ? static_cast<std::size_t>(obvious_field(problem))
                                  : static_cast<std::size_t>(found - problem.fields.begin());
    const std::string key = field.empty() ? "problem.force" : "problem.force." + field;
    problem.forces[at] = compile_space_rate(key, text)->on(problem.grid);
  }
}

std::string write_drives(const DriveSpec& spec) {
  std::string text;
  if (spec.friction) {
    std::vector<std::string> entries = {fmt::format("kind = {}", toml_string(spec.friction->kind))};
    for (const auto& [key, value] : spec.friction->texts)
      entries.push_back(fmt::format("{} = {}", key, literal(value)));
    text += fmt::format("friction = {{ {} }}\n", fmt::join(entries, ", "));
  }
  std::vector<std::string> entries;
  for (const auto& [field, formula] : spec.forces) {
    if (field.empty()) return text + fmt::format("force = {}\n", literal(formula));
    entries.push_back(fmt::format("{} = {}", field, literal(formula)));
  }
  return entries.empty() ? text : text + fmt::format("force = {{ {} }}\n", fmt::join(entries, ", "));
}

std::string example_drives() {
  return "# friction = { kind = \"quadratic\", coefficient = 0.1 }\n"
         "#   on velocities v: quadratic ((linear + coefficient |v|)v), cubic, tanh (with width), dry, isotropic,\n"
         "#   position (coefficient = \"u^2 - 1\", times v), formula (r = \"0.1*v + sinh(v)\", in v, u, t, x, y, z)\n"
         "# force = \"0.3*cos(1.2*t)\"         # on the velocity, a formula in t, x, y, z; or { field = \"…\" }\n";
}

}  // namespace seiche
