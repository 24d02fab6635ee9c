// Mistakes in case files: each is said at its place, with what is allowed.
#include <test/support/case_text.hpp>

#include <seiche/config/case/case_file.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace seiche {
namespace TEST_FILE {

using test::complaint;
using test::error_of;
using test::minimal;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string complaint_of_override(const std::string& override) { return complaint(minimal, {override}); }

TEST(CaseFile, UnknownSectionsAndKeysAreRefusedWithTheNearestName) {
  EXPECT_THAT(complaint(minimal + "[methd]\nname = \"seisav\"\n"),
              AllOf(StartsWith("x.toml:3:"), HasSubstr("unknown section 'methd'; did you mean 'method'?"),
                    HasSubstr("problem, method, backend, time, output")));
  EXPECT_THAT(complaint(minimal + "[method]\nC = 1\nauxilary = \"frozen\"\n"),
              AllOf(StartsWith("x.toml:5:1: "), HasSubstr("'auxilary'; did you mean 'auxiliary'?"),
                    HasSubstr(
                        "Allowed: name, h, tolerance, h_max, C, auxiliary, scalar_solver, predictor, law, linear")));
  EXPECT_THAT(complaint(minimal + "kapa = 1\n"), AllOf(StartsWith("x.toml:3:1: "), HasSubstr("did you mean 'kappa'?")));
  EXPECT_THAT(complaint("h = 1\n" + minimal), HasSubstr("x.toml:1:1: the key 'h' stands outside every section; it "
                                                        "belongs into [method]"));
  EXPECT_THAT(complaint("method = \"seisav\"\n" + minimal), HasSubstr("method must be a section, [method]"));
  EXPECT_THAT(complaint(minimal + "[[time]]\nend = 1\n"), HasSubstr("time must be a section, [time]"));
}

TEST(CaseFile, AMistakeOfABackendIsNotBlamedOnWhatStandsBeforeIt) {
  EXPECT_THAT(complaint("[output]\nenergy_every = 1\n[checkpoint]\nkeep = 1\n" + minimal +
                        "[backend]\npade_degree = 99\n"),
              AllOf(StartsWith("x.toml:8:15: "), HasSubstr("pade_degree = 99 must be between 1 and 12")));
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

TEST(CaseFile, ARunStartsAtZeroOrLaterAndEndsBehindItsStart) {
  EXPECT_THAT(complaint(minimal + "[time]\nstart = -1\n"), HasSubstr("time.start = -1 must be ≥ 0"));
  EXPECT_THAT(complaint(minimal + "[time]\nstart = 3\nend = 2\n"), HasSubstr("time.end = 2 must be > time.start = 3"));
  EXPECT_THAT(complaint(minimal + "[method]\nh = 2\n[time]\nstart = 3\nend = 4\n"),
              HasSubstr("method.h = 2 must be ≤ 1, the time from time.start to time.end"));
  EXPECT_THAT(complaint(minimal + "gamma = \"sqrt(2.5 - t)\"\n[time]\nstart = 3\nend = 4\n"), HasSubstr("at t = 3"));
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

TEST(CaseFile, WhatStandsElsewhereIsSaidWithItsPlace) {
  const auto method = [](const std::string& name) { return complaint_of_override("method.name=" + name); };
  EXPECT_THAT(method("rk4"), HasSubstr("unknown method 'rk4'; in its place there is 'egc4', of order 4. Allowed: avf"));
  EXPECT_THAT(method("Velocity-Verlet"), HasSubstr("in its place there is 'strang_exact', of order 2"));
  EXPECT_THAT(method("seisv"), HasSubstr("did you mean 'seisav'?"));
  EXPECT_THAT(complaint(minimal + "gamma = \"0.1*u\"\n"),
              HasSubstr("damping that depends on fields is problem.friction"));
  EXPECT_THAT(complaint(minimal + "damping = 0.1\n"), HasSubstr("did you mean 'gamma'?"));
  EXPECT_THAT(complaint(minimal + "H = \"u^4\"\n"),
              HasSubstr("is given; one of your own is written with name = \"custom\""));
  EXPECT_THAT(complaint(minimal + "h = 0.1\n"), HasSubstr("did you mean 'h' in [method]?"));
  EXPECT_THAT(complaint(minimal + "v = \"0\"\n"),
              HasSubstr("v is a field, whose values at the start stand in initial = { v = … }"));
  EXPECT_THAT(complaint(minimal + "[backend]\nthreads = 2\n"), HasSubstr("stands on the command line: --threads 2"));
  EXPECT_THAT(complaint(minimal + "initial = [1, \"x\"]\n"), HasSubstr("name the fields, { u = 1, v = \"x\" }"));
  EXPECT_THAT(complaint(minimal + "boundary = \"free\"\n"), HasSubstr("did you mean 'neumann'? Allowed"));
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

TEST(CaseFile, ParametersThatDoNotFitTogetherNameTheCase) {
  const RunSpec spec =
      parse_case("[problem]\nname = \"alpha_fpu\"\nformulation = \"dissipative\"\ngamma = \"exp(-t)\"\n", "x.toml");
  EXPECT_THAT(error_of([&] { make_problem(spec); }), AllOf(StartsWith("x.toml: "), HasSubstr("conservative")));
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
  EXPECT_THAT(meant("time", "t_end"), HasSubstr("did you mean 'end'? Allowed: start, end"));
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

}  // namespace TEST_FILE
}  // namespace seiche
