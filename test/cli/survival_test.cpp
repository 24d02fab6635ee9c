// What a run leaves when something goes wrong: a program that is killed, a folder that is taken away, links in the
// place of files, signals one after the other.
#include <test/support/background.hpp>
#include <test/support/program.hpp>
#include <test/support/run_folder.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

class Survival : public Cli {
 protected:
  static std::vector<std::string> endless(const std::vector<std::string>& settings = {}) {
    std::vector<std::string> words = {"run",
                                      "case.toml",
                                      "--out",
                                      "out",
                                      "--quiet",
                                      "--set",
                                      "time.end=1e6",
                                      "output.snapshot_every=4",
                                      "output.energy_every=8",
                                      "checkpoint.every_seconds=0.1"};
    words.insert(words.end(), settings.begin(), settings.end());
    return words;
  }
  // A run that has a checkpoint.
  bool is_under_way() const {
    return Background::wait_until([&] { return has("out/checkpoint.seiche"); });
  }
};

TEST_F(Survival, ARunThatWasKilledIsNotErasedByTheNextOne) {
  write_case();
  Background run(directory, endless());
  ASSERT_TRUE(is_under_way()) << text("stderr.txt");
  EXPECT_EQ(run.end(SIGKILL), -SIGKILL);
  const std::string checkpoint = text("out/checkpoint.seiche");
  const std::string again = "run case.toml --out out --quiet";
  for (const std::string& next :
       {again, again + " --set ensemble.members=2 ensemble.perturb_initial=0.01",
        std::string("paper --quick --quiet --out out"), std::string("spectrum case.toml --out out")}) {
    const Result result = seiche(next);
    EXPECT_EQ(result.exit, 2) << next;
    EXPECT_THAT(result.err, AllOf(HasSubstr("`seiche resume out`"), HasSubstr("--restart"))) << next;
    EXPECT_TRUE(text("out/checkpoint.seiche") == checkpoint) << next;
  }
  EXPECT_EQ(seiche("audit out").exit, 2);
  EXPECT_THAT(text("stderr.txt"), AllOf(HasSubstr("`seiche resume out`"), HasSubstr("`seiche recover out`")));
  EXPECT_EQ(seiche(again + " --restart").exit, 0) << text("stderr.txt");
  EXPECT_EQ(json::parse(text("out/summary.json"))["t"], 1.0);
  for (const char* left : {"solution.h5.partial", "checkpoint.seiche", "checkpoint_prev.seiche", "solution"})
    EXPECT_FALSE(has(fs::path("out") / left)) << left;
}

TEST_F(Survival, WhatIsRecoveredOfAKilledRunPassesTheAudit) {
  write_case();
  const std::string truss = "[problem]\nname = \"truss\"\n[method]\nh = \"1/64\"\n[time]\nend = 1.0\n";
  // Steps by a tolerance grow as the waves die away, and would take seconds each.
  const std::vector<std::string> by_tolerance = {"method.tolerance=1e-4", "method.h_max=0.01"};
  for (const auto& [problem, settings] : {std::pair("a line", std::vector<std::string>()),
                                          {"by a tolerance", by_tolerance},
                                          {"a truss", std::vector<std::string>()}}) {
    fs::remove_all(directory / "out");
    if (problem == std::string("a truss")) write("case.toml", truss);
    Background run(directory, endless(settings));
    ASSERT_TRUE(is_under_way()) << problem << text("stderr.txt");
    EXPECT_EQ(run.end(SIGKILL), -SIGKILL);
    std::ofstream(directory / "out/energy.csv.partial", std::ios::app) << "12.25,0.000";  // as a torn line ends

    const Result result = seiche("recover out");
    EXPECT_EQ(result.exit, 0) << result.err;
    EXPECT_THAT(result.err, AllOf(HasSubstr("saved      out, up to t = "), HasSubstr("`seiche resume out` goes on")));
    EXPECT_EQ(text("out/energy.csv").back(), '\n');
    const json summary = json::parse(text("out/summary.json"));
    EXPECT_EQ(summary["status"], "interrupted");
    EXPECT_FALSE(summary.contains("resumed_at")) << "it did not go on";
    const double t = summary["t"];
    EXPECT_EQ(t, std::stod(lines("out/energy.csv").back()));
    const SolutionReader solution(directory / "out/solution.h5");
    EXPECT_EQ(solution.text("status"), "interrupted");
    EXPECT_EQ(solution.times().back(), t);
    for (const auto& entry : fs::directory_iterator(directory / "out")) EXPECT_NE(entry.path().extension(), ".partial");
    EXPECT_EQ(seiche("audit out").exit, 0) << problem << text("stdout.txt") << text("stderr.txt");

    EXPECT_THAT(seiche("recover out").err, HasSubstr("nothing to recover"));
    EXPECT_EQ(seiche("run case.toml --out out").exit, 2) << "nor is it erased when it was recovered";
    EXPECT_THAT(text("stderr.txt"), HasSubstr("--restart"));
    EXPECT_EQ(seiche("resume out --quiet --max-hours 1e-9").exit, 130) << "and it can go on";
  }
  EXPECT_EQ(seiche("recover none").exit, 2);
  fs::create_directory(directory / "empty");
  EXPECT_EQ(seiche("recover empty").exit, 2);
  EXPECT_THAT(text("stderr.txt"), HasSubstr("holds no run"));
}

TEST_F(Survival, ARunThatGoesOnIsDrawnAndGoesOn) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  write_case();
  for (const bool is_ensemble : {false, true}) {
    fs::remove_all(directory / "out");
    Background run(directory,
                   endless(is_ensemble ? std::vector<std::string>{"ensemble.members=3", "ensemble.perturb_initial=0.01"}
                                       : std::vector<std::string>()));
    ASSERT_TRUE(is_under_way()) << text("stderr.txt");
    const auto plotted = [&] {
      const int status = std::system(
          fmt::format("cd '{}' && '{}' plot out --format png >plot.txt 2>&1", directory.string(), program_path())
              .c_str());
      EXPECT_EQ(status, 0) << text("plot.txt");
      EXPECT_TRUE(has("out/figures/energy.png"));
      return text("plot.txt");
    };
    EXPECT_THAT(plotted(), HasSubstr("seiche: still running, up to t = "));
    if (!is_ensemble) {
      EXPECT_THAT(text("out/report.html"), HasSubstr("still running, up to t = "));
    }
    EXPECT_EQ(run.end(SIGKILL), -SIGKILL) << "it did not mind";
    EXPECT_THAT(plotted(), HasSubstr("seiche: not finished, up to t = "));
    EXPECT_EQ(seiche("resume out --quiet --max-hours 1e-9").exit, 130) << text("stderr.txt");
    EXPECT_FALSE(has("out/figures/energy.png")) << "it says that the run goes on";
    EXPECT_THAT(plotted(), Not(HasSubstr("up to t"))) << "it was interrupted, and has its files";
    EXPECT_EQ(seiche("audit out").exit, 0) << text("stdout.txt");
  }
}

TEST_F(Survival, AKilledEnsembleGoesOnOrIsRecovered) {
  write_case();
  std::vector<std::string> words = endless();
  words.insert(words.end(), {"ensemble.members=3", "ensemble.perturb_initial=0.01"});
  Background run(directory, words);
  ASSERT_TRUE(is_under_way()) << text("stderr.txt");
  EXPECT_EQ(run.end(SIGKILL), -SIGKILL);
  EXPECT_EQ(seiche("run case.toml --out out").exit, 2);
  EXPECT_EQ(seiche("recover out").exit, 0) << text("stderr.txt");
  EXPECT_EQ(json::parse(text("out/summary.json"))["status"], "interrupted");
  EXPECT_GT(lines("out/energy.csv").size(), 2U);
  EXPECT_EQ(seiche("audit out").exit, 0) << text("stdout.txt");
  const double t = json::parse(text("out/summary.json"))["t"];
  EXPECT_EQ(seiche("resume out --quiet --max-hours 1e-9").exit, 130) << text("stderr.txt");
  EXPECT_EQ(json::parse(text("out/summary.json"))["resumed_at"].size(), 1U);
  EXPECT_GE(json::parse(text("out/summary.json"))["t"], t);
}

TEST_F(Survival, OfARunThatHasEndedNothingIsRecovered) {
  write_case();
  for (const std::string settings : {"", " --set ensemble.members=2 ensemble.perturb_initial=0.01"}) {
    ASSERT_EQ(seiche("run case.toml --out out" + settings).exit, 0) << text("stderr.txt");
    const std::string summary = text("out/summary.json");
    const Result recovered = seiche("recover out");
    EXPECT_EQ(recovered.exit, 0);
    EXPECT_THAT(recovered.err, HasSubstr("nothing to recover"));
    EXPECT_EQ(text("out/summary.json"), summary);
    fs::create_directory(directory / "out/solution");
    write("out/solution/000001.h5", "mine");
    EXPECT_EQ(seiche("recover out").exit, 0);
    EXPECT_EQ(text("out/solution/000001.h5"), "mine");
    EXPECT_EQ(seiche("run case.toml --out out" + settings).exit, 2);
    EXPECT_EQ(text("out/solution/000001.h5"), "mine");
    fs::remove_all(directory / "out/solution");
  }
}

TEST_F(Survival, TheFirstSignalLetsEverythingBeWrittenWheneverItComes) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer has to be loaded first";
#endif
  write_case();
  int behind_the_last_step = 0;
  for (int n = 1;; n += 3) {
    fs::remove_all(directory / "out");
    fs::remove(directory / "log.txt");
    const Result result =
        seiche("run case.toml --out out --quiet",
               fmt::format("LD_PRELOAD='{}' SEICHE_SYNC_LOG=log.txt SEICHE_SIGNAL={} SEICHE_SIGNAL_AT={}",
                           failing_writes_path(), SIGTERM, n));
    if (text("log.txt").find("sent 15") == std::string::npos) break;
    ASSERT_LT(n, 1000) << "it never succeeds";
    ASSERT_THAT(result.exit, AnyOf(0, 130)) << n << result.err;
    if (!has("out")) continue;  // it has not begun
    EXPECT_EQ(json::parse(text("out/summary.json"))["status"], result.exit == 0 ? "success" : "interrupted") << n;
    for (const char* name : {"final.txt", "energy.csv", "solution.h5", "solution.xdmf", "report.html"})
      EXPECT_TRUE(has(std::string("out/") + name)) << n << " " << name;
    EXPECT_EQ(result.err, "") << n;
    behind_the_last_step += result.exit == 0 ? 1 : 0;
  }
  EXPECT_GT(behind_the_last_step, 5);
}

// Before the libraries begin, which takes longer than many runs.
TEST_F(Survival, SignalsWaitFromBeforeTheFirstConstructor) {
#if defined(SEICHE_SANITIZED) || !defined(__GLIBC__) || defined(__clang__)
  GTEST_SKIP() << "they wait from the beginning of main";
#endif
  const std::string read =
      "readelf -dW '" + test::program_path() + "' >'" + (directory / "dynamic.txt").string() + "' 2>/dev/null";
  if (std::system(read.c_str()) != 0) GTEST_SKIP() << "no readelf";
  EXPECT_THAT(text("dynamic.txt"), HasSubstr("(PREINIT_ARRAY)"));
}

// Before the program has looked at its arguments.
TEST_F(Survival, ASignalInTheFirstMomentIsAnswered) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer has to be loaded first";
#endif
  write_case();
  for (const int signal : {SIGUSR1, SIGTERM, SIGINT, SIGXCPU}) {
    const Result result = seiche("run case.toml --out out --quiet",
                                 fmt::format("LD_PRELOAD='{}' SEICHE_SIGNAL={}", failing_writes_path(), signal));
    if (signal == SIGUSR1) {
      EXPECT_EQ(result.exit, 0) << "it asks for a checkpoint, and the run goes on";
      fs::remove_all(directory / "out");
    } else {
      EXPECT_EQ(result.exit, 130) << signal;
      EXPECT_THAT(result.err, HasSubstr("stopped before the first step")) << signal;
      EXPECT_FALSE(has("out")) << signal;
    }
  }
  ASSERT_EQ(seiche("run case.toml --out out --quiet --max-hours 1e-9").exit, 130) << text("stderr.txt");
  const Result resumed =
      seiche("resume out --quiet", fmt::format("LD_PRELOAD='{}' SEICHE_SIGNAL={}", failing_writes_path(), SIGTERM));
  EXPECT_EQ(resumed.exit, 130);
  EXPECT_THAT(resumed.err, AllOf(HasSubstr("stopped before the run went on"), Not(HasSubstr("first step"))));
  EXPECT_EQ(json::parse(text("out/summary.json"))["status"], "interrupted");
}

TEST_F(Survival, ASecondSignalEndsOnlyWhatCanBeHadAgain) {
  write_case();
  Background run(directory, {"run", "case.toml", "--out", "out", "--quiet", "--set", "time.end=1e7",
                             "output.snapshot_every=1", "output.energy_every=1000", "checkpoint.every_seconds=0.1"});
  ASSERT_TRUE(is_under_way()) << text("stderr.txt");
  run.send(SIGINT);
  ASSERT_TRUE(Background::wait_until([&] { return has("out/summary.json.partial") || has("out/summary.json"); }));
  EXPECT_EQ(run.end(SIGINT), 130) << text("stderr.txt");
  const json summary = json::parse(text("out/summary.json"));
  EXPECT_EQ(summary["status"], "interrupted");
  EXPECT_EQ(lines("out/final.txt").size(), 16U);
  EXPECT_EQ(SolutionReader(directory / "out/solution.h5").times().back(), summary["t"].get<double>());
  for (const auto& entry : fs::directory_iterator(directory / "out")) EXPECT_NE(entry.path().extension(), ".partial");
}

// Of the first run nothing gets a name, and the second one does not notice.
TEST_F(Survival, ARunWhoseFolderIsRemovedLeavesTheNextOneAlone) {
  write_case();
  Background first(directory, endless());
  ASSERT_TRUE(is_under_way()) << text("stderr.txt");
  // It may write a checkpoint meanwhile.
  ASSERT_TRUE(Background::wait_until([&] {
    std::error_code busy;
    fs::remove_all(directory / "out", busy);
    return !has("out");
  }));
  ASSERT_EQ(seiche("run case.toml --out out --quiet").exit, 0) << text("stderr.txt");
  const std::string final = text("out/final.txt"), summary = text("out/summary.json"), energy = text("out/energy.csv");
  EXPECT_EQ(first.end(SIGINT), 1);
  EXPECT_EQ(text("out/final.txt"), final);
  EXPECT_EQ(text("out/summary.json"), summary);
  EXPECT_EQ(text("out/energy.csv"), energy);
  EXPECT_EQ(SolutionReader(directory / "out/solution.h5").times().back(), 1.0);
}

TEST_F(Survival, WhereALinkTakesThePlaceOfTheFolderNothingIsWrittenThroughIt) {
  write_case();
  ASSERT_EQ(seiche("run case.toml --out victim --quiet").exit, 0) << text("stderr.txt");
  const std::string final = text("victim/final.txt"), report = text("victim/report.html");
  Background run(directory, endless());
  ASSERT_TRUE(is_under_way()) << text("stderr.txt");
  fs::rename(directory / "out", directory / "moved");
  fs::create_directory_symlink("victim", directory / "out");
  EXPECT_EQ(run.end(SIGINT), 130);
  EXPECT_EQ(text("victim/final.txt"), final);
  EXPECT_EQ(text("victim/report.html"), report);
  EXPECT_EQ(json::parse(text("moved/summary.json"))["status"], "interrupted") << "where the run began";
  EXPECT_GT(SolutionReader(directory / "moved/solution.h5").count(), 2);
}

TEST_F(Survival, LinksThatWaitForARunAreNotFollowed) {
  write_case();
  fs::create_directory(directory / "out");
  write("victim", "");  // of what is empty nothing is lost: otherwise a link under the name of a result is refused
  for (const char* name :
       {"energy.csv.partial", "solution.h5.partial", "solution.xdmf.partial", "final.txt.partial",
        "summary.json.partial", "case.toml.partial", "report.html.partial", "checkpoint.seiche.partial", "energy.csv"})
    fs::create_symlink(directory / "victim", directory / "out" / name);
  const Result ran = seiche("run case.toml --out out --quiet --set checkpoint.every_steps=16 output.snapshot_every=1");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(text("victim"), "");
  for (const auto& entry : fs::directory_iterator(directory / "out")) EXPECT_FALSE(entry.is_symlink()) << entry.path();
}

TEST_F(Survival, LinksThatWaitForARecoveryAreNotFollowed) {
  write_case();
  Background run(directory, endless({"problem.points=256"}));
  ASSERT_TRUE(Background::wait_until([&] { return has("out/solution/000001.h5") && has("out/checkpoint.seiche"); }));
  EXPECT_EQ(run.end(SIGKILL), -SIGKILL);
  for (const fs::path name : {"energy.csv.partial", "solution"}) {
    fs::rename(directory / "out" / name, directory / "victim");
    fs::create_symlink(directory / "victim", directory / "out" / name);
    EXPECT_EQ(seiche("recover out").exit, 2) << name;
    EXPECT_THAT(text("stderr.txt"), HasSubstr(name.string())) << name;
    fs::remove(directory / "out" / name);
    fs::rename(directory / "victim", directory / "out" / name);
  }
  EXPECT_EQ(seiche("recover out").exit, 0) << text("stderr.txt");
}

TEST_F(Survival, AFolderOfSegmentsThatIsNoneIsRefusedBeforeTheFirstStep) {
  write_case();
  fs::create_directory(directory / "elsewhere");
  fs::create_directory(directory / "out");
  fs::create_directory_symlink(directory / "elsewhere", directory / "out/solution");
  EXPECT_EQ(seiche("run case.toml --out out --quiet").exit, 2);
  EXPECT_THAT(text("stderr.txt"), HasSubstr("out/solution is in the way"));
  fs::remove(directory / "out/solution");
  fs::create_directory(directory / "out/solution");
  // Nor is an HDF5 file ours where no case and no checkpoint says so.
  for (const std::string mine : {"mine", "\x89HDF\r\n\x1a\nmine"}) {
    write("out/solution/000001.h5", mine);
    EXPECT_EQ(seiche("run case.toml --out out --quiet").exit, 2);
    EXPECT_THAT(text("stderr.txt"), HasSubstr("Seiche did not write it"));
    EXPECT_EQ(text("out/solution/000001.h5"), mine);
  }
}

TEST_F(Survival, PicturesGoThroughNoLink) {
  write_case();
  ASSERT_EQ(seiche("run case.toml --out out --quiet").exit, 0);
  fs::create_directory(directory / "victim");
  write("victim/energy.png", "of another run");
  fs::create_directory_symlink(directory / "victim", directory / "out/figures");
  const Result drawn = seiche("plot out");
  EXPECT_EQ(drawn.exit, 2);
  EXPECT_THAT(drawn.err, HasSubstr("out/figures is a link"));
  ASSERT_EQ(seiche("run case.toml --out out --quiet").exit, 0) << "which removes pictures of an earlier run";
  EXPECT_EQ(text("victim/energy.png"), "of another run");
  EXPECT_EQ(std::distance(fs::directory_iterator(directory / "victim"), fs::directory_iterator()), 1);
}

// The loader takes an empty entry for the current folder, where any user may have put a library.
TEST_F(Survival, NoLibraryIsLookedForInTheCurrentFolder) {
  const std::string read =
      "readelf -d '" + test::program_path() + "' >'" + (directory / "dynamic.txt").string() + "' 2>/dev/null";
  if (std::system(read.c_str()) != 0) GTEST_SKIP() << "no readelf";
  for (const std::string& line : lines("dynamic.txt")) {
    if (line.find("RPATH") == std::string::npos && line.find("RUNPATH") == std::string::npos) continue;
    const std::size_t begin = line.find('[') + 1;
    const std::string path = ":" + line.substr(begin, line.rfind(']') - begin) + ":";
    EXPECT_THAT(path, Not(HasSubstr("::"))) << line;
    EXPECT_THAT(path, Not(HasSubstr(":."))) << line;
  }
}

// As Debian hardens its packages: protected stacks, checked copies, addresses that are read-only once they are known.
TEST_F(Survival, TheProgramIsHardened) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the sanitizers have checks of their own";
#endif
  const std::string read =
      "readelf -Wldh --dyn-syms '" + test::program_path() + "' >'" + (directory / "elf.txt").string() + "' 2>/dev/null";
  if (std::system(read.c_str()) != 0) GTEST_SKIP() << "no readelf";
  EXPECT_THAT(text("elf.txt"), AllOf(HasSubstr("GNU_RELRO"), HasSubstr("BIND_NOW"), HasSubstr("__stack_chk_fail"),
                                     HasSubstr("_chk@GLIBC"), HasSubstr("DYN (Position-Independent")));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
