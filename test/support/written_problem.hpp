// Problems as a user writes them into a case file.
#pragma once

#include <test/support/error_of.hpp>

#include <seiche/config/case/case_file.hpp>

#include <string>
#include <vector>

namespace seiche::test {

inline RunSpec read(const std::string& problem, const std::vector<std::string>& overrides = {}) {
  return parse_case("[problem]\nname = \"custom\"\n" + problem + "\n[time]\nend = 10\n", "x.toml", overrides);
}

inline std::string complaint_of_problem(const std::string& problem) {
  return error_of([&] { make_problem(read(problem)); });
}

}  // namespace seiche::test
