// The case file that a subcommand was given, and the notes about it.
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

// What the case and the problem have to say, and a step size that nobody asked for.
std::vector<std::string> notes(const RunSpec& spec, const Problem& problem);

}  // namespace seiche::cli
