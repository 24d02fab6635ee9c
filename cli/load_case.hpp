// The case file that a subcommand was given.
#pragma once

#include <CLI/CLI.hpp>
#include <seiche/config/case/run_spec.hpp>

#include <string>
#include <vector>

namespace seiche::cli {

struct CaseArgument {
  std::string file;  // "-" is standard input
  std::vector<std::string> overrides;
};

void add_case(CLI::App& command, CaseArgument& argument);  // CASE and --set
// `methods`, if any, are what will run instead of the method of the case.
RunSpec load_case(const CaseArgument& argument, const std::vector<std::string>& methods = {});

}  // namespace seiche::cli
