// Several processes that run one case leave the files of one process.
#include <test/support/after_each_step.hpp>
#include <test/support/error_of.hpp>
#include <test/support/temporary_directory.hpp>
#include <test/support/text_of.hpp>
#include <test/support/thread_ranks.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/driver/follow_case.hpp>
#include <seiche/driver/going_on.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct OneCase {
  std::string name, text;
};

constexpr const char* bump = "{ u = \"exp(-(x-1)^2-y^2) + 0.001*sin(j)\", v = \"0.1*sin(x+2*y)\" }";

std::string text_of_case(const std::string& problem, const std::string& method, const std::string& output) {
  return fmt::format(
      "[problem]\n{}\n[backend]\nname = \"modal\"\n[method]\n{}\n[output]\n{}\n"
      "[checkpoint]\nevery_seconds = 0\nevery_steps = 7\n",
      problem, method, output);
}
std::string wave(const std::string& problem, const std::string& method, const std::string& output) {
  return text_of_case(fmt::format("name = \"klein_gordon\"\ninitial = {}\n{}", bump, problem), method, output);
}

// Rows in chunks of several times, rows of which each fills chunks, steps by a tolerance with snapshots between, and
// whatever depends on the place.
std::vector<OneCase> cases() {
  const std::string plane = "points = [24, 20]\nlength = [6.0, 5.0]\nalpha = 1.0\n",
                    plane_damped = plane + "gamma = 0.3";
  const std::string seisav = "name = \"seisav\"\nh = 0.05\n[time]\nend = 1.0", few = "snapshot_every = 4";
  return {{"fixed", wave(plane_damped, "name = \"seisav\"\nh = 0.05\n[time]\nend = 1.5", few + "\nledger = \"on\"")},
          {"mixed_ends",
           wave("points = [9, 12, 7]\nlength = 4.0\nboundary = [\"dirichlet\", \"neumann\", \"periodic\"]\ngamma = 0.1",
                "name = \"egc4\"\nh = 0.05\n[time]\nend = 1.0", "snapshot_every = 3")},
          {"large_rows", wave("points = [300, 250]\nlength = 9.0\ngamma = 0.1",
                              "name = \"seisav\"\nh = 0.05\n[time]\nend = 0.5", "snapshot_every = 5")},
          {"tolerance",
           wave(plane_damped, "name = \"egc4\"\ntolerance = 1e-5\n[time]\nend = 2.0", "snapshot_interval = 0.25")},
          {"layer", wave(plane + "gamma = \"(0.3 + 0.2*sin(3*t))*(1 + cos(2*x)*sin(y)/2)\"", seisav, few)},
          {"driven", wave(plane_damped + "\nforce = \"0.3*cos(1.2*t)*exp(-x^2)\"", seisav, few + "\nledger = \"on\"")},
          {"friction",
           wave(plane + "friction = { kind = \"formula\", r = \"(1 + 0.5*sin(x))*v + v^3\" }", seisav, few)},
          {"friction_by_tolerance",
           wave(plane + "friction = { kind = \"quadratic\", coefficient = 0.5 }",
                "name = \"egc4\"\ntolerance = 1e-5\n[time]\nend = 1.0", "snapshot_interval = 0.25")},
          {"noise", wave(plane + "gamma = \"0.3*(1 + cos(2*x)*sin(y)/2)\"", seisav + "\n[noise]\ntemperature = 0.2",
                         few + "\nledger = \"on\"")},
          {"conserved_noise", text_of_case("name = \"cahn_hilliard\"\npoints = [24, 20]\nlength = [1.0, 1.0]",
                                           "name = \"seisav\"\nh = 1e-4\n[noise]\ntemperature = 1e-3\nseed = 3\n"
                                           "[time]\nend = 1e-3",
                                           few)},
          {"dealiased", wave(plane_damped + "\ndiscretisation = \"spectral\"\ndealias = \"two_thirds\"", seisav, few)},
          // Rows of several chunks, which end where slabs do not.
          {"large_3d", text_of_case("name = \"klein_gordon\"\npoints = [10, 288, 240]\nlength = [6.0, 5.0, 4.0]\n"
                                    "alpha = 1.0\ngamma = 0.2\ninitial = { u = \"exp(-x^2)*sin(3*y)\", v = \"z\" }",
                                    "name = \"seisav\"\nh = 0.05\n[time]\nend = 0.5", "snapshot_every = 5")},
          {"nls", text_of_case("name = \"nls\"\npoints = [24, 20]\nlength = [12.0, 10.0]\ngamma = 0.05\n"
                               "initial = { p = \"exp(-(x-6)^2-(y-5)^2)\", q = \"0.1*sin(x)\" }",
                               "name = \"seilm\"\nh = 0.02\n[time]\nend = 0.4", few)},
          {"custom", text_of_case("name = \"custom\"\npoints = [20, 16]\nlength = [6.0, 5.0]\n"
                                  "fields = [\"a\", \"b\", \"pa\", \"pb\"]\n"
                                  "S = [[0, 0, 1, 0], [0, 0, 0, 1], [-1, 0, 0, 0], [0, -1, 0, 0]]\n"
                                  "H = \"pa^2/2 + pb^2/2 + a_x^2/2 + b_y^2/2 + (1 + 0.3*sin(x))*a^2*b^2 + a^4/4\"\n"
                                  "D = { pa = 0.1, pb = 0.2 }\n"
                                  "initial = { a = \"sin(x)\", b = \"cos(y)\", pa = \"0\", pb = \"0\" }",
                                  "name = \"egc4\"\nh = 0.05\n[time]\nend = 1.0", few)}};
}

class CaseOnRanks : public InTemporaryDirectory {
 protected:
  RunSpec spec(const OneCase& c) const { return parse_case(c.text, c.name + ".toml", {}, directory); }

  // On so many processes: one, which knows of no others, or threads.
  CaseResult run(const OneCase& c, const std::string& folder, int processes, std::int64_t killed_behind = -1) const {
    return on(processes, killed_behind,
              [&](const RunCaseOptions& options) { return run_case(spec(c), directory / folder, options); });
  }
  CaseResult resume(const std::string& folder, int processes, std::int64_t killed_behind = -1) const {
    return on(
        processes, killed_behind,
        [&](const RunCaseOptions& options) {
          std::optional<GoingOn> from;
          const auto look = [&] { from = going_on(directory / folder, {}, options); };
          options.ranks != nullptr ? options.ranks->on_first(look) : look();
          return resume_case(std::move(*from), options);
        },
        true);
  }

  struct Killed {};

  template <class First>
  CaseResult on(int processes, std::int64_t killed_behind, const First& first, bool looks_before = false) const {
    if (processes == 1) return first({});
    CaseResult result;
    on_ranks(processes, [&](const Ranks& ranks) {
      AfterEachStep kills([&](const State& state) {
        if (killed_behind < 0 || state.n < killed_behind) return;
        double all = 0;
        ranks.max({&all, 1});  // all at once, since a process alone would leave others waiting
        throw Killed();
      });
      RunCaseOptions options;
      options.ranks = &ranks;
      options.observers = {&kills};
      if (ranks.here().index == 0) {
        result = first(options);
      } else {
        if (looks_before) ranks.on_first([] {});
        const CaseResult followed = follow_case(options);
        EXPECT_EQ(followed.report.status, RunReport::Status::success) << followed.message;
      }
    });
    return result;
  }

  void expect_same_files(const std::string& one, const std::string& other) const {
    for (const char* name : {"energy.csv", "final.txt", "solution.xdmf", "solution.h5"})
      EXPECT_TRUE(text_of(directory / one / name) == text_of(directory / other / name)) << other << " " << name;
    const auto summary = [&](const std::string& folder) {
      nlohmann::json json = nlohmann::json::parse(text_of(directory / folder / "summary.json"));
      for (const char* of_this_run : {"wall_seconds", "finished", "resumed_at", "resumed_with", "sha256", "processes"})
        json.erase(of_this_run);
      return json;
    };
    EXPECT_EQ(summary(one), summary(other)) << other;
  }
};

TEST_F(CaseOnRanks, FilesHaveTheBytesOfOneProcess) {
  for (const OneCase& c : cases()) {
    const CaseResult alone = run(c, c.name, 1);
    ASSERT_EQ(alone.report.status, RunReport::Status::success) << alone.message;
    for (const int processes : {2, 3, 7}) {
      const std::string folder = fmt::format("{}_on_{}", c.name, processes);
      const CaseResult result = run(c, folder, processes);
      EXPECT_EQ(result.message, alone.message);
      EXPECT_FALSE(fs::exists(directory / folder / "checkpoint.seiche"));
      expect_same_files(c.name, folder);
    }
  }
}

TEST_F(CaseOnRanks, AKilledRunGoesOnOnAnotherNumberOfProcessesToTheSameBytes) {
  for (const OneCase& c : cases()) {
    const CaseResult alone = run(c, c.name, 1);
    const std::string folder = c.name + "_killed";
    EXPECT_ANY_THROW(run(c, folder, 4, 8));
    ASSERT_TRUE(fs::exists(directory / folder / "checkpoint.seiche"));
    EXPECT_FALSE(fs::exists(directory / folder / "final.txt")) << "a kill writes nothing";
    if (alone.report.steps > 16) {
      EXPECT_ANY_THROW(resume(folder, 2, 15));
    }
    const CaseResult result = resume(folder, 3);
    EXPECT_EQ(result.report.status, RunReport::Status::success) << result.message;
    expect_same_files(c.name, folder);
  }
}

TEST_F(CaseOnRanks, WhatSeveralProcessesLeftOneGoesOnWithAndTheOtherWayRound) {
  const OneCase c = cases().front();
  run(c, c.name, 1);
  EXPECT_ANY_THROW(run(c, "left", 3, 9));
  resume("left", 1);
  expect_same_files(c.name, "left");
}

// The first process cannot begin its segment at the checkpoint of step 7, which ends the run on all of them.
TEST_F(CaseOnRanks, AFileThatCannotBeWrittenEndsTheRunOnAllProcesses) {
  const OneCase c = cases()[2];
  run(c, c.name, 1);
  std::string message;
  on_ranks(3, [&](const Ranks& ranks) {
    RunCaseOptions options;
    options.ranks = &ranks;
    AfterEachStep plants([&](const State& state) {
      if (state.n == 6) std::ofstream(directory / "planted" / "solution") << "not ours";
    });
    if (ranks.here().index > 0) {
      EXPECT_EQ(follow_case(options).report.status, RunReport::Status::failed);
      return;
    }
    options.observers = {&plants};
    const CaseResult result = run_case(spec(c), directory / "planted", options);
    EXPECT_EQ(result.report.status, RunReport::Status::failed);
    message = result.message;
  });
  EXPECT_THAT(message, HasSubstr("solution"));
}

// What one process throws while it records, the others do not know of.
TEST_F(CaseOnRanks, WhatFailsWhileAStateIsRecordedEndsTheRunAtTheRecordBefore) {
  const OneCase c = cases().front();
  std::string message;
  double t = 0;
  on_ranks(3, [&](const Ranks& ranks) {
    struct Fails final : Observer {
      bool is_due(const State& state, bool) const override { return state.n == 5; }
      void observe(const State&, const EnergyReading&) override { throw Error("there is no room"); }
      void finish(const RunReport&) override {}
    } fails;
    RunCaseOptions options;
    options.ranks = &ranks;
    if (ranks.here().index > 0) {
      const RunReport report = follow_case(options).report;
      EXPECT_EQ(report.status, RunReport::Status::failed);
      EXPECT_EQ(report.t, 0.2) << report.message;
      return;
    }
    options.observers = {&fails};
    const CaseResult result = run_case(spec(c), directory / "fails", options);
    message = result.message;
    t = result.report.t;
  });
  EXPECT_THAT(message, HasSubstr("there is no room"));
  EXPECT_EQ(t, 0.2);
}

// Of one process, too: what was recorded behind an observer that fails would lie beyond the end of the run.
TEST_F(CaseOnRanks, NothingIsRecordedBehindAnObserverThatFails) {
  struct Sees final : Observer {
    bool is_due(const State&, bool) const override { return true; }
    void observe(const State& state, const EnergyReading&) override {
      if (state.n == 5 && fails) throw Error("there is no room");
      last = state.n;
    }
    void skip(const State& state) override { skipped = state.n; }
    void finish(const RunReport&) override {}
    bool fails = false;
    std::int64_t last = -1, skipped = -1;
  } first, second;
  first.fails = true;
  RunCaseOptions options;
  options.observers = {&first, &second};
  const CaseResult result = run_case(spec(cases().front()), directory / "alone", options);
  EXPECT_THAT(result.message, HasSubstr("there is no room"));
  EXPECT_EQ(second.last, 4);
  EXPECT_EQ(second.skipped, 5);
}

// A signal reaches one of them.
TEST_F(CaseOnRanks, AStopOnOneProcessStopsAllWhichGoOnLater) {
  OneCase c = cases().front();
  c.text.replace(c.text.find("end = 1.5"), 9, "end = 15.0");
  run(c, "whole", 1);
  on_ranks(4, [&](const Ranks& ranks) {
    std::atomic<bool> stop = false;
    AfterEachStep asks([&](const State& state) {
      if (ranks.here().index == 2 && state.n == 20) stop = true;
    });
    RunCaseOptions options;
    options.ranks = &ranks;
    options.observers = {&asks};
    options.begins = [&] { return &stop; };
    const bool is_first = ranks.here().index == 0;
    const CaseResult result = is_first ? run_case(spec(c), directory / "stopped", options) : follow_case(options);
    EXPECT_EQ(result.report.status, RunReport::Status::interrupted) << result.message;
    EXPECT_LT(result.report.steps, 200);
    if (is_first) {
      EXPECT_THAT(result.message, HasSubstr("goes on from there"));
    }
  });
  EXPECT_TRUE(fs::exists(directory / "stopped" / "final.txt"));
  resume("stopped", 3);
  expect_same_files("whole", "stopped");
}

// The others do not write, and must learn of it: else they would wait for the first one for ever.
TEST_F(CaseOnRanks, WhatTheFirstProcessCannotDoEndsAll) {
  const OneCase c = cases().front();
  run(c, "taken", 1);
  std::ofstream(directory / "taken" / "energy.csv") << "not ours";
  EXPECT_THAT(error_of([&] { run(c, "taken", 3); }), HasSubstr("energy.csv"));
  fs::create_directory(directory / "taken" / "a");
  EXPECT_THAT(error_of([&] { resume("taken/a", 3); }), HasSubstr("holds no checkpoint"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
