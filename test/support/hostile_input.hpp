// Input that is meant to do harm, and what is said of it.
#pragma once

#include <test/support/program.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace seiche::test {

inline const std::string market = "%%MatrixMarket matrix coordinate real general\n";

inline std::string repeated(std::string_view text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

class HostileInput : public Cli {
 protected:
  static constexpr int deep = 40'000;

  // A line of at most 400 bytes, and no other.
  void expect_one_line(const std::string& said, const std::string& what) const {
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << what << "\n" << said.substr(0, 2000);
    EXPECT_LE(said.size(), 400U) << what << "\n" << said.substr(0, 2000);
    using testing::AllOf;
    using testing::HasSubstr;
    using testing::Not;
    EXPECT_THAT(said,
                AllOf(Not(HasSubstr("exception")), Not(HasSubstr("filesystem error")), Not(HasSubstr("TOML_MAX"))))
        << what;
  }
  std::string refused_in_a_line(const std::string& arguments) const {
    std::string said = refused(arguments);
    expect_one_line(said, arguments);
    return said;
  }
  // The same of a case that is this text.
  std::string refused_case(const std::string& text, const std::string& arguments = "") const {
    write("hostile.toml", text);
    return refused_in_a_line("run hostile.toml --out out " + arguments);
  }
  void write_matrices(const std::string& M, const std::string& S = "") const {
    write("M.mtx", M);
    if (!S.empty()) write("S.mtx", S);
    write("case.toml", std::string("[problem]\nname = \"sparse\"\nM = \"M.mtx\"\n") +
                           (S.empty() ? "" : "S = \"S.mtx\"\n") + "[time]\nend = 0.125\n");
  }
};

}  // namespace seiche::test
