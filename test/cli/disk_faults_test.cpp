// What a run leaves on a disk that fails at any write, and what one leaves that is killed at any call.
#include <test/support/program.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <seiche/record/checkpoint_file.hpp>
#include <seiche/study/audit/audit.hpp>

#include <algorithm>
#include <cerrno>
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

class DiskFaults : public Cli {
 protected:
  // With rows enough for several chunks, and a segment at most checkpoints.
  static constexpr const char* short_run =
      "run case.toml --out out --quiet --set problem.points=128 method.h=1/128 time.end=6 output.snapshot_every=1 "
      "output.energy_every=8 checkpoint.every_steps=151";

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
};

// What the newest checkpoint vouches for is there, and the sentence says so.
TEST_F(DiskFaults, WhicheverWriteFailsTheRunGoesOnFromItsNewestCheckpoint) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer has to be loaded first";
#endif
  write_case();
  ASSERT_EQ(seiche(short_run).exit, 0) << text("stderr.txt");
  fs::rename(directory / "out", directory / "whole");
  int resumed = 0, recovered = 0;
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
        if (has("out/summary.json") && !has("out/solution.h5")) {
          EXPECT_THAT(seiche("plot out").err, HasSubstr("`seiche resume out`")) << where;
          EXPECT_THAT(seiche("recover out").err, HasSubstr("saved")) << where;
          EXPECT_TRUE(has("out/solution.h5")) << where;
          ++recovered;
        }
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
  EXPECT_GT(recovered, 0);
}

// In a checkpoint too, whose rows are not called damaged.
TEST_F(DiskFaults, ADiskThatIsFullIsCalledSo) {
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
TEST_F(DiskFaults, AResumeThatIsKilledOrFailsLosesNothing) {
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
TEST_F(DiskFaults, WhatGetsItsNameIsOnTheDisk) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer has to be loaded first";
#endif
  write_case();
  const std::string preload = fmt::format("LD_PRELOAD='{}' ", failing_writes_path());
  const Result ran = seiche(
      "run case.toml --out out --quiet --set checkpoint.every_steps=16 problem.points=1024 output.snapshot_every=1",
      preload + "SEICHE_SYNC_LOG=log.txt");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const std::vector<std::string> log = lines("log.txt");
  std::set<std::string> named;
  for (std::size_t i = 1; i + 1 < log.size(); ++i) {
    if (!log[i].starts_with("name ")) continue;
    const std::string name = log[i].substr(5);
    named.insert(name);
    if (name == "checkpoint_prev.seiche") continue;  // on the disk before it had another name
    const bool is_segment = name.ends_with(".h5") && name != "solution.h5";
    EXPECT_EQ(log[i - 1], is_segment ? "sync solution.h5.partial" : "sync " + name + ".partial");
    EXPECT_EQ(log[i + 1], is_segment ? "sync solution" : "sync out") << name;
    if (is_segment && !named.contains("energy.csv")) {
      EXPECT_EQ(log[i + 2], "sync energy.csv.partial") << "and the checkpoint behind it";
    }
  }
  EXPECT_TRUE(named.contains("000003.h5"));
  EXPECT_LT(std::find(log.begin(), log.end(), "name 000001.h5"),
            std::find(log.begin(), log.end(), "name checkpoint.seiche"))
      << "already the first one vouches for a segment";
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
TEST_F(DiskFaults, AWriteThatWritesNothingIsAFullDisk) {
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

// What ensembles leave is small, and written at few places.
TEST_F(DiskFaults, AnEnsembleWhoseWriteFailsGoesOnToo) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer has to be loaded first";
#endif
  write_case();
  const std::string run =
      "run case.toml --out out --quiet --set time.end=4 ensemble.members=40 ensemble.perturb_initial=0.01 "
      "output.energy_every=1 checkpoint.every_steps=40";
  ASSERT_EQ(seiche(run).exit, 0) << text("stderr.txt");
  fs::rename(directory / "out", directory / "whole");
  int resumed = 0;
  for (const int error : {ENOSPC, EIO}) {
    for (int n = 1;; ++n) {
      fs::remove_all(directory / "out");
      const std::string where = fmt::format("write {} fails with {}", n, error);
      const Result result =
          seiche(run, fmt::format("LD_PRELOAD='{}' SEICHE_FAIL_AT={} SEICHE_FAIL_WITH={} {}", failing_writes_path(), n,
                                  error, error == EIO ? "SEICHE_FAIL_ONCE=1" : ""));
      if (result.exit == 0) break;
      ASSERT_LT(n, 2000) << "it never succeeds";
      if (result.exit == 2) continue;  // before the first step
      EXPECT_THAT(result.err, HasSubstr(std::strerror(error))) << where;
      if (!has("out/checkpoint.seiche") && !has("out/checkpoint_prev.seiche")) continue;
      EXPECT_THAT(result.err, HasSubstr("`seiche resume out` goes on from")) << where;
      const Result again = seiche("resume out --quiet");
      ASSERT_EQ(again.exit, 0) << where << "\n" << result.err << again.err;
      for (const char* name : {"energy.csv", "members.csv", "finals.csv"})
        ASSERT_TRUE(text(fs::path("whole") / name) == text(fs::path("out") / name)) << where << " " << name;
      ++resumed;
    }
  }
  EXPECT_GT(resumed, 5);
}

// Killed at whichever of its calls, a run or a resume leaves what `recover` makes a folder of that nothing contradicts.
class KilledAnywhere : public DiskFaults {
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
  void expect_recovered(const std::string& words, int stride = 1, bool begins_anew = false) const {
    for (int n = 1;; n += stride) {
      const std::string where = fmt::format("{} killed at {}: ", words, n);
      fs::remove_all(directory / "out");
      if (has("begun")) copy("begun", "out");
      if (!is_killed_at(words, n)) break;
      ASSERT_LT(n, 1000) << "it never succeeds";
      if (!has("out")) continue;
      const bool has_checkpoint = !checkpoints_in(directory / "out").empty();
      if (has_checkpoint) {
        const Result recovered = seiche("recover out");
        ASSERT_EQ(recovered.exit, 0) << where << recovered.err;
        ASSERT_FALSE(has("out/case_before_resume.toml")) << where << "a case of ours is put aside";
      }
      if (has("out/summary.json")) {
        for (const AuditEntry& entry : audit(directory / "out").entries)
          ASSERT_NE(entry.verdict, AuditEntry::Verdict::contradicted) << where << entry.claim << ": " << entry.evidence;
        ASSERT_TRUE(has_checkpoint || json::parse(text("out/summary.json"))["status"] == "success") << where;
      } else {
        ASSERT_FALSE(has_checkpoint) << where;
        ASSERT_TRUE(!has("begun") || begins_anew) << where << "the checkpoint is lost";
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
TEST_F(KilledAnywhere, ARunWhoseSegmentsAreNotJoinedDoesToo) {
  expect_recovered(run + "output.join_below=0 --out out", 2);
}
TEST_F(KilledAnywhere, ARunThatBeginsAnewDoesToo) {
  kill_a_run_behind_a_checkpoint();
  expect_recovered(run + "--out out --restart", 2, true);
}
TEST_F(KilledAnywhere, AResumeToANewEndDoesToo) {
  stop_a_run();
  expect_recovered(resume + " --until 1.5", 2);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
