// Case files: what is right is read, what is wrong is refused with its place and what would be right.
#include "support/error_of.hpp"
#include "support/temporary_directory.hpp"

#include <seiche/config/case_file.hpp>
#include <seiche/problem/problems.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

namespace seiche {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using Overrides = std::vector<std::string>;

const std::string minimal = "[problem]\nname = \"klein_gordon\"\n";

std::string complaint(const std::string& text, const Overrides& overrides = {}) {
  return error_of([&] { parse_case(text, "x.toml", overrides); });
}
std::string complaint_of_override(const std::string& override) { return complaint(minimal, {override}); }

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

TEST(CaseFile, MissingKeysTakeTheirDefaults) {
  for (const ProblemEntry& entry : problems()) {
    const RunSpec spec = parse_case("[problem]\nname = \"" + entry.name + "\"\n", "x.toml");
    EXPECT_EQ(spec.problem, entry.name);
    EXPECT_EQ(std::get<PresetData>(spec.initial).name, entry.presets.front());
    EXPECT_EQ(spec.method, entry.default_method);
    EXPECT_GT(spec.h, 0.0);
    EXPECT_EQ(spec.t_end, entry.default_end);
    EXPECT_FALSE(spec.method_options.C);
    EXPECT_EQ(spec.method_options.auxiliary, AuxiliaryMode::transport);
    EXPECT_EQ(spec.method_options.scalar_solver, ScalarSolver::robust);
    EXPECT_EQ(spec.backend, "auto");
    EXPECT_FALSE(spec.measure_plans);
    EXPECT_EQ(spec.output_directory, "out/" + entry.name);
    EXPECT_EQ(spec.energy_every, 1);
    EXPECT_EQ(spec.snapshot_every, 64);
    EXPECT_TRUE(spec.notes.empty()) << spec.notes.front();
    EXPECT_EQ(spec.parameter_texts.size(), entry.parameters.size());
  }
}

TEST(CaseFile, EveryKeyIsRead) {
  const RunSpec spec = parse_case(R"toml([problem]
name = "klein_gordon"
length = "2*pi"
points = 40
kappa = 1
omega_squared = "1/3"
alpha = 2.5e-1
gamma = "0.4 + 0.2*sin(t)"
initial = { u = "sin(x)", v = 0 }
[method]
name = "seilm"
h = "1/64"
auxiliary = "frozen"
scalar_solver = "newton"
[backend]
name = "dense"
plan = "measure"
[time]
end = 2
[output]
directory = "out/there"
energy_every = 3
snapshot_every = 0
)toml",
                                  "x.toml");
  EXPECT_EQ(spec.parameters.reals("length"), std::vector<double>{2 * std::numbers::pi});
  EXPECT_EQ(spec.parameters.integers("points"), std::vector<long>{40});
  EXPECT_EQ(spec.parameters.real("kappa"), 1.0);
  EXPECT_EQ(spec.parameters.real("omega_squared"), 1.0 / 3);
  EXPECT_EQ(spec.parameters.real("alpha"), 0.25);
  EXPECT_NEAR(spec.parameters.rate("gamma")->value(1.0), 0.4 + 0.2 * std::sin(1.0), 1e-16);
  EXPECT_EQ(std::get<FormulaData>(spec.initial).formulas.at("v"), "0");
  EXPECT_EQ(spec.method, "seilm");
  EXPECT_EQ(spec.h, 1.0 / 64);
  EXPECT_EQ(spec.method_options.auxiliary, AuxiliaryMode::frozen);
  EXPECT_EQ(spec.method_options.scalar_solver, ScalarSolver::newton);
  EXPECT_EQ(spec.backend, "dense");
  EXPECT_TRUE(spec.measure_plans);
  EXPECT_EQ(spec.t_end, 2.0);
  EXPECT_EQ(spec.output_directory, "out/there");
  EXPECT_EQ(spec.energy_every, 3);
  EXPECT_EQ(spec.snapshot_every, 0);
  EXPECT_EQ(write_case(parse_case(write_case(spec), "again.toml")), write_case(spec));
}

TEST(CaseFile, CIsAutoOrANumber) {
  EXPECT_EQ(parse_case(minimal, "x.toml", {"method.C=1/2"}).method_options.C, 0.5);
  EXPECT_EQ(parse_case(minimal, "x.toml", {"method.C=-3"}).method_options.C, -3.0);
  EXPECT_EQ(parse_case(minimal, "x.toml", {"method.C=auto"}).method_options.C, std::nullopt);
  EXPECT_THAT(complaint_of_override("method.C=true"), HasSubstr("method.C = true must be a number or \"auto\""));
  EXPECT_THAT(complaint_of_override("method.C=inf"), HasSubstr("must be a finite number"));
}

TEST(CaseFile, WhatIsWrittenIsReadBackAsTheSameCase) {
  const std::vector<Overrides> variations = {
      {},
      {"method.h=0.3"},
      {"method.h=1e-5", "time.end=1e-3"},
      {"problem.gamma=0.1 + 0.05*sin(t)", "method.C=0.7"},
      {"problem.initial={ u = \"sin(pi*x/length)\", v = \"0\" }"},
      {"output.directory=a \"quoted\" \\ name", "output.snapshot_every=0"},
      {"method.name=ssav", "method.auxiliary=refresh", "problem.kappa=1/3"},
      {"method.name=crkn4", "method.law=guard", "method.linear=explicit"},
      {"method.name=egc6", "method.law=none"},
      {"backend.name=modal", "backend.plan=measure"},
  };
  for (const Overrides& overrides : variations) {
    const RunSpec spec = parse_case(minimal, "x.toml", overrides);
    const RunSpec again = parse_case(write_case(spec), "again.toml");
    EXPECT_EQ(again.problem, spec.problem);
    EXPECT_EQ(again.parameter_texts, spec.parameter_texts);
    EXPECT_EQ(again.parameters.real("kappa"), spec.parameters.real("kappa"));
    EXPECT_EQ(again.parameters.rate("gamma")->value(1.3), spec.parameters.rate("gamma")->value(1.3));
    EXPECT_EQ(again.initial, spec.initial);
    EXPECT_EQ(again.method, spec.method);
    EXPECT_EQ(again.h, spec.h);
    EXPECT_EQ(again.method_options.C, spec.method_options.C);
    EXPECT_EQ(again.method_options.auxiliary, spec.method_options.auxiliary);
    EXPECT_EQ(again.method_options.scalar_solver, spec.method_options.scalar_solver);
    const MethodEntry& method = find_method(spec.method);
    EXPECT_EQ(again.method_options.law_of(method), spec.method_options.law_of(method));
    EXPECT_EQ(again.method_options.linear, spec.method_options.linear);
    EXPECT_EQ(again.backend, spec.backend);
    EXPECT_EQ(again.measure_plans, spec.measure_plans);
    EXPECT_EQ(again.t_end, spec.t_end);
    EXPECT_EQ(again.output_directory, spec.output_directory);
    EXPECT_EQ(again.energy_every, spec.energy_every);
    EXPECT_EQ(again.snapshot_every, spec.snapshot_every);
    EXPECT_EQ(again.notes, spec.notes);
  }
}

TEST(CaseFile, ExampleSaysTheDefaultsAndTheMeanings) {
  for (const ProblemEntry& entry : problems()) {
    const std::string example = example_case(entry.name);
    const std::string defaults = "[problem]\nname = \"" + entry.name + "\"\n";
    EXPECT_EQ(write_case(parse_case(example, "new.toml")), write_case(parse_case(defaults, "x.toml")));
    for (const Parameter& parameter : entry.parameters) EXPECT_THAT(example, HasSubstr(parameter.meaning));
  }
  EXPECT_THAT(error_of([] { example_case("klein_gorden"); }), HasSubstr("did you mean 'klein_gordon'?"));
}

TEST(CaseFile, ShippedCasesAreReadAndMake) {
  int count = 0;
  for (const auto& file : fs::directory_iterator(fs::path(SEICHE_SOURCE_DIR) / "cases")) {
    if (file.path().extension() != ".toml") continue;
    const RunSpec spec = read_case(file.path());
    EXPECT_EQ(spec.output_directory, "out/" + file.path().stem().string());
    EXPECT_TRUE(spec.notes.empty()) << file.path();
    EXPECT_TRUE(make_problem(spec).initial.allFinite()) << file.path();
    ++count;
  }
  EXPECT_GE(count, 7);
}

TEST(CaseFile, UnknownSectionsAndKeysAreRefusedWithTheNearestName) {
  EXPECT_THAT(complaint(minimal + "[methd]\nname = \"seisav\"\n"),
              AllOf(StartsWith("x.toml:3:"), HasSubstr("unknown section 'methd'; did you mean 'method'?"),
                    HasSubstr("problem, method, backend, time, output")));
  EXPECT_THAT(complaint(minimal + "[method]\nC = 1\nauxilary = \"frozen\"\n"),
              AllOf(StartsWith("x.toml:5:1: "), HasSubstr("'auxilary'; did you mean 'auxiliary'?"),
                    HasSubstr("Allowed: name, h, tolerance, h_max, C, auxiliary, scalar_solver, law, linear")));
  EXPECT_THAT(complaint(minimal + "kapa = 1\n"), AllOf(StartsWith("x.toml:3:1: "), HasSubstr("did you mean 'kappa'?")));
  EXPECT_THAT(complaint("h = 1\n" + minimal), HasSubstr("x.toml:1:1: the key 'h' stands outside every section; it "
                                                        "belongs into [method]"));
  EXPECT_THAT(complaint("method = \"seisav\"\n" + minimal), HasSubstr("method must be a section, [method]"));
  EXPECT_THAT(complaint(minimal + "[[time]]\nend = 1\n"), HasSubstr("time must be a section, [time]"));
}

TEST(CaseFile, MisspeltNamesAreRefusedWithTheNearestOne) {
  EXPECT_THAT(complaint(minimal + "[method]\nname = \"seisv\"\n"),
              StartsWith("x.toml:4:8: unknown method 'seisv'; did you mean 'seisav'? Allowed: avf, sav, lm"));
  EXPECT_THAT(complaint("[problem]\nname = \"gkvd\"\n"), HasSubstr("did you mean 'gkdv'?"));
  EXPECT_THAT(complaint(minimal + "[backend]\nname = \"modl\"\n"), HasSubstr("did you mean 'modal'?"));
  EXPECT_THAT(complaint(minimal + "[backend]\nplan = \"mesure\"\n"), HasSubstr("did you mean 'measure'?"));
  EXPECT_THAT(complaint(minimal + "initial = \"papr\"\n"), HasSubstr("did you mean 'paper'?"));
  EXPECT_THAT(complaint("[problem]\nname = \"alpha_fpu\"\nformulation = \"conservativ\"\n"),
              AllOf(StartsWith("x.toml:3:15: "), HasSubstr("did you mean 'conservative'?")));
}

TEST(CaseFile, ACaseNamesItsProblem) {
  EXPECT_THAT(complaint(""), AllOf(StartsWith("x.toml: "), HasSubstr("[problem] has no name"), HasSubstr("gkdv")));
  EXPECT_THAT(complaint("[problm]\nname = \"gkdv\"\n"), HasSubstr("did you mean 'problem'?"));
}

TEST(CaseFile, TheFirstMistakeInTheSourceIsTheOneReported) {
  // toml++ iterates by the alphabet: alpha before points, method before problem.
  EXPECT_THAT(complaint(minimal + "points = -1\nalpha = \"x\"\n[method]\nh = 0\nC = true\n"), StartsWith("x.toml:3:"));
  EXPECT_THAT(complaint("[time]\nend = -1\n" + minimal + "points = -1\n"), StartsWith("x.toml:2:"));
  EXPECT_THAT(complaint(minimal + "[method]\nname = \"seisv\"\nbad = 1\n"), StartsWith("x.toml:4:"));
  EXPECT_THAT(complaint(minimal + "initial = { v = \"(\", u = \")\" }\n"), HasSubstr("problem.initial.v"));
  EXPECT_THAT(complaint(minimal + "points = -1\n", {"method.h=0"}), StartsWith("x.toml:3:")) << "the file comes first";
}

TEST(CaseFile, ValuesOutOfBoundsAreRefusedWithTheBound) {
  EXPECT_THAT(complaint(minimal + "points = -20\n"), StartsWith("x.toml:3:10: problem.points = -20 must be ≥"));
  EXPECT_THAT(complaint(minimal + "points = 20.5\n"), HasSubstr("problem.points = 20.5 must be a whole number"));
  EXPECT_THAT(complaint(minimal + "points = 1e18\n"), HasSubstr("must be ≤"));
  EXPECT_THAT(complaint(minimal + "length = 0\n"), HasSubstr("problem.length = 0 must be > 0"));
  EXPECT_THAT(complaint_of_override("output.energy_every=0"), HasSubstr("must be ≥ 1"));
  EXPECT_THAT(complaint_of_override("output.snapshot_every=-1"), HasSubstr("must be ≥ 0"));
  EXPECT_THAT(complaint_of_override("time.end=0"), HasSubstr("time.end = 0 must be > 0"));
  EXPECT_EQ(parse_case(minimal + "points = \"40/2\"\n", "x.toml").parameters.integers("points"), std::vector<long>{20});
  EXPECT_EQ(parse_case(minimal + "points = 20.0\n", "x.toml").parameters.integers("points"), std::vector<long>{20});
}

TEST(CaseFile, ValuesOfTheWrongTypeAreNamed) {
  EXPECT_THAT(complaint(minimal + "kappa = true\n"), HasSubstr("problem.kappa = true must be a number"));
  EXPECT_THAT(complaint(minimal + "kappa = [1, 2]\n"), HasSubstr("problem.kappa = a list must be a number"));
  EXPECT_THAT(complaint(minimal + "kappa = \"big\"\n"), HasSubstr("problem.kappa = \"big\" must be a finite number"));
  EXPECT_THAT(complaint(minimal + "gamma = 1979-05-27\n"), HasSubstr("problem.gamma = a date must be a number, or a "
                                                                     "formula in t"));
  EXPECT_THAT(complaint(minimal + "initial = 3\n"), HasSubstr("problem.initial = 3 must be a preset (paper)"));
  EXPECT_THAT(complaint(minimal + "[output]\ndirectory = 3\n"), HasSubstr("output.directory = 3 must be a text"));
  EXPECT_THAT(complaint("[problem]\nname = 3\n"), HasSubstr("problem.name = 3 must be a text"));
}

TEST(CaseFile, NumbersThatAreNotFiniteAreRefused) {
  for (const char* value : {"nan", "inf", "-inf", "\"nan\"", "\"-inf\"", "\"Infinity\""}) {
    EXPECT_THAT(complaint(minimal + "kappa = " + value + "\n"),
                AllOf(StartsWith("x.toml:3:9: problem.kappa = "), HasSubstr("must be a finite number")))
        << value;
  }
  EXPECT_THAT(complaint(minimal + "[method]\nh = \"1/0\"\n"),
              AllOf(StartsWith("x.toml:4:5: method.h = \"1/0\" must be a finite number"),
                    HasSubstr("divides by zero")));
  EXPECT_THAT(complaint_of_override("problem.kappa=1e999"), HasSubstr("too large"));
}

TEST(CaseFile, StepSizeIsPositiveAndWithinTheRun) {
  EXPECT_THAT(complaint(minimal + "[method]\nh = 0\n"), HasSubstr("x.toml:4:5: method.h = 0 must be > 0"));
  EXPECT_THAT(complaint_of_override("method.h=-1/64"), HasSubstr("must be > 0"));
  EXPECT_THAT(complaint_of_override("method.h=51"), HasSubstr("method.h = 51 must be ≤ time.end = 50"));
  EXPECT_THAT(complaint_of_override("method.h=1e-300"), HasSubstr("would take"));
  EXPECT_EQ(parse_case(minimal, "x.toml", {"method.h=50"}).h, 50.0);
}

TEST(CaseFile, AShortRunWithoutStepSizeTakesOneStepAndSaysSo) {
  const RunSpec spec = parse_case(minimal, "x.toml", {"time.end=1e-4"});
  EXPECT_EQ(spec.h, 1e-4);
  EXPECT_EQ(spec.notes.size(), 1U);
}

TEST(CaseFile, RatesAreNumbersOrFormulasInT) {
  EXPECT_TRUE(parse_case(minimal + "gamma = 0.2\n", "x.toml").parameters.rate("gamma")->is_constant());
  EXPECT_EQ(parse_case(minimal + "gamma = \"1/8\"\n", "x.toml").parameters.rate("gamma")->value(0), 0.125);
  EXPECT_FALSE(parse_case(minimal + "gamma = \"exp(-t)\"\n", "x.toml").parameters.rate("gamma")->is_constant());
  EXPECT_THAT(complaint(minimal + "gamma = \"0.1 + * t\"\n"),
              AllOf(StartsWith("x.toml:3:9: problem.gamma: formula, column 7: '*' stands where a value is expected"),
                    HasSubstr("\n  0.1 + * t\n        ^")));
  EXPECT_THAT(complaint(minimal + "gamma = \"0.1*u\"\n"),
              AllOf(StartsWith("x.toml:3:9: problem.gamma: formula, column 5: unknown name 'u'"),
                    HasSubstr("t, x, y, z")));
  EXPECT_THAT(complaint(minimal + "gamma = \"1/t\"\n"),
              HasSubstr("problem.gamma = inf must be a finite number at t = 0"));
  EXPECT_THAT(complaint(minimal + "gamma = \"log(25 - t)\"\n"), HasSubstr("must be a finite number at t = 25"));
  EXPECT_EQ(complaint(minimal + "gamma = \"log(25 - t)\"\n[time]\nend = 20\n"), "");
}

TEST(CaseFile, ARateMayChangeFromPointToPoint) {
  const auto problem_with = [](const std::string& rate, const std::string& more = "") {
    return make_problem(parse_case(minimal + "gamma = \"" + rate + "\"\n" + more, "x.toml"));
  };
  const Problem steady = problem_with("0.1 + x^2");
  ASSERT_TRUE(steady.damping.field_rate);
  EXPECT_FALSE(steady.damping.rate);
  EXPECT_TRUE(steady.damping.field_rate->is_constant());
  std::vector<double> gamma(20);
  steady.damping.field_rate->values(7.0, gamma);
  EXPECT_NEAR(gamma[4], 0.1 + 0.25, 1e-15);
  EXPECT_EQ(steady.damping.field_rate->text(), "0.1 + x^2");
  EXPECT_FALSE(problem_with("exp(-t)*x").damping.field_rate->is_constant());
  EXPECT_TRUE(problem_with("y*x", "points = [4, 4]\n").damping.field_rate->is_constant());
  EXPECT_TRUE(problem_with("0.1*t").damping.rate) << "the same at every point";

  const auto refusal = [&](const std::string& rate, const std::string& more = "") {
    return error_of([&] { problem_with(rate, more); });
  };
  EXPECT_EQ(refusal("x*y"), "x.toml: the rate x*y names y, but the grid has 1 axis");
  EXPECT_EQ(refusal("x*z", "points = [4, 4]\n"), "x.toml: the rate x*z names z, but the grid has 2 axes");
  EXPECT_THAT(refusal("1/(x - 0.5)"),
              HasSubstr("problem.gamma = inf must be a finite number at t = 0 at x = 0.5 (j = 5)"));
  EXPECT_THAT(refusal("x*log(25 - t)"), HasSubstr("must be a finite number at t = 2"));
  EXPECT_EQ(refusal("x*log(25 - t)", "[time]\nend = 20\n"), "");
  EXPECT_THAT(error_of([] {
                make_problem(
                    parse_case("[problem]\nname = \"alpha_fpu\"\nformulation = \"dissipative\"\ngamma = \"x\"\n",
                               "x.toml"));
              }),
              HasSubstr("gamma = x changes from point to point"));
}

TEST(CaseFile, ARateThatChangesFromPointToPointSurvivesWriting) {
  const RunSpec spec = parse_case(minimal + "gamma = \"0.1 + x^2\"\n", "x.toml");
  const RunSpec again = parse_case(write_case(spec), "y.toml");
  EXPECT_EQ(again.parameters.damping_rate("gamma").varying->text(), "0.1 + x^2");
  EXPECT_THAT(error_of([&] { spec.parameters.rate("gamma"); }), HasSubstr("a number or a formula in t"));
}

TEST(CaseFile, MethodOptionsWithoutMeaningAreRefusedAtTheirKey) {
  EXPECT_THAT(complaint(minimal + "[method]\nname = \"seavf\"\nh = 0.1\nauxiliary = \"frozen\"\n"),
              AllOf(StartsWith("x.toml:6:13: "), HasSubstr("seavf")));
  EXPECT_THAT(complaint(minimal + "[method]\nscalar_solver = \"newton\"\n"), HasSubstr("belongs to the lm family"));
  EXPECT_THAT(complaint(minimal + "[method]\nlaw = \"guard\"\n"), HasSubstr("end with a projection"));
  EXPECT_THAT(complaint(minimal + "[method]\nname = \"egc4\"\nlaw = \"gard\"\n"), HasSubstr("did you mean 'guard'"));
  EXPECT_THAT(complaint(minimal + "[method]\nname = \"strang_exact\"\nlaw = \"interval\"\n"),
              HasSubstr("use \"guard\""));
  EXPECT_THAT(complaint(minimal + "[method]\nname = \"egc4\"\nlinear = \"explicit\"\n"), HasSubstr("crkn4"));
  EXPECT_EQ(complaint(minimal + "[method]\nname = \"crkn6\"\nlaw = \"none\"\nlinear = \"explicit\"\n"), "");
  EXPECT_THAT(complaint(minimal + "[method]\nname = \"seilm\"\nC = 1\n"), HasSubstr("C belongs to the sav family"));
  EXPECT_THAT(complaint(minimal + "[method]\nname = \"slm\"\nauxiliary = \"refresh\"\n"), HasSubstr("refresh"));
  EXPECT_EQ(complaint(minimal + "[method]\nname = \"slm\"\nauxiliary = \"frozen\"\n"), "");
}

TEST(CaseFile, MistakesInTheSyntaxHaveAPlace) {
  EXPECT_THAT(complaint(minimal + "kappa = \n"), StartsWith("x.toml:3:"));
  EXPECT_THAT(complaint(minimal + "kappa = 1/3\n"), StartsWith("x.toml:3:"));
  EXPECT_THAT(complaint(minimal + "kappa = 1\nkappa = 2\n"), StartsWith("x.toml:4:"));
  EXPECT_THAT(complaint("[problem\n"), StartsWith("x.toml:1:"));
  EXPECT_THAT(complaint("\xFF\xFE"), StartsWith("x.toml:1:"));
  EXPECT_NE(complaint(minimal + "initial = " + std::string(100000, '[')), "") << "deep input must not crash";
}

TEST(CaseFile, SetOverridesAnyKeyWithTheSameChecks) {
  const RunSpec spec = parse_case(minimal + "kappa = 1\n", "x.toml",
                                  {"problem.kappa=1/4", "method.name=ssav", "method.h = 1/8", "method.h=1/16",
                                   "output.directory=2024-01-01", "problem.gamma=0.1*t"});
  EXPECT_EQ(spec.parameters.real("kappa"), 0.25);
  EXPECT_EQ(spec.method, "ssav");
  EXPECT_EQ(spec.h, 1.0 / 16) << "the last one counts";
  EXPECT_EQ(spec.output_directory, "2024-01-01");
  EXPECT_FALSE(spec.parameters.rate("gamma")->is_constant());
  EXPECT_EQ(complaint(minimal + "points = -1\n", {"problem.points=20"}), "") << "what is replaced is not read";
  EXPECT_EQ(parse_case("", "x.toml", {"problem.name=gkdv"}).problem, "gkdv");

  EXPECT_THAT(complaint_of_override("method.h=0"), StartsWith("--set method.h=0: method.h = 0 must be > 0"));
  EXPECT_THAT(complaint_of_override("method.hh=1"), AllOf(StartsWith("--set method.hh=1: "), HasSubstr("'h'?")));
  EXPECT_THAT(complaint_of_override("metod.h=1"), HasSubstr("did you mean 'method'?"));
  EXPECT_THAT(complaint_of_override("method.name=seisv"), HasSubstr("did you mean 'seisav'?"));
  for (const char* wrong : {"method.h", "h=1", ".h=1", "method.=1", "=1", ""})
    EXPECT_THAT(complaint_of_override(wrong), HasSubstr("write it as section.key=value")) << wrong;
  EXPECT_THAT(complaint_of_override("method.h="), HasSubstr("must be a finite number"));
  EXPECT_NE(complaint_of_override("method.h=1\n[time]\nend = 3"), "") << "one key, one value";
}

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
              AllOf(StartsWith("x.toml: "), HasSubstr("u = 1/(x - 1) is inf at x = 1 (j = 10)")));
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

TEST(CaseFile, ParametersThatDoNotFitTogetherNameTheCase) {
  const RunSpec spec =
      parse_case("[problem]\nname = \"alpha_fpu\"\nformulation = \"dissipative\"\ngamma = \"exp(-t)\"\n", "x.toml");
  EXPECT_THAT(error_of([&] { make_problem(spec); }), AllOf(StartsWith("x.toml: "), HasSubstr("conservative")));
}

TEST(CaseFile, AToleranceStandsInsteadOfAStepSize) {
  const RunSpec spec =
      parse_case(minimal + "[method]\nname = \"egc6\"\ntolerance = 1e-8\n[output]\nsnapshot_interval = 0.5\n",
                 "x.toml");
  EXPECT_EQ(spec.tolerance, 1e-8);
  EXPECT_EQ(spec.h, 0);
  EXPECT_EQ(spec.snapshot_interval, 0.5);
  const RunSpec again = parse_case(write_case(spec), "again.toml");
  EXPECT_EQ(again.tolerance, spec.tolerance);
  EXPECT_EQ(again.h, 0);
  EXPECT_EQ(again.snapshot_interval, 0.5);
  EXPECT_EQ(parse_case(minimal + "[method]\nh = 0.25\ntolerance = 1e-3\n", "x.toml").h, 0.25) << "the first step";

  EXPECT_THAT(complaint(minimal + "[method]\ntolerance = 0\n"), HasSubstr("method.tolerance = 0 must be > 0"));
  EXPECT_THAT(complaint(minimal + "[method]\ntolerance = 2\n"), HasSubstr("< 1"));
  EXPECT_THAT(complaint(minimal + "[method]\ntolerance = 1e-30\n"), HasSubstr("at least 1e-14"));
  EXPECT_THAT(complaint(minimal + "[method]\nh_max = 1\n"), HasSubstr("needs method.tolerance"));
  EXPECT_EQ(parse_case(minimal + "[method]\ntolerance = 1e-3\nh_max = 0.5\n", "x.toml").h_max, 0.5);
}

TEST(CaseFile, AnIntervalBetweenSnapshotsIsCountedInStepsOfOneSize) {
  const auto with = [](const std::string& interval) {
    return minimal + "[method]\nh = 0.1\n[output]\nsnapshot_interval = " + interval + "\n";
  };
  const RunSpec spec = parse_case(with("0.3"), "x.toml");
  EXPECT_EQ(spec.snapshot_every, 3) << "round-off is no difference";
  EXPECT_EQ(spec.snapshot_interval, 0);
  EXPECT_EQ(parse_case(write_case(spec), "again.toml").snapshot_every, 3);
  EXPECT_EQ(parse_case(with("0.3") + "snapshot_every = 64\n", "x.toml").snapshot_every, 3) << "as with a tolerance";
  EXPECT_THAT(complaint(with("0.25")),
              HasSubstr("output.snapshot_interval = 0.25 is no multiple of h = 0.1: write snapshot_every = "));
  EXPECT_THAT(complaint(with("0.01")), HasSubstr("write snapshot_every = 1, for one every 0.1"));
}

TEST(CaseFile, WordsOfOtherProgramsAreTakenByTheirMeaningNotTheirLetters) {
  const auto meant = [](const std::string& section, const std::string& word) {
    return complaint(minimal + "[" + section + "]\n" + word + " = 0.1\n");
  };
  for (const std::string word : {"rtol", "tol", "atol", "rel_tol", "abstol"})
    EXPECT_THAT(meant("method", word),
                AllOf(StartsWith("x.toml:4:1: "), HasSubstr("did you mean 'tolerance'? Allowed: name")));
  for (const std::string word : {"dt", "step", "step_size", "timestep", "first_step"})
    EXPECT_THAT(meant("method", word), HasSubstr("did you mean 'h'? Allowed: name"));
  for (const std::string word : {"max_step", "dt_max", "hmax"})
    EXPECT_THAT(meant("method", word), HasSubstr("did you mean 'h_max'?"));
  EXPECT_THAT(meant("time", "t_end"), HasSubstr("did you mean 'end'? Allowed: end"));
  EXPECT_THAT(meant("method", "tmax"), HasSubstr("did you mean 'end' in [time]?"));
  EXPECT_THAT(complaint("dt = 0.1\n" + minimal), HasSubstr("outside every section; did you mean 'h' in [method]?"));
  EXPECT_THAT(complaint_of_override("method.dt=0.1"), AllOf(StartsWith("--set method.dt=0.1: "), HasSubstr("'h'?")));
  EXPECT_THAT(complaint("[problem]\nname = \"oscillator\"\nboundary_conditions = \"periodic\"\n"),
              testing::Not(HasSubstr("did you mean 'boundary'")))
      << "a key that this problem does not have";
}

TEST(CaseFile, AToleranceThatMakesNoSenseIsSaidBeforeWhatNeedsOne) {
  const std::string about = "method.tolerance = -1 must be > 0";
  EXPECT_THAT(complaint(minimal + "[output]\nsnapshot_interval = 0.5\n[method]\ntolerance = -1\n"), HasSubstr(about));
  EXPECT_THAT(complaint(minimal + "[output]\nsnapshot_interval = 0.5\n", {"method.tolerance=-1"}), HasSubstr(about));
  EXPECT_THAT(complaint(minimal + "[method]\nh_max = 0.5\ntolerance = -1\n"), HasSubstr(about));
}

}  // namespace
}  // namespace seiche
