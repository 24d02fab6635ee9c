// What [problem] says: parameters against the problem's own list, and initial data.
#pragma once

#include <seiche/config/case/run_spec.hpp>
#include <seiche/config/data/case_value.hpp>
#include <seiche/config/data/matrix_market.hpp>
#include <seiche/formula/formula_parser.hpp>
#include <seiche/problem/problems.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace seiche {

// A rate needs spec.t_start and t_end, between which it must be finite and within its bounds, and the other parameters,
// which its formula may name. A relative file name starts at `folder`, or else at the current one.
void set_parameter(RunSpec& spec, const Parameter& parameter, const CaseValue& value,
                   const std::filesystem::path& folder = {});

// Of a parameter that is a matrix, before its entries are read; nothing where it names no file.
std::optional<MatrixSizes> matrix_sizes(const std::string& key, const CaseValue& value,
                                        const std::filesystem::path& folder);

// Once more all rates that are formulas: after other parameters have changed, which these may name.
void renew_rates(RunSpec& spec);

// What formulas of [problem] are told about names that they do not know. Needs the parameters.
FormulaContext formula_context(const RunSpec& spec, FormulaContext::Kind kind);

// A preset, { file = "…" }, or a formula for every field. A relative file name starts at `folder`, or else at the
// current one.
InitialData read_initial(std::string_view key, const CaseValue& value, const RunSpec& spec,
                         const std::filesystem::path& folder);

// { file = "…" } alone, whose file must exist.
FileData read_initial_file_name(const std::string& key, const CaseValue& name, const std::filesystem::path& folder);

}  // namespace seiche
