// Case files: what is right is read, what is wrong is refused with its place and what would be right.
#include <test/support/case_text.hpp>
#include <test/support/paths.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/problem/problems.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using test::complaint;
using test::error_of;
using test::minimal;
using test::Overrides;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

std::string complaint_of_override(const std::string& override) { return complaint(minimal, {override}); }

TEST(CaseFile, MissingKeysTakeTheirDefaults) {
  for (const ProblemEntry& entry : problems()) {
    const RunSpec spec = parse_case("[problem]\nname = \"" + entry.name + "\"\n", "x.toml");
    EXPECT_EQ(spec.problem, entry.name);
    EXPECT_EQ(std::get<PresetData>(spec.initial).name, entry.presets.front());
    EXPECT_EQ(spec.method, entry.default_method);
    EXPECT_GT(spec.h, 0.0);
    EXPECT_EQ(spec.t_end, entry.default_end);
    EXPECT_FALSE(spec.method_options.C);
    EXPECT_EQ(spec.method_options.auxiliary, AuxiliaryMode::automatic);
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

TEST(CaseFile, FormulasNameTheSpacingOfTheGrid) {
  for (const ProblemEntry& entry : problems()) {
    const RunSpec spec = parse_case("[problem]\nname = \"" + entry.name + "\"\n", "x.toml");
    const FormulaConstants constants = formula_constants(spec);
    if (!constants.contains("length")) continue;
    const Grid grid = make_problem(spec).grid;
    EXPECT_EQ(constants.at("dx"), grid.axis(0).dx()) << entry.name;
    EXPECT_EQ(constants.at("points"), grid.axis(0).intervals) << entry.name;
    EXPECT_EQ(constants.at("length"), grid.axis(0).length) << entry.name;
  }
}

TEST(CaseFile, WhatIsFoundWhileTheProblemIsMadeIsSaidAtItsKey) {
  const auto made = [](const std::string& lines) {
    return error_of(
        [&] { make_problem(parse_case("[problem]\nname = \"klein_gordon\"\npoints = 8\n" + lines, "x.toml")); });
  };
  EXPECT_THAT(made("gamma = \"1/(x-0.25*length)\""),
              StartsWith("x.toml:4:9: problem.gamma = inf must be a finite number"));
  EXPECT_THAT(made("initial = { u = \"y\", v = 0 }"),
              AllOf(StartsWith("x.toml:4:11: problem.initial.u: "), HasSubstr("the grid has 1 axis")));
  EXPECT_THAT(made("initial = { u = \"1/(x-0.25*length)\", v = 0 }"),
              StartsWith("x.toml:4:11: problem.initial: u = 1/(x-0.25*length) is inf at x = "));
  EXPECT_THAT(made("force = { v = \"y\" }"), StartsWith("x.toml:4:9: problem.force.v"));
}

TEST(CaseFile, TheNumberOfAxesIsThatOfPointsOrLength) {
  const auto made = [](const std::string& lines) {
    return error_of([&] { make_problem(parse_case("[problem]\nname = \"klein_gordon\"\n" + lines, "x.toml")); });
  };
  EXPECT_THAT(made("points = 8\nboundary = [\"periodic\", \"periodic\"]"),
              HasSubstr(
                  "points has 1 entries, length 1 and boundary 2: points and length say how many axes there are"));
  EXPECT_EQ(made("points = [8, 8]\nboundary = [\"periodic\", \"dirichlet\"]"), "");
  EXPECT_EQ(made("length = [2.0, 1.0]\npoints = 8\nboundary = \"dirichlet\""), "");
}

TEST(CaseFile, OtherWordsForTheEndsAreUnderstood) {
  const auto said = [](const std::string& word) { return complaint_of_override("problem.boundary=" + word); };
  EXPECT_THAT(said("absorbing"), HasSubstr("waves are absorbed by damping that grows towards the ends"));
  EXPECT_THAT(said("fixed"), HasSubstr("did you mean 'dirichlet'?"));
  EXPECT_THAT(said("free"), HasSubstr("did you mean 'neumann'?"));
  EXPECT_THAT(said("ring"), HasSubstr("did you mean 'periodic'?"));
  EXPECT_THAT(said("periodc"), AllOf(HasSubstr("did you mean 'periodic'?"), HasSubstr("Allowed: periodic, dirichlet")));
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
join_below = 0.5
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
  EXPECT_EQ(spec.join_below, 0.5);
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
    EXPECT_EQ(again.join_below, spec.join_below);
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

TEST(CaseFile, ShippedCasesAreReadAndMakeTheirProblems) {
  int count = 0;
  for (const auto& file : fs::directory_iterator(fs::path(test::source_directory()) / "cases")) {
    if (file.path().extension() != ".toml") continue;
    const RunSpec spec = read_case(file.path());
    EXPECT_EQ(spec.output_directory, "out/" + file.path().stem().string());
    EXPECT_TRUE(spec.notes.empty()) << file.path();
    EXPECT_TRUE(make_problem(spec).initial.allFinite()) << file.path();
    ++count;
  }
  EXPECT_GE(count, 7);
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
                    HasSubstr("(in \"0.1 + * t\")")));
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
  EXPECT_THAT(refusal("x*y"),
              AllOf(StartsWith("x.toml:3:9: "), EndsWith("the rate x*y names y, but the grid has 1 axis")));
  EXPECT_THAT(refusal("x*z", "points = [4, 4]\n"), EndsWith("the rate x*z names z, but the grid has 2 axes"));
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
  EXPECT_EQ(parse_case(minimal + "[method]\ntolerance = 1e8\n", "x.toml").tolerance, 1e8) << "of fields in SI units";
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
  EXPECT_THAT(complaint(with("0.3") + "snapshot_every = 64\n"), HasSubstr("snapshot_every = 64 are both given"));
  EXPECT_EQ(parse_case(with("0") + "snapshot_every = 64\n", "x.toml").snapshot_every, 64);
  const std::string by_steps = minimal + "[method]\nh = 0.1\n[output]\nsnapshot_every = 64\n";
  EXPECT_EQ(parse_case(by_steps, "x.toml", {"output.snapshot_interval=0.5"}).snapshot_every, 5) << "given for this run";
  EXPECT_EQ(parse_case(with("0.3"), "x.toml", {"output.snapshot_every=7"}).snapshot_every, 7);
  EXPECT_EQ(parse_case(with("0.3"), "x.toml", {"output.snapshot_every=7"}).snapshot_interval, 0);
  const RunSpec adaptive =
      parse_case(minimal + "[method]\ntolerance = 1e-6\n[output]\nsnapshot_interval = 0.3\n", "x.toml");
  EXPECT_THAT(write_case(adaptive), Not(HasSubstr("snapshot_every"))) << "of the two, the one that holds";
  EXPECT_THAT(complaint(with("0.25")),
              HasSubstr("output.snapshot_interval = 0.25 is no multiple of h = 0.1: write snapshot_every = "));
  EXPECT_THAT(complaint(with("0.01")), HasSubstr("write snapshot_every = 1, for one every 0.1"));
}

}  // namespace TEST_FILE
}  // namespace seiche
