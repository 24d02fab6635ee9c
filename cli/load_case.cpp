#include "load_case.hpp"

#include <seiche/config/case/case_file.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/core/text/toml_depth.hpp>

#include <iostream>

namespace seiche::cli {

void add_case(CLI::App& command, CaseArgument& argument) {
  command.add_option("CASE", argument.file, "Case file in TOML; - reads standard input")->required();
  command.add_option("--set", argument.overrides, "Override a key of the case: method.h=1/64")
      ->type_name("KEY=VALUE ...")
      ->allow_extra_args(false);
}

RunSpec load_case(const CaseArgument& argument, const std::vector<std::string>& methods) {
  RunSpec spec;
  if (argument.file != "-") {
    spec = read_case(argument.file, argument.overrides, methods);
  } else {
    spec = parse_case(text_up_to(std::cin, largest_case), "standard input", argument.overrides, {}, methods);
  }
  if (methods.empty()) settle_method(spec);
  return spec;
}

}  // namespace seiche::cli
