// What an ensemble leaves that was stopped and went on is what it would have left at once.
#include <test/support/error_of.hpp>
#include <test/support/temporary_directory.hpp>
#include <test/support/text_of.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/driver/going_on.hpp>
#include <seiche/driver/run_ensemble_case.hpp>
#include <seiche/study/audit/audit.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <filesystem>
#include <string>

namespace seiche::test {
namespace TEST_FILE {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ResumeEnsemble : public InTemporaryDirectory {
 protected:
  // Ended at the first record behind t, as by a signal; not where t is too late.
  class StopsBehind : public Observer {
   public:
    explicit StopsBehind(double t) : t_(t) {}
    bool is_due(const State&, bool) const override { return false; }
    void observe(const State&, const EnergyReading&) override {}
    void pass(const State& state) override { stop = stop || state.t > t_; }
    void finish(const RunReport&) override {}
    std::atomic<bool> stop = false;

   private:
    double t_;
  };

  RunSpec spec(double end) const {
    return parse_case(
        "[problem]\nname = \"klein_gordon\"\npoints = 8\n[method]\nname = \"seisav\"\nh = \"1/32\"\n[time]\nend = " +
            std::to_string(end) + "\n[output]\nenergy_every = 3\n[ensemble]\nmembers = 20\nperturb_initial = 1e-3\n",
        "case.toml", {}, directory);
  }
  EnsembleCaseResult run(const std::string& folder, double stops_behind = 1e9, double end = 4) const {
    StopsBehind stops(stops_behind);
    return run_ensemble_case(spec(end), directory / folder, options(stops));
  }
  EnsembleCaseResult resume(const std::string& folder, double stops_behind = 1e9,
                            std::optional<double> t_end = {}) const {
    StopsBehind stops(stops_behind);
    return resume_ensemble_case(going_on(directory / folder, t_end, options(stops)), options(stops));
  }
  static RunCaseOptions options(StopsBehind& stops) {
    RunCaseOptions all;
    all.begins = [&stops] { return &stops.stop; };
    all.observers = {&stops};
    return all;
  }
  nlohmann::json summary(const std::string& folder) const {
    return nlohmann::json::parse(text_of(directory / folder / "summary.json"));
  }
  void expect_same_files(const std::string& one, const std::string& other) const {
    for (const char* name : {"energy.csv", "members.csv", "finals.csv"})
      EXPECT_EQ(text_of(directory / one / name), text_of(directory / other / name)) << name;
    for (const char* key : {"status", "message", "statuses", "laws", "steps", "t", "energy", "counts", "certificate"})
      EXPECT_EQ(summary(one)[key], summary(other)[key]) << key;
  }
};

TEST_F(ResumeEnsemble, LeavesTheFilesOfOneThatWasNeverStopped) {
  run("whole");
  for (const double t : {0.0, 0.1, 1.0}) {
    fs::remove_all(directory / "out");
    const EnsembleCaseResult stopped = run("out", t);
    EXPECT_EQ(stopped.outcome.status(), RunReport::Status::interrupted) << t;
    EXPECT_THAT(stopped.outcome.message, HasSubstr("seiche resume")) << t;
    EXPECT_TRUE(audit(directory / "out").confirms()) << t;
    EXPECT_THAT(error_of([&] { run("out"); }), AllOf(HasSubstr("seiche resume"), HasSubstr("--restart")));
    resume("out", t + 0.5);
    const EnsembleCaseResult rest = resume("out");
    EXPECT_EQ(rest.outcome.status(), RunReport::Status::success) << rest.outcome.message;
    expect_same_files("whole", "out");
    EXPECT_THAT(checkpoints_in(directory / "out"), testing::IsEmpty());
    EXPECT_GE(summary("out")["resumed_at"].size(), 1U);
    EXPECT_TRUE(audit(directory / "out").confirms());
  }
}

TEST_F(ResumeEnsemble, GoesFartherThanItsCase) {
  run("whole", 1e9, 5);
  run("out", 1);
  resume("out", 1e9, 5.0);
  expect_same_files("whole", "out");
}

TEST_F(ResumeEnsemble, IsRecoveredWithoutGoingOn) {
  run("out", 1);
  fs::remove(directory / "out/summary.json");
  const RunCaseOptions at_once{.stops_at_once = true};
  const EnsembleCaseResult recovered = resume_ensemble_case(going_on(directory / "out", {}, at_once), at_once);
  EXPECT_EQ(recovered.outcome.status(), RunReport::Status::interrupted);
  EXPECT_FALSE(summary("out").contains("resumed_at"));
  EXPECT_TRUE(audit(directory / "out").confirms());
  run("whole");
  resume("out");
  expect_same_files("whole", "out");
}

// It is saved between two records.
TEST_F(ResumeEnsemble, SaysToWhichTimeItHadCome) {
  RunSpec seldom = spec(4);
  seldom.energy_every = 100;
  StopsBehind at_once(-1), never(1e9);
  run_ensemble_case(seldom, directory / "whole", options(never));
  const EnsembleCaseResult stopped = run_ensemble_case(seldom, directory / "out", options(at_once));
  EXPECT_THAT(stopped.outcome.message, HasSubstr("goes on from there"));
  const fs::path checkpoint = directory / "out/checkpoint.seiche";
  const SavedRun saved = read_checkpoint(checkpoint).run;
  EXPECT_EQ(saved.steps, 1);
  EXPECT_EQ(saved.t, 1.0 / 32);
  const std::string before = text_of(checkpoint);
  EXPECT_THAT(error_of([&] { resume("out", 1e9, 1.0 / 64); }), HasSubstr("the checkpoint is at t = 0.03125"));
  EXPECT_EQ(text_of(checkpoint), before);
  resume("out");
  expect_same_files("whole", "out");
}

TEST_F(ResumeEnsemble, RefusesFilesThatDoNotBeginAsTheyDid) {
  run("out", 1);
  fs::resize_file(directory / "out/energy.csv", 100);
  EXPECT_THAT(error_of([&] { resume("out"); }), HasSubstr("energy.csv has 100 bytes"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
