// What is refused before anything is computed: exit code 2, and a sentence with the value and what is allowed.
#include <test/support/program.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace seiche {
namespace TEST_FILE {

using nlohmann::json;
using test::Cli;
using Result = Cli::Result;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST_F(Cli, WrongCaseFilesAreRefusedWithTheValueAndWhatIsAllowed) {
  write_case("poinst = 3");
  EXPECT_THAT(refused("run case.toml --out out"),
              AllOf(HasSubstr("case.toml:4"), HasSubstr("poinst"), HasSubstr("did you mean 'points'")));
  write_case("gamma = \"0.1 + * t\"");
  EXPECT_THAT(refused("run case.toml --out out"), AllOf(HasSubstr("case.toml:4"), HasSubstr("column 7")));
  write_case();
  EXPECT_THAT(refused("run case.toml --out out --set method.name=seisv"), HasSubstr("did you mean 'seisav'"));
  EXPECT_THAT(refused("run case.toml --out out --set problem.name=klein_godron"), HasSubstr("klein_gordon"));
  EXPECT_THAT(refused("run case.toml --out out --set backend.name=modl"), HasSubstr("did you mean 'modal'"));
  EXPECT_THAT(refused("run case.toml --out out --set problem.points=-3"), AllOf(HasSubstr("-3"), HasSubstr("≥ 2")));
  EXPECT_THAT(refused("run case.toml --out out --set method.h=0"), HasSubstr("must be > 0"));
  EXPECT_THAT(refused("run case.toml --out out --set method.h=nan"), HasSubstr("finite"));
  EXPECT_THAT(refused("run case.toml --out out --set method.h=1/0"), HasSubstr("divides by zero"));
  EXPECT_THAT(refused("run case.toml --out out --set time.end=-1"), HasSubstr("-1"));
  EXPECT_THAT(refused("run case.toml --out out --set method.C=-1"), HasSubstr("would do"));
  EXPECT_THAT(refused("run none.toml --out out"), HasSubstr("none.toml"));
  write("broken.toml", "[problem\n");
  EXPECT_THAT(refused("run broken.toml --out out"), HasSubstr("broken.toml:1"));
}

TEST_F(Cli, ForgottenQuotesAreShownInTheLineWithAHint) {
  write_case("", "h = 1/64");
  EXPECT_THAT(refused("run case.toml --out out"),
              AllOf(HasSubstr("case.toml:"), HasSubstr("in `h = 1/64`"), HasSubstr("stand in quotes: \"1/64\"\n")));
  for (const auto& [line, meant] :
       std::vector<std::pair<std::string, std::string>>{{"gamma = 0.1 + 0.05*sin(t)  # damped", "0.1 + 0.05*sin(t)"},
                                                        {"initial = gaussian", "gaussian"},
                                                        {"gamma = max(0, sin(t))", "max(0, sin(t))"},
                                                        {"initial = { u = 2*x, v = 0 }", "2*x"}}) {
    write_case(line);
    EXPECT_THAT(refused("run case.toml --out out"), HasSubstr("stand in quotes: \"" + meant + "\"\n")) << line;
  }
  for (const std::string line :
       {"gamma = [1, 2", "gamma = 0.1 0.2", "initial = \"zero", "points = 9", "alpha = 1.2.3"}) {
    write_case(line);
    EXPECT_THAT(refused("run case.toml --out out"), Not(HasSubstr("in quotes"))) << line;
  }
}

TEST_F(Cli, TextsOfOtherLanguagesAreToldWhatTomlIs) {
  const auto said = [&](const std::string& line) {
    write_case(line);
    return refused("run case.toml --out out");
  };
  EXPECT_THAT(said("alpha: 1.5"), HasSubstr("joined by = and not by a colon: alpha = 1.5, in `alpha: 1.5`"));
  EXPECT_THAT(said("alpha = 1,5"), HasSubstr("decimals are written with a point: 1.5"));
  EXPECT_THAT(said("initial = \"zero"), HasSubstr("the text is not closed: a \" is missing at its end"));
  EXPECT_THAT(said("initial = “zero”"), HasSubstr("the quotes “ are not those of TOML: write straight ones"));
  EXPECT_THAT(said("dealias = True"), HasSubstr("true and false are in lower case, and names"));
  EXPECT_THAT(said("[problem]"), HasSubstr("a section stands once, with all of its keys"));
  write("case.toml", "{\n  \"problem\": {\"name\": \"klein_gordon\"}\n}\n");
  EXPECT_THAT(refused("run case.toml --out out"),
              HasSubstr("looks like JSON: write [problem], and below it key = value"));
  write("case.toml", std::string("\x7f"
                                 "ELF\0\0",
                                 6));
  EXPECT_THAT(refused("run case.toml --out out"), HasSubstr("case.toml is no case file: it holds binary data"));
}

TEST_F(Cli, WhatWasMeantByAnArgumentIsSaid) {
  write_case();
  EXPECT_THAT(refused("run case.toml --out out --h 0.1"),
              HasSubstr("unknown option '--h'; a key of the case is set by --set method.h=…"));
  EXPECT_THAT(refused("run case.toml --out out --rtol=1e-6"), HasSubstr("--set method.tolerance=…"));
  EXPECT_THAT(refused("run case.toml --out out --set method.h = 1/64"), HasSubstr("one argument without blanks"));
  EXPECT_THAT(refused("run case.toml --out out --threads all"), HasSubstr("'all' is no whole number from 1 to 1024"));
  EXPECT_THAT(refused("converge case.toml --methods avf seisav"),
              HasSubstr("the values of --methods are joined by commas"));
  EXPECT_THAT(refused("list"), HasSubstr("say what to list: seiche list methods, seiche list problems"));
  EXPECT_THAT(refused(""), AllOf(HasSubstr("run "), HasSubstr("seiche: a command is missing")));
  std::filesystem::create_directory(directory / "empty");
  for (const char* command : {"audit", "plot"})
    EXPECT_THAT(refused(std::string(command) + " empty"),
                HasSubstr("is no directory of a finished run: it has no case.toml"));
}

TEST_F(Cli, HelpAndVersionAnswerToTheirOtherNames) {
  EXPECT_EQ(seiche("help").out, seiche("--help").out);
  EXPECT_EQ(seiche("help run").out, seiche("run --help").out);
  EXPECT_EQ(seiche("-V").out, seiche("--version").out);
  write_case();
  EXPECT_EQ(seiche("run case.toml --quiet -o elsewhere").exit, 0);
  EXPECT_TRUE(std::filesystem::exists(directory / "elsewhere/summary.json"));
}

TEST_F(Cli, AStepSizeThatWouldFillTheDiskIsRefused) {
  write_case();
  EXPECT_THAT(refused("run case.toml --out out --set method.h=1e-12"), HasSubstr("energy_every"));
}

TEST_F(Cli, ARateThatDipsBelowZeroBetweenSamplesIsNoViolation) {
  write_case("gamma = \"0.1-50*exp(-(t-0.5123)^2*1e8)\"\nalpha = 1.0");
  const Result result = seiche("run case.toml --out out");
  EXPECT_EQ(result.exit, 0) << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("is negative at t = 0.512"), Not(HasSubstr("violated"))));
}

TEST_F(Cli, ARunAcrossAPoleOfTheRateIsRefused) {
  write_case("gamma = \"1/(t-0.5031)^2\"");
  EXPECT_THAT(refused("run case.toml --out out"), HasSubstr("infinite between t = 0.502"));
  EXPECT_EQ(seiche("run case.toml --out out --set time.end=0.5 method.h=0.05").exit, 0);
}

TEST_F(Cli, ValuesThatCannotBeMeantAreRefused) {
  write_case();
  EXPECT_THAT(refused("run case.toml --out out --set 'problem.initial={file=\"/dev/zero\"}'"), HasSubstr("/dev/zero"));
  EXPECT_THAT(refused("run case.toml --out out --set method.C=1e300"), HasSubstr("fewer than six digits"));
  EXPECT_THAT(refused("run case.toml --out ''"), HasSubstr("--out"));
  EXPECT_THAT(refused("converge case.toml --methods seisav,seisav --h 1/8"), HasSubstr("twice"));
}

TEST_F(Cli, InitialFilesAreRefusedWithLineOrCounts) {
  write_case("initial = { file = \"z0.txt\" }");
  EXPECT_THAT(refused("run case.toml --out out"), HasSubstr("z0.txt"));
  write("z0.txt", "1 2 3\n4 nan 6\n");
  EXPECT_THAT(refused("run case.toml --out out"), AllOf(HasSubstr("z0.txt:2"), HasSubstr("nan")));
  write("z0.txt", "1 2 3\n");
  EXPECT_THAT(refused("run case.toml --out out"), AllOf(HasSubstr("3 numbers"), HasSubstr("16")));
}

TEST_F(Cli, MethodsThatDoNotApplySayWhyAndWhichDo) {
  write("case.toml", "[problem]\nname = \"gkdv\"\n[time]\nend = 1.0\n");
  for (const char* method : {"avf", "sav"}) {
    EXPECT_THAT(refused(std::string("run case.toml --out out --set method.name=") + method),
                AllOf(HasSubstr("does not apply"), HasSubstr("seisav")));
  }
}

// Below a regular file nothing can be written, not even by root.
TEST_F(Cli, AnUnwritableDirectoryIsNamedWithTheReason) {
  write_case();
  write("file", "");
  EXPECT_THAT(refused("run case.toml --out file/out"), AllOf(HasSubstr("file/out"), HasSubstr("Not a directory")));
  EXPECT_THAT(refused("run case.toml --out file"), HasSubstr("file"));
}

TEST_F(Cli, WrongUsageIsRefusedWithTheNearestName) {
  write_case();
  EXPECT_THAT(refused(""), HasSubstr("--help"));
  EXPECT_THAT(refused("rnu case.toml"), HasSubstr("did you mean 'run'"));
  EXPECT_THAT(refused("run"), HasSubstr("CASE"));
  EXPECT_THAT(refused("run case.toml --jsn"), HasSubstr("did you mean '--json'"));
  EXPECT_THAT(refused("run case.toml other.toml"), HasSubstr("other.toml"));
  EXPECT_THAT(refused("run case.toml --threads 0"), HasSubstr("--threads"));
  EXPECT_THAT(refused("run case.toml --threads many"), HasSubstr("--threads"));
  EXPECT_THAT(refused("run case.toml --out"), HasSubstr("--out"));
  EXPECT_THAT(refused("run case.toml --set method.h"), HasSubstr("method.h"));
  EXPECT_THAT(refused("list method"), HasSubstr("did you mean 'methods'"));
  EXPECT_THAT(refused("new gkvd"), HasSubstr("did you mean 'gkdv'"));
  EXPECT_THAT(refused("converge case.toml --methods seisv"), HasSubstr("did you mean 'seisav'"));
  EXPECT_THAT(refused("converge case.toml --h 1/32,0"), HasSubstr("> 0"));
  EXPECT_THAT(refused("converge case.toml --reference odeitn"), HasSubstr("did you mean 'odeint'"));
  EXPECT_THAT(refused("paper --out out --reference odeitn"), HasSubstr("did you mean 'odeint'"));
  EXPECT_THAT(refused("paper --quik"), HasSubstr("did you mean '--quick'"));
}

TEST_F(Cli, WhatSetGaveIsBlamedOnSetAndNothingIsSaidTwice) {
  write_case();
  EXPECT_THAT(refused("run case.toml --out out --set 'problem.initial={u=\"log(x-1)\",v=\"0\"}'"),
              AllOf(HasSubstr("seiche: --set problem.initial="), HasSubstr(" is nan at "), Not(HasSubstr("-nan"))));
  EXPECT_THAT(refused("run case.toml --out out --set 'problem.gamma=sqrt(x-1)'"),
              AllOf(HasSubstr("seiche: --set problem.gamma="), Not(HasSubstr("-nan"))));
  write_case("gamma = \"sqrt(x-1)\"");
  EXPECT_THAT(refused("run case.toml --out out --set problem.alpha=1"),
              HasSubstr("seiche: case.toml:4:9: problem.gamma"));
  write_case();
  const std::string err = seiche("run case.toml --out out --set method.name=auto method.tolerance=1e-4").err;
  EXPECT_THAT(err, HasSubstr("method = \"auto\": "));
  EXPECT_EQ(err.find("method = \"auto\""), err.rfind("method = \"auto\"")) << err;
  EXPECT_THAT(json::parse(text("out/summary.json"))["message"].get<std::string>(), HasSubstr("method = \"auto\": "));
}

TEST_F(Cli, AListOfOneEntryThatServesTwoAxesIsSaid) {
  write("case.toml",
        "[problem]\nname = \"klein_gordon\"\npoints = [8, 8]\nlength = [2.0]\nkappa = 1\n[time]\nend = 0.1\n");
  EXPECT_THAT(seiche("run case.toml --out out").err,
              HasSubstr("problem.length is a list with one entry, and serves all 2 axes"));
  EXPECT_THAT(seiche("run case.toml --out out --set problem.length=2.0").err, Not(HasSubstr("one entry")));
}

}  // namespace TEST_FILE
}  // namespace seiche
