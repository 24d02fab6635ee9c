// Friction and forces in case files.
#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace seiche::test {
namespace TEST_FILE {

using testing::HasSubstr;

RunSpec spec_with(const std::string& line, const std::string& problem = "klein_gordon") {
  return parse_case("[problem]\nname = \"" + problem + "\"\n" + line + "\n", "x.toml", {});
}

std::string refusal(const std::string& line, const std::string& problem = "klein_gordon") {
  try {
    make_problem(spec_with(line, problem));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(DriveCase, EveryKindOfFrictionIsReadWrittenAndReadBack) {
  for (const char* friction :
       {"{ kind = \"quadratic\", coefficient = 0.3 }", "{ kind = \"quadratic\", coefficient = 0.3, linear = \"1/3\" }",
        "{ kind = \"cubic\", coefficient = 2 }", "{ kind = \"tanh\", coefficient = 0.5, width = 0.1 }",
        "{ kind = \"dry\", coefficient = 0.1 }", "{ kind = \"isotropic\", coefficient = 0.1 }",
        "{ kind = \"position\", coefficient = \"u^2 - 1\" }", "{ kind = \"formula\", r = \"0.1*sinh(v)*(1 + x)\" }"}) {
    const RunSpec spec = spec_with(std::string("friction = ") + friction);
    const RunSpec again = parse_case(write_case(spec), "y.toml", {});
    EXPECT_EQ(spec.drives, again.drives) << friction;
    const Problem problem = make_problem(again);
    ASSERT_NE(problem.friction, nullptr);
    EXPECT_EQ(problem.friction->text(), make_problem(spec).friction->text());
    const double v = 0.7, u = 0.4;
    double r = 0;
    problem.friction->force(0, {&u, 1}, {&v, 1}, {&r, 1});
    EXPECT_NE(r, 0) << friction;
  }
}

TEST(DriveCase, ForcesGoToTheVelocityOrToTheFieldsThatAreNamed) {
  for (const char* force : {"force = \"0.3*cos(2*t)*x\"", "force = { v = \"0.3*cos(2*t)*x\" }"}) {
    const RunSpec spec = spec_with(force);
    const Problem problem = make_problem(parse_case(write_case(spec), "y.toml", {}));
    ASSERT_EQ(problem.forces.size(), 2U);
    EXPECT_EQ(problem.forces[0], nullptr);
    std::vector<double> f(static_cast<std::size_t>(problem.grid.unknowns()));
    problem.forces[1]->values(0, f);
    EXPECT_DOUBLE_EQ(f[3], 0.3 * problem.grid.coordinate(3, 0));
  }
  EXPECT_NE(make_problem(spec_with("force = 0.2", "gkdv")).forces.at(0), nullptr);  // the only field
}

TEST(DriveCase, FrictionAndForcesThatCannotBeAreRefusedInASentence) {
  EXPECT_THAT(refusal("friction = 0.3"), HasSubstr("problem.friction = 0.3 must be a table"));
  EXPECT_THAT(refusal("friction = { coefficient = 0.3 }"), HasSubstr("has no kind"));
  EXPECT_THAT(refusal("friction = { kind = \"cubik\", coefficient = 0.3 }"), HasSubstr("did you mean 'cubic'?"));
  EXPECT_THAT(refusal("friction = { kind = \"cubic\", coeficient = 0.3 }"), HasSubstr("did you mean 'coefficient'?"));
  EXPECT_THAT(refusal("friction = { kind = \"tanh\", coefficient = 0.3 }"), HasSubstr("has no width"));
  EXPECT_THAT(refusal("friction = { kind = \"tanh\", coefficient = 0.3, width = 0 }"), HasSubstr("must be > 0"));
  EXPECT_THAT(refusal("friction = { kind = \"dry\", coefficient = -1 }"), HasSubstr("must be ≥ 0"));
  EXPECT_THAT(refusal("friction = { kind = \"position\", coefficient = \"v^2\" }"), HasSubstr("must not name v"));
  EXPECT_THAT(refusal("friction = { kind = \"formula\", r = \"0.1*w\" }"), HasSubstr("unknown name 'w'"));
  EXPECT_THAT(refusal("friction = { kind = \"position\", coefficient = \"y\" }"),
              HasSubstr("names y, but the grid has 1 axis"));
  EXPECT_THAT(refusal("friction = { kind = \"cubic\", coefficient = 1 }", "gkdv"), HasSubstr("gkdv has none"));
  EXPECT_THAT(refusal("force = \"sin(tt)\""), HasSubstr("unknown name 'tt'"));
  EXPECT_THAT(refusal("force = { v = \"sin(tt)\" }"), HasSubstr("problem.force.v"));
  EXPECT_THAT(refusal("force = { w = \"sin(t)\" }"), HasSubstr("field"));
  EXPECT_THAT(refusal("[method]\nname = \"auto\"\nC = 2.0"), HasSubstr("is yet to choose"));
  EXPECT_THAT(refusal("force = \"sin(t)\"", "truss"), HasSubstr("say which of the fields x, y, px, py"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
