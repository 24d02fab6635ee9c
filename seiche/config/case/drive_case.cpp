#include <seiche/config/case/case_parameters.hpp>
#include <seiche/config/case/drive_case.hpp>
#include <seiche/config/case/friction_kinds.hpp>
#include <seiche/config/case/friction_names.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/momenta.hpp>
#include <seiche/core/text/axis_names.hpp>
#include <seiche/damping/formula_frictions.hpp>
#include <seiche/damping/frictions.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>

#include <fmt/ranges.h>

#include <algorithm>

namespace seiche {
namespace {

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const FrictionKind& kind : friction_kinds()) names.push_back(kind.name);
  return names;
}

const FrictionKind& find_kind(const std::string& name) {
  return *std::find_if(friction_kinds().begin(), friction_kinds().end(),
                       [&](const FrictionKind& kind) { return kind.name == name; });
}

double constant(const std::string& text, const FormulaConstants& constants) {
  return (*compile_formula(text, {}, constants))(std::span<const double>());
}

// True if the formula names one of these variables of friction; a parameter of the same name does not count.
bool names_one_of(const std::string& text, const std::vector<std::string>& names, const FormulaConstants& constants) {
  const std::vector<std::string> variables = friction_variables();
  const FormulaProgram program = parse_formula(text, variables, constants).program;
  return names_variable(program, [&](std::size_t variable) {
    return std::find(names.begin(), names.end(), variables[variable]) != names.end();
  });
}

FrictionFormula friction_formula(const std::string& text, const Grid& grid, const FormulaConstants& constants) {
  for (std::size_t a = static_cast<std::size_t>(grid.dimension()); a < axis_names.size(); ++a)
    if (names_one_of(text, {axis_names[a]}, constants))
      throw Error("problem.friction: {} names {}, but {}", text, axis_names[a],
                  grid.only_numbers ? std::string("there are no such places")
                                    : "the grid has " + counted_axes(grid.dimension()));
  return {.formula = compile_formula(text, friction_variables(), constants),
          .uses_u = names_one_of(text, {"u"}, constants),
          .uses_t = names_one_of(text, {"t"}, constants),
          .uses_place = names_one_of(text, {"x", "y", "z"}, constants)};
}

FrictionPointer make_friction(const FrictionSpec& spec, const Problem& problem, double inverse_mass,
                              const FormulaConstants& constants) {
  const auto number = [&](const char* key) { return constant(spec.texts.at(key), constants); };
  const auto formula = [&](const char* key) {
    return friction_formula(in_velocity_and_coordinate(spec.texts.at(key), problem.fields, inverse_mass), problem.grid,
                            constants);
  };
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

// Without quotes where it is a number that reads back as the same text: not -0, 0.10 or 1e3.
std::string literal(const std::string& text) {
  const bool is_plain = is_toml_number(text) && fmt::format("{}", std::stod(text)) == text && text != "-0";
  return is_plain ? text : toml_string(text);
}

// A number, which a text may give by names of parameters.
double named_number(const std::string& key, const CaseValue& value, const FormulaConstants& constants) {
  try {
    return constant(value.text, constants);
  } catch (const Error& error) {
    throw Error("{}: {}", key, error.what());
  }
}

void check_formula_in_time(const std::string& key, const std::string& text, const FormulaConstants& constants,
                           const NameAdvice& advice) {
  try {
    compile_formula(text, {"t"}, constants, advice);
  } catch (const Error& error) {
    throw Error("{}: {}", key, error.what());
  }
}

}  // namespace

FrictionSpec read_friction(const std::string& key, const CaseValue& value, const FormulaContext& context,
                           const FormulaConstants& constants) {
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
      const double number =
          given->kind == CaseValue::Kind::text ? named_number(name, *given, constants) : read_number(name, *given);
      if (number < 0 || (k.is_positive && number == 0))
        throw Error("{} = {} must be {} 0", name, given->shown(), k.is_positive ? ">" : "≥");
      spec.texts[k.name] = given->text;
    } else {
      if (given->kind != CaseValue::Kind::text && given->kind != CaseValue::Kind::number)
        throw Error("{} = {} must be a formula in quotes, or a number", name, given->shown());
      try {
        check_friction_names(given->text, context.fields, constants, context.axes > 0, advice_in(context));
      } catch (const Error& error) {
        throw Error("{}: {}", name, error.what());
      }
      if (k.name == "coefficient" &&
          names_one_of(in_velocity_and_coordinate(given->text, context.fields, 1), {"v"}, constants))
        throw Error("{} = {} must not name v: it stands before v already; for other laws write kind = \"formula\"",
                    name, given->shown());
      spec.texts[k.name] = given->text;
    }
  }
  return spec;
}

std::map<std::string, std::string> read_forces(const std::string& key, const CaseValue& value,
                                               const FormulaContext& context, const FormulaConstants& constants) {
  std::map<std::string, std::string> forces;
  const NameAdvice advice = advice_in(context);
  const auto add = [&](const std::string& name, const std::string& field, const CaseValue& formula) {
    if (formula.kind != CaseValue::Kind::text && formula.kind != CaseValue::Kind::number)
      throw Error("{} = {} must be a formula in t and x, y, z, such as \"0.3*cos(1.2*t)\"", name, formula.shown());
    if (context.axes > 0) {
      compile_space_rate(name, formula.text, constants, advice);
    } else {
      check_formula_in_time(name, formula.text, constants, advice);
    }
    forces[field] = formula.text;
  };
  if (value.kind != CaseValue::Kind::table) {
    add(key, "", value);
    return forces;
  }
  for (const auto& [field, formula] : value.entries) {
    if (std::find(context.fields.begin(), context.fields.end(), field) == context.fields.end())
      throw unknown_name("field in " + key, field, context.fields);
    add(fmt::format("{}.{}", key, field), field, formula);
  }
  return forces;
}

void add_drives(const DriveSpec& spec, Problem& problem, const FormulaConstants& constants) {
  if (spec.friction) {
    const std::optional<Momenta> pairs = momenta(problem);
    if (!pairs)
      throw Error(
          "problem.friction acts on velocities, and {} has none: its fields are {}, and friction needs q̇ = wp, ṗ = −∂H/∂q",
          problem.name, fmt::join(problem.fields, ", "));
    problem.friction = make_friction(*spec.friction, problem, pairs->inverse_mass, constants);
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
    const SpaceRatePointer force = compile_space_rate(key, text, constants);
    try {
      problem.forces[at] = force->on(problem.grid);
    } catch (const Error& error) {
      throw Error("{}: {}", key, error.what());
    }
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
         "#   position (coefficient = \"u^2 - 1\", times v), formula (r = \"0.1*v + sinh(v)\", in v, u, t, x, y, z);\n"
         "#   where there is one coordinate q with its momentum p, they may be named so\n"
         "# force = \"0.3*cos(1.2*t)\"         # on the velocity, a formula in t, x, y, z; or { v = \"…\" }\n";
}

}  // namespace seiche
