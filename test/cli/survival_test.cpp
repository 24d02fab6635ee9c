// What a run leaves when something goes wrong: a disk that fails at any write, a program that is killed, a folder
// that is taken away, signals one after the other.
#include <test/support/background.hpp>
#include <test/support/error_of.hpp>
#include <test/support/program.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <seiche/core/error.hpp>
#include <seiche/driver/going_on.hpp>
#include <seiche/study/audit/audit.hpp>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <set>
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
  // With rows enough for several chunks, and a segment at most checkpoints.
  static constexpr const char* short_run =
      "run case.toml --out out --quiet --set problem.points=128 method.h=1/128 time.end=6 output.snapshot_every=1 "
      "output.energy_every=8 checkpoint.every_steps=151";

  static std::vector<std::string> endless(const std::string& problem = "") {
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
    if (!problem.empty()) words.push_back(problem);
    return words;
  }
  bool has(const fs::path& name) const { return fs::exists(directory / name); }
  // A run that has a checkpoint.
  bool is_under_way() const {
    return Background::wait_until([&] { return has("out/checkpoint.seiche"); });
  }
  void copy(const fs::path& from, const fs::path& to) const {
    fs::remove_all(directory / to);
    fs::copy(directory / from, directory / to, fs::copy_options::recursive);
  }
  void expect_same_files(const std::string& one, const std::string& other, const std::string& where) const {
    for (const char* name : {"final.txt", "energy.csv", "solution.h5"})
      ASSERT_TRUE(text(fs::path(one) / name) == text(fs::path(other) / name)) << where << " " << name;
    if (has(fs::path(other) / "solution")) seiche("recover " + other);  // killed before it had removed its segments
    EXPECT_FALSE(has(fs::path(other) / "solution")) << where;
  }
  void expect_beginning_of(const SolutionReader& whole, const fs::path& left, const std::string& where) const {
    const SolutionReader solution(directory / left);
    for (Index k = 0; k < solution.count(); ++k) {
      ASSERT_EQ(solution.time(k), whole.time(k)) << where;
      ASSERT_EQ(state(solution, k), state(whole, k)) << where;
    }
    EXPECT_FALSE(solution.text("status").empty()) << where;
    EXPECT_FALSE(solution.text("case").empty()) << where;
  }
};

// What the newest checkpoint vouches for is there, and the sentence says so.
TEST_F(Survival, WhicheverWriteFailsTheRunGoesOnFromItsNewestCheckpoint) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer has to be loaded first";
#endif
  write_case();
  ASSERT_EQ(seiche(short_run).exit, 0) << text("stderr.txt");
  fs::rename(directory / "out", directory / "whole");
  int resumed = 0;
  for (const auto& [error, once] : {std::pair(ENOSPC, false), std::pair(EIO, true), std::pair(EDQUOT, false)}) {
    for (int n = once ? 2 : 1;; n += 17) {
      fs::remove_all(directory / "out");
      const std::string where = fmt::format("write {} fails with {}{}", n, error, once ? " once" : "");
      const Result result =
          seiche(short_run, fmt::format("LD_PRELOAD='{}' SEICHE_FAIL_AT={} SEICHE_FAIL_WITH={} {}",
                                        failing_writes_path(), n, error, once ? "SEICHE_FAIL_ONCE=1" : ""));
      if (result.exit == 0) break;
      ASSERT_LT(n, 2000) << "it never succeeds";
      if (result.exit == 2) continue;  // before the first step
      ASSERT_EQ(result.exit, 1) << where << result.err;
      EXPECT_THAT(result.err, HasSubstr(std::strerror(error))) << where;
      if (has("out/checkpoint.seiche") || has("out/checkpoint_prev.seiche")) {
        EXPECT_THAT(result.err, HasSubstr("`seiche resume out` goes on from")) << where;
        const Result again = seiche("resume out --quiet");
        ASSERT_EQ(again.exit, 0) << where << "\n" << result.err << again.err;
        expect_same_files("whole", "out", where);
        ++resumed;
      } else if (once) {
        EXPECT_EQ(json::parse(text("out/summary.json"))["status"], "failed") << where;
      }
    }
  }
  EXPECT_GT(resumed, 20);
}

// In a checkpoint too, whose rows are not called damaged.
TEST_F(Survival, ADiskThatIsFullIsCalledSo) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer has to be loaded first";
#endif
  write_case();
  int failed = 0;
  for (int n = 40;; ++n) {
    fs::remove_all(directory / "out");
    const Result result = seiche(
        "run case.toml --out out --quiet --set problem.points=128 method.h=1/128 time.end=4 output.snapshot_every=1 "
        "output.energy_every=8 output.report=off checkpoint.every_steps=151",
        fmt::format("LD_PRELOAD='{}' SEICHE_FAIL_AT={} SEICHE_FAIL_WITH={}", failing_writes_path(), n, ENOSPC));
    if (result.exit == 0) break;
    ASSERT_LT(n, 1000) << "it never succeeds";
    EXPECT_THAT(result.err, AllOf(HasSubstr(std::strerror(ENOSPC)), Not(HasSubstr("inflate")))) << n;
    ++failed;
  }
  EXPECT_GT(failed, 30);
}

// Whatever happens to a resume, at every fifth of its calls: the next one ends as if nothing had, since nothing that
// the checkpoint vouches for is written again.
TEST_F(Survival, AResumeThatIsKilledOrFailsLosesNothing) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer has to be loaded first";
#endif
  write_case();
  const std::string words =
      "run case.toml --quiet --set problem.points=256 method.h=1/128 time.end=3 output.snapshot_every=1 "
      "output.energy_every=2 checkpoint.every_steps=100 --out ";
  ASSERT_EQ(seiche(words + "whole").exit, 0) << text("stderr.txt");
  const auto with = [&](const std::string& fault) {
    return fmt::format("LD_PRELOAD='{}' {}", failing_writes_path(), fault);
  };
  // Killed between two checkpoints, the second of which is not the last.
  for (int n = 20; !has("stopped/checkpoint_prev.seiche") || has("stopped/summary.json"); ++n) {
    fs::remove_all(directory / "stopped");
    seiche(words + "stopped", with(fmt::format("SEICHE_KILL_AT={}", n)));
    ASSERT_LT(n, 1000) << "no kill leaves two checkpoints";
  }
  for (const std::string fault : {"SEICHE_KILL_AT={}", "SEICHE_FAIL_WITH=5 SEICHE_FAIL_ONCE=1 SEICHE_FAIL_AT={}",
                                  "SEICHE_FAIL_WITH=28 SEICHE_FAIL_AT={}"}) {
    int faults = 0;
    for (int n = 1;; n += 5) {
      const std::string where = fmt::format(fmt::runtime(fault), n);
      copy("stopped", "out");
      const Result resumed = seiche("resume out --quiet", with(where));
      if (resumed.exit == 0 && has("out/report.html")) break;
      ++faults;
      ASSERT_LT(n, 1000) << "it never succeeds";
      if (has("out/checkpoint.seiche") || has("out/checkpoint_prev.seiche")) {
        const Result again = seiche("resume out --quiet");
        ASSERT_EQ(again.exit, 0) << where << "\n" << resumed.err << again.err;
      }
      expect_same_files("whole", "out", where);
    }
    EXPECT_GT(faults, 4) << fault;
  }
}

// What has a name is whole after a power cut too: its bytes are on the disk before, and the name is after.
TEST_F(Survival, WhatGetsItsNameIsOnTheDisk) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer has to be loaded first";
#endif
  write_case();
  const std::string preload = fmt::format("LD_PRELOAD='{}' ", failing_writes_path());
  const Result ran =
      seiche("run case.toml --out out --quiet --set checkpoint.every_steps=32", preload + "SEICHE_SYNC_LOG=log.txt");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const std::vector<std::string> log = lines("log.txt");
  std::set<std::string> named;
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (!log[i].starts_with("name ")) continue;
    const std::string name = log[i].substr(5);
    named.insert(name);
    const bool is_moved = name == "checkpoint_prev.seiche";  // on the disk before it had another name
    const auto before =
        std::find(log.begin(), log.begin() + static_cast<std::ptrdiff_t>(i), "sync " + name + ".partial");
    EXPECT_TRUE(is_moved || before != log.begin() + static_cast<std::ptrdiff_t>(i)) << name;
    EXPECT_TRUE(std::find(log.begin() + static_cast<std::ptrdiff_t>(i), log.end(), "sync out") != log.end()) << name;
  }
  for (const char* name : {"case.toml", "energy.csv", "solution.h5", "final.txt", "summary.json", "checkpoint.seiche"})
    EXPECT_TRUE(named.contains(name)) << name;

  fs::remove_all(directory / "out");
  const Result failed = seiche("run case.toml --out out --quiet", preload + fmt::format("SEICHE_FAIL_SYNC={}", EIO));
  EXPECT_EQ(failed.exit, 2) << "case.toml is the first";
  EXPECT_THAT(failed.err, HasSubstr(std::strerror(EIO)));
  EXPECT_EQ(seiche("run case.toml --out out --quiet", preload + fmt::format("SEICHE_FAIL_SYNC={}", EINVAL)).exit, 0)
      << "a file system that cannot";
}

// Repeated by us, it would never end; HDF5 repeats its own.
TEST_F(Survival, AWriteThatWritesNothingIsAFullDisk) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer has to be loaded first";
#endif
  write_case();
  int full = 0;
  for (const int n : {2, 3, 40, 100}) {
    fs::remove_all(directory / "out");
    const Result result =
        seiche(short_run,
               fmt::format("LD_PRELOAD='{}' SEICHE_FAIL_AT={} SEICHE_FAIL_WITH=0 SEICHE_FAIL_ONCE=1 timeout 60",
                           failing_writes_path(), n));
    ASSERT_THAT(result.exit, AnyOf(0, 1, 2)) << n << result.err;
    if (result.exit == 0) continue;
    EXPECT_THAT(result.err, HasSubstr(std::strerror(ENOSPC))) << n;
    ++full;
  }
  EXPECT_GT(full, 0);
}

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
  for (const std::string problem : {"", "problem.name=truss", "method.tolerance=1e-4"}) {
    fs::remove_all(directory / "out");
    if (problem == "problem.name=truss")
      write("case.toml", "[problem]\nname = \"truss\"\n[method]\nh = \"1/64\"\n[time]\nend = 1.0\n");
    Background run(directory, endless(problem));
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

// Killed at whichever of its calls, a run or a resume leaves what `recover` makes a folder of that nothing contradicts.
class KilledAnywhere : public Survival {
 protected:
  void SetUp() override {
#if defined(SEICHE_SANITIZED)
    GTEST_SKIP() << "the address sanitizer has to be loaded first";
#endif
    write_case();
  }
  const std::string run =
      "run case.toml --quiet --set problem.points=1024 output.snapshot_every=4 output.energy_every=16 output.report=off "
      "checkpoint.every_steps=24 ";
  const std::string resume = "resume out --quiet";

  bool is_killed_at(const std::string& words, int n) const {
    return seiche(words, fmt::format("LD_PRELOAD='{}' SEICHE_KILL_AT={}", failing_writes_path(), n)).exit != 0;
  }
  void stop_a_run() const { ASSERT_EQ(seiche(run + "--out begun --max-hours 1e-9").exit, 130) << text("stderr.txt"); }
  void kill_a_run_behind_a_checkpoint() const {
    for (int n = 20; !has("begun/checkpoint.seiche") || has("begun/summary.json"); ++n) {
      fs::remove_all(directory / "begun");
      ASSERT_TRUE(is_killed_at(run + "--out begun", n)) << "no kill leaves a checkpoint";
    }
  }
  // In a copy of `begun`, if there is one, at every `stride`-th call until it succeeds.
  void expect_recovered(const std::string& words, int stride = 1) const {
    for (int n = 1;; n += stride) {
      const std::string where = fmt::format("{} killed at {}: ", words, n);
      fs::remove_all(directory / "out");
      if (has("begun")) copy("begun", "out");
      if (!is_killed_at(words, n)) break;
      ASSERT_LT(n, 1000) << "it never succeeds";
      if (!has("out")) continue;
      if (!checkpoints_in(directory / "out").empty()) {
        const std::string refusal = error_of([&] {
          const RunCaseOptions options{.stops_at_once = true};
          resume_case(going_on(directory / "out", {}, options), options);
        });
        ASSERT_EQ(refusal, "") << where;
        for (const AuditEntry& entry : audit(directory / "out").entries)
          ASSERT_NE(entry.verdict, AuditEntry::Verdict::contradicted) << where << entry.claim << ": " << entry.evidence;
      } else if (!has("out/summary.json")) {
        ASSERT_FALSE(has("begun")) << where << "the checkpoint is lost";
        ASSERT_EQ(seiche("run case.toml --out out --quiet").exit, 0) << where << "nothing is lost by that";
      }
    }
  }
};

TEST_F(KilledAnywhere, ARunLeavesWhatIsRecoveredAndPassesTheAudit) { expect_recovered(run + "--out out"); }
TEST_F(KilledAnywhere, TheResumeOfAStoppedRunDoesToo) {
  stop_a_run();
  expect_recovered(resume);
}
TEST_F(KilledAnywhere, TheResumeOfAKilledRunDoesToo) {
  kill_a_run_behind_a_checkpoint();
  expect_recovered(resume);
}
TEST_F(KilledAnywhere, AResumeToANewEndDoesToo) {
  stop_a_run();
  expect_recovered(resume + " --until 1.5", 2);
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
  Background run(directory, endless("problem.points=256"));
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
  write("out/solution/000001.h5", "mine");
  EXPECT_EQ(seiche("run case.toml --out out --quiet").exit, 2);
  EXPECT_THAT(text("stderr.txt"), HasSubstr("Seiche did not write it"));
  EXPECT_EQ(text("out/solution/000001.h5"), "mine");
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
