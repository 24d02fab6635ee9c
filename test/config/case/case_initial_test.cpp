// Initial states of case files: formulas, and files beside them.
#include <test/support/case_text.hpp>
#include <test/support/temporary_directory.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/config/data/initial_file.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using test::complaint;
using test::error_of;
using test::minimal;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class CaseFolder : public test::InTemporaryDirectory {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(directory / name, std::ios::binary) << text;
    return directory / name;
  }
  // The problem of a case whose z₀ is in a file.
  Problem duffing_from(const std::string& numbers) const {
    write("z0.txt", numbers);
    const fs::path file = write("case.toml",
                                "[problem]\nname = \"oscillator\"\npoints = 2\n"
                                "initial = { file = \"z0.txt\" }\n");
    return make_problem(read_case(file));
  }
  std::string complaint_about(const std::string& numbers) const {
    return error_of([&] { duffing_from(numbers); });
  }
};

TEST(CaseFile, FormulasGiveTheInitialData) {
  const RunSpec spec =
      parse_case(minimal + "initial = { u = \"tanh(sqrt(2)*x)/sqrt(5) + alpha\", v = \"j/points\" }\n", "x.toml");
  const Problem problem = make_problem(spec);
  ASSERT_EQ(problem.initial.size(), 40);
  for (Index i = 0; i < 20; ++i) {
    const double x = static_cast<double>(i + 1) / 10;
    EXPECT_NEAR(problem.initial[i], std::tanh(std::sqrt(2.0) * x) / std::sqrt(5.0) - 1, 1e-15);
    EXPECT_NEAR(problem.initial[20 + i], static_cast<double>(i + 1) / 20, 1e-15);
  }
}

TEST(CaseFile, FormulasOfTheInitialDataAreChecked) {
  EXPECT_THAT(complaint(minimal + "initial = { u = \"sin(x\", v = \"0\" }\n"),
              AllOf(StartsWith("x.toml:3:11: problem.initial.u: formula, column 4"), HasSubstr("not closed")));
  EXPECT_THAT(complaint(minimal + "initial = { u = \"0\" }\n"), HasSubstr("no formula for the field v"));
  EXPECT_THAT(complaint(minimal + "initial = { u = \"0\", w = \"0\" }\n"), HasSubstr("Allowed: u, v, file"));
  EXPECT_THAT(complaint(minimal + "initial = { u = \"t\", v = \"0\" }\n"), HasSubstr("unknown name 't'"));
  EXPECT_THAT(complaint(minimal + "initial = { u = \"0\", v = true }\n"), HasSubstr("must be a formula in quotes"));
  const RunSpec pole = parse_case(minimal + "initial = { u = \"1/(x - 1)\", v = \"0\" }\n", "x.toml");
  EXPECT_THAT(error_of([&] { make_problem(pole); }),
              AllOf(StartsWith("x.toml:3:11: problem.initial: "), HasSubstr("u = 1/(x - 1) is inf at x = 1 (j = 10)")));
}

TEST_F(CaseFolder, AFileGivesTheInitialData) {
  const Problem problem = duffing_from("1 2.5\n\n -3e-1\t+4\n");
  EXPECT_EQ(problem.initial, (Vector(4) << 1, 2.5, -0.3, 4).finished());
}

TEST_F(CaseFolder, AnInitialFileWithTheWrongCountSaysBothNumbers) {
  EXPECT_THAT(complaint_about("1 2 3"), HasSubstr("holds 3 numbers but the state has 4 (2 fields × 2 unknowns)"));
  EXPECT_THAT(complaint_about("1 2 3 4 5"), HasSubstr("holds 5 numbers but the state has 4"));
  EXPECT_THAT(complaint_about(""), HasSubstr("holds 0 numbers but the state has 4"));
}

TEST_F(CaseFolder, AnInitialFileHoldsFiniteNumbersOnly) {
  for (const char* token : {"nan", "inf", "-inf", "1e999", "1,5", "0x10", "abc", "1.2.3", "--1", "+", "1/2"}) {
    EXPECT_THAT(complaint_about("1 2\n3 " + std::string(token)),
                HasSubstr("z0.txt:2: '" + std::string(token) + "' is not a finite number"))
        << token;
  }
}

TEST_F(CaseFolder, FileNamesStartAtTheCaseFileAndSurviveACopyOfTheCase) {
  write("z0.txt", "1 2");
  const fs::path file = write("case.toml", "[problem]\nname = \"oscillator\"\ninitial = { file = \"z0.txt\" }\n");
  const RunSpec spec = read_case(file);
  EXPECT_TRUE(std::get<FileData>(spec.initial).file.is_absolute());
  const RunSpec copy = parse_case(write_case(spec), "elsewhere.toml");
  EXPECT_EQ(copy.initial, spec.initial);
  EXPECT_EQ(make_problem(copy).initial, make_problem(spec).initial);
  EXPECT_THAT(error_of([&] { read_case(file, {"problem.initial={ file = \"none.txt\" }"}); }),
              HasSubstr("none.txt does not exist"));
  EXPECT_THAT(error_of([&] { read_case(file, {"problem.initial={ file = \"z0.txt\", q = \"1\" }"}); }),
              HasSubstr("either a file or formulas"));
}

TEST_F(CaseFolder, ACaseFileThatCannotBeReadSaysSo) {
  EXPECT_THAT(error_of([&] { read_case(directory / "none.toml"); }), HasSubstr("does not exist"));
  EXPECT_THAT(error_of([&] { read_case(directory); }), HasSubstr("is a folder"));
  const fs::path empty = write("empty.toml", "");
  EXPECT_THAT(error_of([&] { read_case(empty); }), HasSubstr("has no name"));
}

TEST_F(CaseFolder, WhatAFileCannotTellAContinuedRunIsSaid) {
  const auto lost = [](const Problem& problem, const char* method, double start = 0, double written = NAN) {
    Simulation simulation(problem, {.method = method});
    return lost_between_runs(simulation, start, written);
  };
  const Problem constant = duffing_from("1 2 3 4");
  EXPECT_EQ(lost(constant, "egc4"), "");
  EXPECT_THAT(lost(constant, "seisav"), HasSubstr("auxiliary variables of seisav"));
  Problem changing = constant;
  changing.damping.rate = formula_rate(compile_formula("0.1 + 0.05*sin(t)", {"t"}));
  EXPECT_THAT(lost(changing, "egc4"), HasSubstr("those from t = 0 on;"));
  EXPECT_THAT(lost(changing, "egc4", 1, 2.5), HasSubstr("those from t = 1 on, not from [time] start = 2.5,"));
  EXPECT_EQ(lost(changing, "egc4", 2.5, 2.5), "");
  EXPECT_EQ(lost(constant, "egc4", 1, 2.5), "");
}

}  // namespace TEST_FILE
}  // namespace seiche
