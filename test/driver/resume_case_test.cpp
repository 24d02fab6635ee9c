// What a run leaves that was stopped and went on is what it would have left at once.
#include <test/support/temporary_directory.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/core/error.hpp>
#include <seiche/driver/run_case.hpp>
#include <seiche/driver/saved_run.hpp>
#include <seiche/output/hdf5/hdf5.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace seiche::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Stops the run after some step, as a signal would.
class StopsAfter : public Observer {
 public:
  explicit StopsAfter(std::int64_t n) : n_(n) {}
  bool is_due(const State& state, bool) const override {
    if (state.n >= n_) stop = true;
    return false;
  }
  void observe(const State&, const EnergyReading&) override {}
  void finish(const RunReport&) override {}
  mutable std::atomic<bool> stop = false;

 private:
  std::int64_t n_;
};

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<double> values(const Hdf5File& file, const std::string& name) {
  const Hdf5Dataset data = file.dataset(name);
  std::vector<double> all(data.rows() * data.row_size());
  data.read(0, all);
  return all;
}

class ResumeCase : public InTemporaryDirectory {
 protected:
  RunSpec spec(const std::string& text) const { return parse_case(text, "case.toml", {}, directory); }

  CaseResult run(const std::string& text, const std::string& folder, std::int64_t stops_after = -1) {
    return run_stopped(stops_after, [&](const RunCaseOptions& options) {
      return run_case(spec(text), directory / folder, options);
    });
  }
  CaseResult resume(const std::string& folder, std::int64_t stops_after = -1, std::optional<double> t_end = {}) {
    return run_stopped(stops_after,
                       [&](const RunCaseOptions& options) { return resume_case(directory / folder, t_end, options); });
  }
  template <class Run>
  CaseResult run_stopped(std::int64_t n, const Run& with) {
    StopsAfter stops(n < 0 ? std::int64_t{1} << 62 : n);
    RunCaseOptions options;
    options.begins = [&](const std::vector<std::string>& said) {
      notes = said;
      return &stops.stop;
    };
    options.observers = {&stops};
    return with(options);
  }

  void expect_same_files(const std::string& one, const std::string& other) const {
    for (const char* name : {"energy.csv", "final.txt", "solution.xdmf", "solution.h5"})
      EXPECT_TRUE(bytes_of(directory / one / name) == bytes_of(directory / other / name)) << other << " " << name;
    const Hdf5File a = Hdf5File::open(directory / one / "solution.h5");
    const Hdf5File b = Hdf5File::open(directory / other / "solution.h5");
    for (const char* name : {"t", "H", "H_modified", "u", "v", "q", "p", "x", "y"}) {
      EXPECT_EQ(a.has(name), b.has(name)) << name;
      if (!a.has(name)) continue;
      EXPECT_EQ(values(a, name), values(b, name)) << other << " " << name;
    }
    for (const char* name : {"status", "message", "energy_law", "title", "equation", "method", "backend"})
      EXPECT_EQ(text_attribute(a.id(), name), text_attribute(b.id(), name)) << other << " " << name;
  }

  std::vector<std::string> notes;
};

struct ACase {
  std::string name, text;
  std::int64_t most_steps;  // at which it may be stopped
};

const std::vector<ACase>& some_cases() {
  static const std::vector<ACase> cases = {
      {"wave",
       "[problem]\nname = \"klein_gordon\"\npoints = 16\n[method]\nname = \"seisav\"\nh = \"1/64\"\n"
       "[time]\nend = 4.01\n[output]\nsnapshot_every = 3\n",
       250},
      {"ledger",
       "[problem]\nname = \"klein_gordon\"\npoints = 16\n[method]\nname = \"seilm\"\nh = \"1/32\"\n"
       "[time]\nend = 3\n[output]\nsnapshot_every = 1\nledger = \"on\"\nenergy_every = 5\n",
       90},
      {"plane",
       "[problem]\nname = \"klein_gordon\"\npoints = [16, 12]\n[method]\nname = \"egc4\"\nh = \"1/16\"\n"
       "[time]\nend = 3\n[output]\nsnapshot_every = 1\n",
       45},
      {"variable",
       "[problem]\nname = \"klein_gordon\"\npoints = 16\n[method]\nname = \"egc6\"\ntolerance = 1e-5\n"
       "[time]\nend = 8\n",
       12},
      {"estimate",
       "[problem]\nname = \"oscillator\"\n[method]\nname = \"seisav\"\ntolerance = 1e-4\n"
       "[time]\nend = 5\n[output]\nsnapshot_interval = 0.01\n",
       60},
      {"formulas",
       "[problem]\nname = \"custom\"\nfields = [\"q\", \"p\"]\nH = \"p^2/2 + q^4/4\"\nD = { p = \"0.1*cos(t)^2\" }\n"
       "initial = { q = \"1\", p = \"0\" }\n[method]\nname = \"seisav\"\nh = 0.01\n[time]\nend = 25\n"
       "[output]\nsnapshot_every = 1\n",
       2400}};
  return cases;
}

TEST_F(ResumeCase, LeavesTheFilesOfARunThatWasNeverStopped) {
  for (const ACase& c : some_cases()) {
    run(c.text, c.name);
    for (const std::int64_t part : {1, 2, 5}) {
      const std::string folder = c.name + std::to_string(part);
      const CaseResult stopped = run(c.text, folder, c.most_steps * part / 6);
      ASSERT_EQ(stopped.report.status, RunReport::Status::interrupted) << c.name << ": " << stopped.message;
      EXPECT_THAT(stopped.message, HasSubstr("seiche resume")) << c.name;
      const CaseResult rest = resume(folder);
      EXPECT_EQ(rest.report.status, RunReport::Status::success) << c.name << ": " << rest.message;
      expect_same_files(c.name, folder);
      EXPECT_FALSE(has_checkpoint(directory / folder)) << "of a run that has come to its end";
    }
  }
}

TEST_F(ResumeCase, GoesOnAsOftenAsItIsStopped) {
  const ACase& c = some_cases().front();
  run(c.text, "whole");
  run(c.text, "pieces", 10);
  for (std::int64_t n = 30; n < 250; n += 37)
    EXPECT_EQ(resume("pieces", n).report.status, RunReport::Status::interrupted);
  const CaseResult last = resume("pieces");
  expect_same_files("whole", "pieces");
  const auto summary = nlohmann::json::parse(last.summary);
  EXPECT_EQ(summary["resumed_at"].size(), 7U);
  EXPECT_EQ(summary["steps"], 257);
}

TEST_F(ResumeCase, GoesFartherThanItsCase) {
  const ACase& c = some_cases().front();
  std::string longer = c.text;
  longer.replace(longer.find("4.01"), 4, "5.00");
  run(longer, "whole");
  run(c.text, "farther", 100);
  resume("farther", -1, 5.0);
  expect_same_files("whole", "farther");
  EXPECT_THAT(bytes_of(directory / "farther/case.toml"), HasSubstr("end = 5.0"));
}

TEST_F(ResumeCase, RefusesAnEndBeforeTheCheckpoint) {
  run(some_cases().front().text, "out", 100);
  EXPECT_THROW(resume("out", -1, 1.0), Error);
  EXPECT_EQ(resume("out").report.status, RunReport::Status::success) << "nothing is lost by that";
}

TEST_F(ResumeCase, ANewRunDoesNotTakeItsPlace) {
  run(some_cases().front().text, "out", 100);
  try {
    run(some_cases().front().text, "out");
    FAIL() << "the checkpoint is gone";
  } catch (const Error& error) {
    for (const char* way : {"seiche resume", "--restart"}) EXPECT_THAT(error.what(), HasSubstr(way));
  }
  EXPECT_EQ(resume("out").report.status, RunReport::Status::success);
}

class DamagedCheckpoint : public ResumeCase {
 protected:
  // Two checkpoints, at steps 100 and 120.
  void SetUp() override {
    ResumeCase::SetUp();
    run(text_, "whole");
    run(text_, "out", 120);
    ASSERT_TRUE(fs::exists(directory / "out" / earlier_checkpoint_name));
  }
  void overwrite(const std::string& name, std::size_t at, char value) const {
    std::fstream file(directory / "out" / name, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(at));
    file.put(value);
  }
  const std::string text_ = some_cases().front().text + "[checkpoint]\nevery_steps = 50\n";
};

TEST_F(DamagedCheckpoint, IsReplacedByTheOneBefore) {
  const std::string bytes = bytes_of(directory / "out" / checkpoint_name);
  for (const std::size_t at : {std::size_t{3}, std::size_t{30}, bytes.size() / 2, bytes.size() - 1}) {
    overwrite(checkpoint_name, at, static_cast<char>(~bytes[at]));
    std::vector<std::string> said;
    const Checkpoint found = newest_checkpoint(Folder(directory / "out"), said);
    EXPECT_EQ(found.name, earlier_checkpoint_name) << at;
    EXPECT_EQ(found.run.steps, 100);
    ASSERT_EQ(said.size(), 1U);
    EXPECT_THAT(said.front(), HasSubstr(checkpoint_name));
    overwrite(checkpoint_name, at, bytes[at]);
  }
  fs::resize_file(directory / "out" / checkpoint_name, bytes.size() - 7);
  const CaseResult rest = resume("out");
  EXPECT_THAT(rest.message, HasSubstr("checkpoint.seiche is of no use")) << "that is said";
  expect_same_files("whole", "out");
}

TEST_F(DamagedCheckpoint, IsNotFollowedWhereTheFilesAreOthers) {
  std::string csv = bytes_of(directory / "out/energy.csv");
  overwrite("energy.csv", 40, csv[40] == '1' ? '2' : '1');
  EXPECT_THROW(resume("out"), Error);
  overwrite("energy.csv", 40, csv[40]);
  EXPECT_EQ(resume("out").report.status, RunReport::Status::success);
  expect_same_files("whole", "out");
}

}  // namespace
}  // namespace seiche::test
