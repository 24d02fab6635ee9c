// seiche run: what it leaves, what it says, and when it stops.
#include <test/support/background.hpp>
#include <test/support/paths.hpp>
#include <test/support/program.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/problem/problems.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Background;
using test::Cli;
using Result = Cli::Result;
using testing::HasSubstr;

TEST_F(Cli, ARunLeavesItsFiles) {
  write_case();
  const Result result = seiche("run case.toml --out out --set output.snapshot_every=32");
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_EQ(result.out, "") << "stdout is for data";
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory / "out")) names.insert(entry.path().filename().string());
  EXPECT_EQ(names, (std::set<std::string>{"case.toml", "energy.csv", "final.txt", "report.html", "solution.h5",
                                          "solution.xdmf", "summary.json"}));

  EXPECT_EQ(lines("out/energy.csv").front(), "t,H,H_modified");
  EXPECT_EQ(lines("out/energy.csv").size(), 1U + 65U);
  const SolutionReader solution(directory / "out/solution.h5");
  EXPECT_EQ(solution.times(), (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(solution.fields(), (std::vector<std::string>{"u", "v"}));
  ASSERT_EQ(solution.axes().size(), 1U);
  EXPECT_EQ(solution.axes()[0].values, (std::vector<double>{0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2}));
  EXPECT_EQ(solution.text("status"), "success");
  EXPECT_THAT(solution.text("case"), HasSubstr("name = \"klein_gordon\""));
  EXPECT_TRUE(json::parse(solution.text("versions")).contains("hdf5"));
  EXPECT_EQ(lines("out/final.txt").size(), 16U);
  const json summary = json::parse(text("out/summary.json"));
  EXPECT_EQ(summary["status"], "success");
  EXPECT_EQ(summary["steps"], 64);
  EXPECT_EQ(summary["t"], 1.0);
  EXPECT_EQ(summary["energy"]["law"], "holds");
  for (const char* library : {"seiche", "git", "compiler", "eigen", "fftw"}) {
    EXPECT_TRUE(summary["versions"].contains(library)) << library;
  }
}

TEST_F(Cli, ARunFirstSaysWhatItSolves) {
  write_case();
  const Result result = seiche("run case.toml --out out");
  EXPECT_THAT(result.err,
              testing::StartsWith("klein_gordon: u, v on 8 points (periodic), 16 unknowns; seisav, h = 0.015625, "
                                  "backend dense, to t = 1\n"));
  EXPECT_THAT(result.err, testing::Not(HasSubstr("theorem")));
  const Result plane = seiche(
      "run case.toml --out plane --verbose --set 'problem.points=[8, 6]' "
      "'problem.boundary=[\"periodic\", \"dirichlet\"]' method.tolerance=1e-4 time.end=0.25");
  EXPECT_THAT(plane.err, testing::AllOf(HasSubstr(": u, v on 8 × 5 points (periodic, dirichlet), 80 unknowns; seisav, "
                                                  "tolerance 0.0001, backend modal, to t = 0.25\n"),
                                        HasSubstr("\nwork  "), HasSubstr("\ntheorem ")));
  write("few.toml",
        "[problem]\nname = \"oscillator\"\n[time]\nend = 1.0\n[ensemble]\nmembers = 3\nperturb_initial = 0.1\n");
  EXPECT_THAT(seiche("run few.toml --out few").err,
              testing::StartsWith("oscillator: 3 members, each q, p, 2 unknowns; "));
  EXPECT_EQ(seiche("run case.toml --out quiet --quiet").err, "");
}

TEST_F(Cli, TheCaseItLeavesRunsToTheSameBits) {
  write_case("gamma = \"0.1 + 0.05*sin(t)\"");
  ASSERT_EQ(seiche("run case.toml --out first --quiet").exit, 0);
  ASSERT_EQ(seiche("run first/case.toml --out second --quiet").exit, 0);
  for (const char* name : {"energy.csv", "final.txt", "solution.xdmf"}) {
    EXPECT_EQ(text(fs::path("first") / name), text(fs::path("second") / name)) << name;
  }
  const SolutionReader first(directory / "first/solution.h5"), second(directory / "second/solution.h5");
  ASSERT_EQ(first.times(), second.times());
  for (Index k = 0; k < first.count(); ++k) EXPECT_EQ(state(first, k), state(second, k)) << first.time(k);
}

TEST_F(Cli, ARunLeavesTheSameBytesLaterAndInAnotherFolder) {
  write_case();
  fs::create_directory(directory / "there");
  const std::string run = " --quiet --set time.end=20 output.snapshot_every=4";
  ASSERT_EQ(seiche("run case.toml --out first --set problem.points=16" + run).exit, 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 counts its times in seconds
  const Result later = seiche("run ../case.toml --out second --set problem.points=16" + run, "cd there;");
  ASSERT_EQ(later.exit, 0) << later.err;
  for (const char* name : {"energy.csv", "final.txt", "solution.xdmf", "solution.h5"})
    EXPECT_TRUE(text(fs::path("first") / name) == text(fs::path("there/second") / name)) << name;
}

TEST_F(Cli, OneRunStartsWhereAnotherEnded) {
  write_case();
  ASSERT_EQ(seiche("run case.toml --out first --quiet").exit, 0);
  ASSERT_EQ(seiche("run case.toml --out second --quiet --set 'problem.initial={file=\"first/final.txt\"}'").exit, 0);
  const json first = json::parse(text("first/summary.json")), second = json::parse(text("second/summary.json"));
  EXPECT_NEAR(second["energy"]["initial"].get<double>(), first["energy"]["final"].get<double>(), 1e-15);
}

// A rate that changes in time is that of the whole run only where the second one begins at the time of the file.
TEST_F(Cli, TwoRunsOfWhichTheSecondStartsInTimeAreOne) {
  write_case("gamma = \"0.5 + 0.4*sin(3*t)\"\n");
  const std::string run = "run case.toml --set method.name=egc4 ";
  ASSERT_EQ(seiche(run + "time.end=2 --out whole").exit, 0);
  ASSERT_EQ(seiche(run + "time.end=1 --out first").exit, 0);
  const std::string second = run + "'problem.initial={ file = \"first/final.txt\" }' ";
  const Result result = seiche(second + "time.start=1 time.end=2 --out second");
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_THAT(result.err, testing::Not(HasSubstr("a file holds z alone")));
  const auto distance = [&](const char* one, const char* other) {
    double largest = 0;
    const std::vector<std::string> a = lines(fs::path(one) / "final.txt"), b = lines(fs::path(other) / "final.txt");
    for (std::size_t i = 0; i < a.size(); ++i)
      largest = std::max(largest, std::abs(std::stod(a[i]) - std::stod(b.at(i))));
    return largest;
  };
  EXPECT_LT(distance("second", "whole"), 1e-11);
  EXPECT_THAT(lines("second/energy.csv")[1], testing::StartsWith("1,"));
  EXPECT_THAT(text("second/case.toml"), HasSubstr("start = 1.0"));
  EXPECT_EQ(seiche("audit second").exit, 0) << text("stdout.txt");
  EXPECT_THAT(seiche(second + "time.end=1 --out third").err,
              HasSubstr("damping and forces are those from t = 0 on, not from [time] start = 1, where the file was"));
  EXPECT_GT(distance("third", "whole"), 1e-3);
}

TEST_F(Cli, JsonIsExactlyOneDocumentOnStdoutAndTheSummaryFile) {
  write_case();
  const Result result = seiche("run case.toml --out out --json");
  EXPECT_EQ(result.exit, 0);
  EXPECT_EQ(json::parse(result.out), json::parse(text("out/summary.json")));
  EXPECT_THAT(result.err, HasSubstr("reached t = 1")) << "people read stderr";
  EXPECT_EQ(seiche("run case.toml --out out --json --quiet").err, "");
}

TEST_F(Cli, OneSetTakesSeveralKeysAndLeavesTheCaseFileAlone) {
  write_case();
  const Result result =
      seiche("run --set time.end=0.5 method.h=1/32 case.toml --out out --json --set method.name=seilm");
  ASSERT_EQ(result.exit, 0) << result.err;
  const json summary = json::parse(result.out);
  EXPECT_EQ(summary["steps"], 16);
  EXPECT_EQ(summary["method"], "seilm");
  EXPECT_TRUE(summary["energy"]["modified"].is_null());
  EXPECT_EQ(lines("out/energy.csv").front(), "t,H");
}

TEST_F(Cli, EachNoteHasALineOfItsOwnAndAStepSizeOfTheProgramIsAmongThem) {
  const std::string custom =
      "[problem]\nname = \"custom\"\nH = \"q^4/4 + 7\"\nparameters = { k = 1 }\ninitial = { q = 1, p = 0 }\n";
  write("case.toml", custom + "[time]\nend = 1.0\n");
  const std::string said = seiche("run case.toml --out out").err;
  for (const char* line :
       {"seiche: h = 1/64 (default)\n", "\nseiche: no formula names the parameter k\n", "\nseiche: H = ½zᵀMz + V with ",
        "\nseiche: the energy does not name p: S gives q no velocity"})
    EXPECT_THAT("\n" + said, HasSubstr(line));
  EXPECT_THAT(said, testing::StartsWith("custom: q, p, 2 unknowns; seisav, h = 0.015625, backend dense, to t = 1\n"
                                        "seiche: h = 1/64 (default)\n"));
  EXPECT_THAT(json::parse(text("out/summary.json"))["message"].get<std::string>(), HasSubstr("; h = 1/64 (default); "));
  for (const char* given : {"method.h=1/64", "method.tolerance=1e-4"})
    EXPECT_THAT(seiche(std::string("run case.toml --out out --set method.name=egc4 ") + given).err,
                Not(HasSubstr("(default)")));
  EXPECT_THAT(seiche("converge case.toml --h 1/8,1/16").err, Not(HasSubstr("(default)")));
}

TEST_F(Cli, NotesOnOneMemberOfAnEnsembleAreCalledSo) {
  write("case.toml",
        "[problem]\nname = \"custom\"\nH = \"p^2/2 + k*q^4\"\nparameters = { k = 1 }\ninitial = { q = 1, p = 0 }\n"
        "[method]\nh = 0.1\n[time]\nend = 1.0\n[ensemble]\nmembers = 3\nk = { from = 1, to = 2 }\n");
  EXPECT_THAT(seiche("run case.toml --out out").err, HasSubstr("seiche: of member 1: H = ½zᵀMz + V with "));
  write("same.toml", text("case.toml").substr(0, text("case.toml").find("k = { from")) + "perturb_initial = 0.1\n");
  EXPECT_THAT(seiche("run same.toml --out same").err, HasSubstr("seiche: H = ½zᵀMz + V with "));
}

TEST_F(Cli, AStepThatDoesNotDivideTheTimeIsSaidToBeShortened) {
  write_case();
  const Result result = seiche("run case.toml --out out --json --set method.h=0.3");
  EXPECT_EQ(result.exit, 0);
  EXPECT_THAT(result.err, HasSubstr("shortened to 0.1"));
  const json summary = json::parse(result.out);
  EXPECT_THAT(summary["message"], HasSubstr("shortened to 0.1"));
  EXPECT_EQ(summary["t"], 1.0);
  EXPECT_EQ(summary["steps"], 4);
}

TEST_F(Cli, TheNumberOfThreadsDoesNotChangeTheResult) {
  write_case();
  const std::string run =
      "run case.toml --quiet --set problem.points=[128,96] --set problem.length=[2.0,2.0] --set "
      "backend.name=modal --set time.end=0.1 ";
  EXPECT_EQ(seiche(run + "--out one").exit, 0);
  EXPECT_EQ(seiche(run + "--out three --threads 3").exit, 0);
  EXPECT_EQ(text("one/final.txt"), text("three/final.txt"));
  EXPECT_EQ(text("one/energy.csv"), text("three/energy.csv"));
}

TEST_F(Cli, CtrlCLeavesWholeFilesAndExitsWith130) {
  write_case();
  for (const int signal : {SIGINT, SIGTERM}) {
    fs::remove_all(directory / "out");
    Background run(directory,
                   {"run", "case.toml", "--out", "out", "--json", "--set", "time.end=1e7", "output.energy_every=10"});
    ASSERT_TRUE(Background::wait_until([&] {  // the header, the first row and another
      return fs::exists(directory / "out/energy.csv.partial") && lines("out/energy.csv.partial").size() > 2;
    }));
    EXPECT_EQ(run.end(signal), 130) << text("stderr.txt");

    const json summary = json::parse(text("stdout.txt"));
    EXPECT_EQ(summary["status"], "interrupted");
    EXPECT_EQ(json::parse(text("out/summary.json")), summary);
    const double t = summary["t"].get<double>();
    EXPECT_GT(t, 0.0);
    ASSERT_FALSE(lines("out/energy.csv").empty());
    EXPECT_EQ(std::stod(lines("out/energy.csv").back()), t) << "the last row is the last state";
    EXPECT_EQ(text("out/energy.csv").back(), '\n');
    const SolutionReader solution(directory / "out/solution.h5");
    EXPECT_EQ(solution.times().back(), t);
    EXPECT_EQ(solution.text("status"), "interrupted");
    EXPECT_EQ(lines("out/final.txt").size(), 16U);
    for (const auto& entry : fs::directory_iterator(directory / "out")) EXPECT_NE(entry.path().extension(), ".partial");
  }
}

TEST_F(Cli, AFailureOfTheLastFilesIsToldOnceAndEverywhereTheSame) {
  write_case();
  for (const std::string quiet : {"", " --quiet"}) {
    fs::remove_all(directory / "out");
    fs::create_directories(directory / "out/report.html.partial");  // where the report would be written
    const Result result = seiche("run case.toml --out out --json" + quiet);
    EXPECT_EQ(result.exit, 1);
    const json summary = json::parse(result.out);
    EXPECT_EQ(summary["status"], "failed");
    EXPECT_THAT(summary["message"].get<std::string>(), HasSubstr("report.html: Is a directory"));
    EXPECT_EQ(json::parse(text("out/summary.json")), summary);
    const std::size_t said = result.err.find("cannot write");
    EXPECT_NE(said, std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("cannot write", said + 1), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("success"), std::string::npos) << result.err;
    EXPECT_EQ(lines("out/final.txt").size(), 16U);
  }
}

TEST_F(Cli, TheFileForParaViewIsSmallBesideALongSolution) {
  write_case();
  const Result result = seiche(
      "run case.toml --out out --set problem.points=64 time.end=400 output.snapshot_every=1 output.energy_every=64");
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_LE(10 * fs::file_size(directory / "out/solution.xdmf"), fs::file_size(directory / "out/solution.h5"));
  EXPECT_THAT(result.err, HasSubstr("`seiche plot out --xdmf` shows all"));
  const std::uintmax_t before = fs::file_size(directory / "out/solution.xdmf");
  ASSERT_EQ(seiche("plot out --xdmf").exit, 0);
  EXPECT_GT(fs::file_size(directory / "out/solution.xdmf"), 5 * before);
}

TEST_F(Cli, ARunIsWholeWithoutItsFileForParaView) {
  write_case();
  fs::create_directories(directory / "out/solution.xdmf.partial/in_the_way");
  const Result result = seiche("run case.toml --out out --quiet");
  EXPECT_EQ(result.exit, 0);
  EXPECT_THAT(result.err, HasSubstr("there is no solution.xdmf, and ParaView cannot open the solution: cannot write"));
  EXPECT_EQ(json::parse(text("out/summary.json"))["status"], "success");
  EXPECT_TRUE(fs::exists(directory / "out/report.html"));
}

TEST_F(Cli, AFullDiskFailsTheRunAndKeepsTheSmallFilesAndTheRowsWritten) {
  write_case();
  const Result result = seiche("run case.toml --out out --set time.end=1000", "ulimit -f 100;");
  EXPECT_EQ(result.exit, 1) << result.err;
  EXPECT_EQ(json::parse(text("out/summary.json"))["status"], "failed");
  EXPECT_THAT(result.err, HasSubstr("File too large"));
  const std::vector<std::string> rows = lines("out/energy.csv");
  ASSERT_GT(rows.size(), 1000U);
  EXPECT_EQ(std::count(rows.back().begin(), rows.back().end(), ','), std::count(rows[0].begin(), rows[0].end(), ','));
  EXPECT_EQ(text("out/energy.csv").back(), '\n');
  EXPECT_FALSE(fs::exists(directory / "out/energy.csv.partial"));
}

TEST_F(Cli, ARunDoesNotNeedStandardStreams) {
  write_case();
  for (const char* streams : {"2>/dev/full", "2>&-", "<&- >&- 2>&-"}) {
    fs::remove_all(directory / "out");
    const std::string command = "cd '" + directory.string() + "' && '" + test::program_path() +
                                "' run case.toml --out out --set method.h=0.3 " + streams;
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 0) << streams;
    EXPECT_EQ(lines("out/energy.csv").size(), 1U + 5U) << streams;
    for (const auto& entry : fs::directory_iterator(directory / "out"))
      EXPECT_EQ(text(entry.path()).find("success:"), std::string::npos) << entry.path() << " took the place of stderr";
    EXPECT_EQ(SolutionReader(directory / "out/solution.h5").times().back(), 1.0) << streams;
  }
  const std::string closed = "'" + test::program_path() + "' list problems >&- 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(closed.c_str())), 1) << "nothing came out";
}

TEST_F(Cli, AToleranceTakesStepsOfItsOwnAndShowsAskedTimes) {
  write_case();
  const Result result = seiche(
      "run case.toml --out out --json --set method.name=egc6 method.tolerance=1e-8 output.snapshot_interval=0.125");
  ASSERT_EQ(result.exit, 0) << result.err;
  const json summary = json::parse(result.out);
  EXPECT_EQ(summary["tolerance"], 1e-8);
  EXPECT_TRUE(summary["h"].is_null());
  EXPECT_EQ(summary["energy"]["law"], "holds");
  EXPECT_TRUE(summary["counts"].contains("rejected_steps"));
  const double end = summary["t"];
  const std::vector<double> times = SolutionReader(directory / "out/solution.h5").times();
  ASSERT_EQ(times.size(), 1U + static_cast<std::size_t>(end / 0.125));
  EXPECT_EQ(times[1], 0.125);
  EXPECT_EQ(seiche("audit out").exit, 0) << text("stdout.txt");
  EXPECT_THAT(text("stdout.txt"), HasSubstr("9 states")) << "energies at times between steps are checked too";
  EXPECT_EQ(lines("out/energy.csv").size(), 2U + summary["steps"].get<std::size_t>());
}

TEST_F(Cli, EveryProblemsExampleCaseRunsFromStandardInput) {
  for (const std::string& name : problem_names()) {
    const std::string new_case = "'" + test::program_path() + "' new " + name + " |";
    const Result result = seiche("run - --out " + name + " --json --set time.end=0.25", new_case);
    EXPECT_EQ(result.exit, 0) << name << ": " << result.err;
    EXPECT_EQ(json::parse(result.out)["problem"], name);
  }
}

TEST_F(Cli, EveryCaseFileRuns) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(test::source_directory()) / "cases")) {
    if (entry.path().extension() != ".toml") continue;
    const Result result = seiche("run '" + entry.path().string() + "' --out out --json --quiet --set time.end=0.25");
    EXPECT_EQ(result.exit, 0) << entry.path() << ": " << result.err;
    ++count;
  }
  EXPECT_GE(count, 40) << "a case file of cases/ was not run, or fewer are there";
}

TEST_F(Cli, MeasuredPlansAreKeptAndUsedAgain) {
  write_case();
  const std::string run = "run case.toml --out out --set backend.name=modal backend.plan=measure";
  ASSERT_EQ(seiche(run).exit, 0);
  EXPECT_THAT(text("out/fftw_wisdom"), HasSubstr("fftw"));
  const std::string first = text("out/final.txt");
  ASSERT_EQ(seiche(run).exit, 0);
  EXPECT_EQ(text("out/final.txt"), first);
}

}  // namespace TEST_FILE
}  // namespace seiche
