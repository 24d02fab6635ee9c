// seiche resume, and what signals leave for it.
#include <test/support/background.hpp>
#include <test/support/program.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <seiche/output/file/sha256.hpp>

#include <csignal>
#include <filesystem>
#include <string>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Background;
using testing::AllOf;
using testing::HasSubstr;

class CheckpointCli : public test::Cli {
 protected:
  void SetUp() override { write_case("", "h = \"1/512\""); }
  static std::string keys() { return "time.end=8000 output.energy_every=64 output.snapshot_every=8192"; }
  static std::string few_steps() { return "time.end=400 output.energy_every=64 output.snapshot_every=512"; }
  // A resume of a copy of `stopped`, in which a command of the shell has done something to the file that it calls F.
  Result resumed_behind(std::string way, const std::string& file) {
    fs::remove_all(directory / "out");
    fs::copy(directory / "stopped", directory / "out");
    for (std::size_t at = way.find('F'); at != std::string::npos; at = way.find('F')) way.replace(at, 1, file);
    EXPECT_EQ(std::system(("cd '" + directory.string() + "/out' && " + way).c_str()), 0) << way;
    return seiche("resume out --quiet", "timeout 200");
  }
  std::vector<std::string> arguments(const std::string& more = "time.end=8000") const {
    return {"run",
            "case.toml",
            "--quiet",
            "--out",
            "out",
            "--set",
            more,
            "output.energy_every=64",
            "output.snapshot_every=8192"};
  }
  bool has(const std::string& name) const { return fs::exists(directory / "out" / name); }
  fs::file_time_type written_at(const std::string& name) const {  // the least where it is not there
    std::error_code none;
    return fs::last_write_time(directory / "out" / name, none);
  }
  bool computes() const { return has("energy.csv.partial") && fs::file_size(directory / "out/energy.csv.partial") > 0; }
  // What is there is what a run leaves that is never stopped.
  void expect_whole(const std::string& with) const {
    if (!fs::exists(directory / "whole")) {
      ASSERT_EQ(seiche("run case.toml --quiet --out whole --set " + with).exit, 0);
    }
    for (const char* name : {"energy.csv", "final.txt", "solution.xdmf", "solution.h5"})
      EXPECT_TRUE(text(fs::path("out") / name) == text(fs::path("whole") / name)) << name;
    const SolutionReader whole(directory / "whole/solution.h5"), out(directory / "out/solution.h5");
    ASSERT_EQ(whole.times(), out.times());
    for (Index k = 0; k < whole.count(); ++k) ASSERT_EQ(state(whole, k), state(out, k)) << k;
  }
};

class CheckpointCliSlow : public CheckpointCli {};  // seconds, and ten times that under a sanitizer

TEST_F(CheckpointCliSlow, IsWhatEverySignalToEndLeaves) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    Background run(directory, arguments());
    ASSERT_TRUE(Background::wait_until([&] { return computes(); }));
    ASSERT_EQ(run.end(signal), 130) << signal << text("stderr.txt");
    EXPECT_EQ(json::parse(text("out/summary.json"))["status"], "interrupted");
    ASSERT_TRUE(has("checkpoint.seiche")) << signal;
    const Result resumed = seiche("resume out --quiet");
    EXPECT_EQ(resumed.exit, 0) << resumed.err;
    EXPECT_EQ(json::parse(text("out/summary.json"))["status"], "success");
    expect_whole(keys());
    fs::remove_all(directory / "out");
  }
}

TEST_F(CheckpointCli, IsReadByCheckWhichSaysWhetherItIsOfUse) {
  Background run(directory, arguments("time.end=1e7"));
  ASSERT_TRUE(Background::wait_until([&] { return computes(); }));
  ASSERT_EQ(run.end(SIGTERM), 130);
  const double t = json::parse(text("out/summary.json"))["t"];
  const Result said = seiche("check out/checkpoint.seiche"), as_json = seiche("check out/checkpoint.seiche --json");
  EXPECT_EQ(said.exit, 0) << said.err;
  EXPECT_THAT(said.out, AllOf(HasSubstr("of 10000000"), HasSubstr("seiche resume"), HasSubstr("goes on from there")));
  EXPECT_EQ(json::parse(as_json.out)["t"], t);
  EXPECT_EQ(json::parse(as_json.out)["usable"], true);
  EXPECT_THAT(seiche("check out/checkpoint.seiche --set method.h=1").err, HasSubstr("which keeps its own"));

  fs::resize_file(directory / "out/energy.csv", 10);
  const Result torn = seiche("check out/checkpoint.seiche");
  EXPECT_EQ(torn.exit, 1);
  EXPECT_THAT(torn.out, AllOf(HasSubstr("no run can go on from it"), HasSubstr("energy.csv has 10 bytes")));
  fs::resize_file(directory / "out/checkpoint.seiche", 500);
  const Result damaged = seiche("check out/checkpoint.seiche");
  EXPECT_EQ(damaged.exit, 2);
  EXPECT_THAT(damaged.err, HasSubstr("checkpoint.seiche is damaged"));
}

TEST_F(CheckpointCli, IsWhatUsr1AsksForAndTheRunGoesOn) {
  Background run(directory, arguments("time.end=1e7"));
  ASSERT_TRUE(Background::wait_until([&] { return computes(); }));
  run.send(SIGUSR1);
  EXPECT_TRUE(Background::wait_until([&] { return has("checkpoint.seiche"); }));
  EXPECT_FALSE(has("final.txt")) << "it goes on";
  EXPECT_EQ(run.end(SIGTERM), 130);
}

TEST_F(CheckpointCliSlow, OfARunThatWasKilledLeadsToTheSameFiles) {
  const std::string every_steps = "checkpoint.every_steps=400000";  // part of the case that solution.h5 holds
  for (int kills = 0; kills < 40; ++kills) {
    std::vector<std::string> words = kills == 0 ? arguments() : std::vector<std::string>{"resume", "out", "--quiet"};
    if (kills == 0) words.emplace_back(every_steps);
    Background run(directory, words);
    const auto before = written_at("checkpoint.seiche");
    const bool goes_on = Background::wait_until(
        [&] { return has("final.txt") || (has("checkpoint.seiche") && written_at("checkpoint.seiche") != before); });
    ASSERT_TRUE(goes_on) << text("stderr.txt");
    if (has("final.txt")) {
      EXPECT_EQ(run.end(0), 0) << text("stderr.txt");  // no signal: it has all but ended
      break;
    }
    EXPECT_EQ(run.end(SIGKILL), -SIGKILL);
  }
  expect_whole(keys() + " " + every_steps);
}

TEST_F(CheckpointCli, IsNotRemovedByAnotherRun) {
  ASSERT_EQ(seiche("run case.toml --out out --quiet --max-hours 1e-9 --set " + few_steps()).exit, 130);
  const Result again = seiche("run case.toml --quiet --out out");
  EXPECT_EQ(again.exit, 2);
  EXPECT_THAT(again.err, AllOf(HasSubstr("seiche resume out"), HasSubstr("--restart")));
  EXPECT_EQ(seiche("resume out --quiet").exit, 0);
  expect_whole(few_steps());
  EXPECT_EQ(seiche("resume out").exit, 2) << "that run has come to its end";
}

TEST_F(CheckpointCli, KeepsTheHashesOfItsFirstFiles) {
  const std::string first = "0.1 0.1 0.1 0.1 0 0 0 0\n0 0 0 0 0 0 0 0\n";
  write("z.txt", first);
  const std::string more = " 'problem.initial={file=\"z.txt\"}'";
  ASSERT_EQ(seiche("run case.toml --out out --quiet --max-hours 1e-9 --set " + few_steps() + more).exit, 130)
      << text("stderr.txt");
  write("z.txt", "0.2 0.1 0.1 0.1 0 0 0 0\n0 0 0 0 0 0 0 0\n");
  ASSERT_EQ(seiche("resume out --quiet").exit, 0) << text("stderr.txt");
  const json summary = json::parse(text("out/summary.json"));
  EXPECT_EQ(summary["sha256"][fs::canonical(directory / "z.txt").string()], sha256(first));
  EXPECT_EQ(summary["sha256"]["case.toml"], sha256(text("out/case.toml")));
  EXPECT_EQ(seiche("audit out").exit, 1);
  EXPECT_THAT(text("stdout.txt"), HasSubstr("z.txt has changed"));
}

TEST_F(CheckpointCli, EndsARunThatHasUsedItsHours) {
  const Result stopped = seiche("run case.toml --out out --max-hours 1e-9 --set " + few_steps());
  EXPECT_EQ(stopped.exit, 130);
  EXPECT_THAT(stopped.err, HasSubstr("after 1e-09 hours as asked; `seiche resume out` goes on from there"));
  const Result farther = seiche("resume out --until 401 --json");
  EXPECT_EQ(farther.exit, 0) << farther.err;
  EXPECT_EQ(json::parse(farther.out)["t"], 401);
  const Result audited = seiche("audit out");
  EXPECT_EQ(audited.exit, 0) << audited.out;
}

TEST_F(CheckpointCli, StopsAfterANumberOfHoursThatIsOne) {
  for (const char* hours : {"nan", "inf", "-1", "0", "1e999", "2h"}) {
    const std::string said = refused(std::string("run case.toml --out out --max-hours ") + hours);
    EXPECT_THAT(said, HasSubstr("no finite number > 0")) << hours;
    EXPECT_LT(said.size(), 200U) << hours;
  }
  // As every other option that is a number. The last one is a few microseconds.
  for (const char* hours : {"' 1'", "+5", "0x1p-30"}) {
    const Result ran =
        seiche(std::string("run case.toml --out out --restart --quiet --set time.end=0.1 --max-hours ") + hours);
    EXPECT_THAT(ran.exit, testing::AnyOf(0, 130)) << hours << ran.err;
  }
}

// A pipe without a writer, a device without an end, a folder, a hole of 8 GiB: the older one serves, and that is said.
TEST_F(CheckpointCli, IsPassedOverWithAWordWhereItIsNoPlainFile) {
  ASSERT_EQ(seiche("run case.toml --out stopped --quiet --max-hours 1e-9 --set " + few_steps()).exit, 130);
  fs::copy_file(directory / "stopped/checkpoint.seiche", directory / "stopped/checkpoint_prev.seiche");
  const std::vector<std::pair<std::string, std::string>> ways = {
      {"rm F; mkfifo F", "is not a file"},
      {"ln -sf /dev/zero F", "is a link"},
      {"ln -sf nowhere F", "is a link"},
      {"rm F; mkdir F", "is a folder"},
      {"truncate -s 8G F", "its last bytes are missing"},
      {"printf x | dd of=F bs=1 seek=40 conv=notrunc status=none", "its checksum is another"}};
  for (const auto& [way, word] : ways) {
    const Result resumed = resumed_behind(way, "checkpoint.seiche");
    EXPECT_EQ(resumed.exit, 0) << way << resumed.err;
    EXPECT_THAT(resumed.err, AllOf(HasSubstr("checkpoint.seiche is of no use"), HasSubstr(word))) << way;
  }
}

TEST_F(CheckpointCli, HoldsTheCaseWhateverBecameOfTheFile) {
  ASSERT_EQ(seiche("run case.toml --out stopped --quiet --max-hours 1e-9 --set " + few_steps()).exit, 130);
  const std::string whole = text("stopped/case.toml");
  for (const std::string way : {"rm F", "echo '[[[' >F", "rm F; mkfifo F", "rm F; mkdir F", "echo '# mine' >>F"}) {
    const Result resumed = resumed_behind(way, "case.toml");
    EXPECT_EQ(resumed.exit, 0) << way << resumed.err;
    EXPECT_THAT(resumed.err, HasSubstr("case.toml was")) << way;
    EXPECT_EQ(text("out/case.toml"), whole) << way;
    EXPECT_EQ(has("case_before_resume.toml"), way != "rm F") << "what the user wrote is kept";
    EXPECT_EQ(seiche("audit out").exit, 0) << way << text("stdout.txt");
  }
}

TEST_F(CheckpointCli, RunsWithoutAReaderOfItsMessages) {
  EXPECT_EQ(std::system(("cd '" + directory.string() + "' && bash -c \"'" + test::program_path() +
                         "' run case.toml --out closed 2> >(true)\"")
                            .c_str()),
            0);
  EXPECT_TRUE(fs::exists(directory / "closed/final.txt"));
}

}  // namespace TEST_FILE
}  // namespace seiche
