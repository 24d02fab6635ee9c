// Case files as texts, and what is said of them.
#pragma once

#include <test/support/error_of.hpp>

#include <seiche/config/case/case_file.hpp>

#include <string>
#include <vector>

namespace seiche::test {

using Overrides = std::vector<std::string>;

inline const std::string minimal = "[problem]\nname = \"klein_gordon\"\n";

inline std::string complaint(const std::string& text, const Overrides& overrides = {}) {
  return error_of([&] { parse_case(text, "x.toml", overrides); });
}

}  // namespace seiche::test
