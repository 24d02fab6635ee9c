// What [problem] says beside the parameters of the equation: friction beyond linear, and external forces.
#pragma once

#include <seiche/config/data/case_value.hpp>
#include <seiche/core/problem.hpp>
#include <seiche/core/text/name_advice.hpp>
#include <seiche/formula/formula_parser.hpp>
#include <seiche/problem/problems.hpp>

#include <map>
#include <optional>
#include <string>

namespace seiche {

struct FrictionSpec {
  std::string kind;                          // "quadratic"
  std::map<std::string, std::string> texts;  // key → number or formula, as written
  bool operator==(const FrictionSpec&) const = default;
};

struct DriveSpec {
  std::optional<FrictionSpec> friction;
  std::map<std::string, std::string>
      forces;  // field → formula in t and place; "" for the one field there is no doubt about
  bool operator==(const DriveSpec&) const = default;
};

// { kind = "…", … }. Formulas may name `constants`, and the fields of the problem where these are one coordinate and
// its momentum; `context` is for what is said of other names. Throws Error with a sentence that names the key, the
// value and what is allowed.
FrictionSpec read_friction(const std::string& key, const CaseValue& value, const FormulaContext& context,
                           const FormulaConstants& constants);
// A formula or number, or one for each of some fields.
std::map<std::string, std::string> read_forces(const std::string& key, const CaseValue& value,
                                               const FormulaContext& context, const FormulaConstants& constants);

// Adds them to a problem. Throws Error where the problem has no velocities, or a formula names an axis that is not
// there.
void add_drives(const DriveSpec& spec, Problem& problem, const FormulaConstants& constants);

std::string write_drives(const DriveSpec& spec);  // the lines of [problem], "" for none
std::string example_drives();                     // the same as comments, with all that may be written

}  // namespace seiche
