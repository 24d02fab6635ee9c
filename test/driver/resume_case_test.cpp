// What a run leaves that was stopped and went on is what it would have left at once.
#include <test/support/after_each_step.hpp>
#include <test/support/error_of.hpp>
#include <test/support/temporary_directory.hpp>
#include <test/support/text_of.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/driver/going_on.hpp>
#include <seiche/output/hdf5/hdf5.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/study/audit/audit.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

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
    return run_stopped(stops_after, [&](const RunCaseOptions& options) {
      return resume_case(going_on(directory / folder, t_end, options), options);
    });
  }
  CaseResult recover(const std::string& folder) const {
    const RunCaseOptions options{.stops_at_once = true};
    return resume_case(going_on(directory / folder, {}, options), options);
  }
  template <class Run>
  CaseResult run_stopped(std::int64_t n, const Run& with) {
    StopsAfter stops(n < 0 ? std::int64_t{1} << 62 : n);
    RunCaseOptions options;
    options.begins = [&] { return &stops.stop; };
    options.introduce = [&](const std::string&, const std::vector<std::string>& said) { notes = said; };
    options.observers = {&stops};
    return with(options);
  }

  // A resume that is killed in its first step: no error ends it, and nothing that comes behind the loop is done.
  void kill_resume(const std::string& folder, std::optional<double> t_end = {}) const {
    struct Killed {};
    AfterEachStep kills([](const State&) { throw Killed(); });
    RunCaseOptions options;
    options.observers = {&kills};
    EXPECT_THROW(resume_case(going_on(directory / folder, t_end, options), options), Killed);
  }
  void write(const fs::path& name, const std::string& text) const {
    std::ofstream(directory / name, std::ios::binary) << text;
  }
  std::map<std::string, std::string> files_of(const std::string& folder) const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(directory / folder))
      if (entry.is_regular_file()) all[fs::relative(entry.path(), directory).string()] = text_of(entry.path());
    return all;
  }
  std::vector<std::string> contradicted(const std::string& folder) const {
    std::vector<std::string> all;
    for (const AuditEntry& entry : audit(directory / folder).entries)
      if (entry.verdict == AuditEntry::Verdict::contradicted) all.push_back(entry.claim + ": " + entry.evidence);
    return all;
  }

  void expect_same_files(const std::string& one, const std::string& other) const {
    for (const char* name : {"energy.csv", "final.txt", "solution.xdmf", "solution.h5"})
      EXPECT_TRUE(text_of(directory / one / name) == text_of(directory / other / name)) << other << " " << name;
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
       2400},
      {"noise",
       "[problem]\nname = \"klein_gordon\"\npoints = 16\ngamma = 0.3\n[method]\nname = \"egc4\"\nh = \"1/32\"\n"
       "[noise]\ntemperature = 0.1\nseed = 5\n[time]\nend = 3\n[output]\nsnapshot_every = 1\nledger = \"on\"\n",
       90}};
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
      EXPECT_THAT(checkpoints_in(directory / folder), testing::IsEmpty()) << "of a run that has come to its end";
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
  EXPECT_THAT(text_of(directory / "farther/case.toml"), HasSubstr("end = 5.0"));
}

// Before it has written a checkpoint of its own.
TEST_F(ResumeCase, GoesToTheNewEndThoughItWasKilledAtOnce) {
  const ACase& c = some_cases().front();
  std::string longer = c.text;
  longer.replace(longer.find("4.01"), 4, "5.00");
  run(longer, "whole");
  const double stopped_at = run(c.text, "out", 100).report.t;
  kill_resume("out", 5.0);
  for (const char* name : {"summary.json", "final.txt", "solution.xdmf", "report.html"})
    EXPECT_FALSE(fs::exists(directory / "out" / name)) << name << " tells of the end of before";
  const CaseResult rest = resume("out");
  EXPECT_EQ(rest.report.t, 5.0) << rest.message;
  expect_same_files("whole", "out");
  const auto summary = nlohmann::json::parse(rest.summary);
  ASSERT_EQ(summary["resumed_with"].size(), 1U);
  const auto& resumed = summary["resumed_with"][0];
  EXPECT_EQ(resumed["t"], stopped_at);
  EXPECT_EQ(resumed["versions"], summary["versions"]);
  EXPECT_EQ(resumed["settings"].size(), 1U);
  EXPECT_EQ(resumed["settings"]["time.end"], 5.0) << "the one that was killed had changed it";
}

TEST_F(ResumeCase, RefusesAnEndThatCannotBeAndChangesNothing) {
  run(some_cases().front().text, "out", 100);
  const auto before = files_of("out");
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double t_end : {nan, inf, 1e300, 1.0}) {
    EXPECT_NE(error_of([&] { resume("out", -1, t_end); }), "") << t_end;
    EXPECT_TRUE(files_of("out") == before) << t_end;
  }
  EXPECT_THAT(error_of([&] { resume("out", -1, nan); }), HasSubstr("must be a finite time"));
  EXPECT_EQ(resume("out").report.t, 4.01);
}

TEST_F(ResumeCase, LosesNothingWhereItsFilesCannotBeMade) {
  run(some_cases().front().text, "out", 100);
  const auto before = files_of("out");
  const fs::path in_the_way = directory / "out/energy.csv.partial";
  fs::create_directory(in_the_way);
  EXPECT_THAT(error_of([&] { resume("out"); }), HasSubstr("energy.csv.partial"));
  fs::remove(in_the_way);
  EXPECT_TRUE(files_of("out") == before);
  EXPECT_EQ(resume("out").report.status, RunReport::Status::success);
}

TEST_F(ResumeCase, KeepsEveryCaseThatItFinds) {
  run(some_cases().front().text, "out", 100);
  const std::string whole = text_of(directory / "out/case.toml");
  fs::create_directory(directory / "out/case_before_resume.toml");
  for (const auto& [mine, kept] :
       {std::pair("# mine", "case_before_resume_2.toml"), std::pair("# mine again", "case_before_resume_3.toml")}) {
    write("out/case.toml", mine);
    EXPECT_THAT(resume("out", 150).message, HasSubstr(kept));
    EXPECT_EQ(text_of(directory / "out" / kept), mine);
    EXPECT_EQ(text_of(directory / "out/case.toml"), whole);
  }
  EXPECT_EQ(text_of(directory / "out/case_before_resume_2.toml"), "# mine") << "also behind the second one";
}

TEST_F(ResumeCase, IsRecoveredWithTheCaseOfItsCheckpoint) {
  run(some_cases().front().text, "out", 100);
  const std::string whole = text_of(directory / "out/case.toml");
  for (const std::string damage : {"", "[[["}) {
    fs::remove(directory / "out/case.toml");
    if (!damage.empty()) write("out/case.toml", damage);
    EXPECT_EQ(recover("out").report.status, RunReport::Status::interrupted);
    EXPECT_EQ(text_of(directory / "out/case.toml"), whole) << damage;
    EXPECT_EQ(text_of(directory / "out/case_before_resume.toml"), damage);
    EXPECT_THAT(contradicted("out"), testing::IsEmpty());
  }
}

// Killed when its files are made, and before those of the end of before are replaced.
TEST_F(ResumeCase, IsRecoveredWithoutWhatTellsOfAnEarlierEnd) {
  for (const std::optional<double> t_end : {std::optional<double>(), std::optional(5.0)}) {
    fs::remove_all(directory / "out");
    run(some_cases().front().text, "out", 100);
    auto before = files_of("out");
    kill_resume("out", t_end);
    for (const std::string name : {"out/case.toml", "out/final.txt", "out/solution.xdmf", "out/report.html"})
      write(name, before[name]);
    const CaseResult recovered = recover("out");
    EXPECT_EQ(recovered.report.status, RunReport::Status::interrupted);
    EXPECT_THAT(recovered.message, HasSubstr("goes on from there"));
    EXPECT_THAT(contradicted("out"), testing::IsEmpty()) << t_end.value_or(4.01);
    EXPECT_EQ(resume("out").report.t, t_end.value_or(4.01));
  }
}

// What it leaves is what an interruption at the checkpoint would have left.
TEST_F(ResumeCase, IsRecoveredAsIfItHadBeenStoppedAtTheCheckpoint) {
  for (const ACase& c : some_cases()) {
    const std::int64_t n = c.most_steps / 2;
    const CaseResult stopped = run(c.text, c.name, n);
    run(c.text, c.name + "_killed", n);
    kill_resume(c.name + "_killed");
    const CaseResult recovered = recover(c.name + "_killed");
    expect_same_files(c.name, c.name + "_killed");
    EXPECT_EQ(recovered.report.steps, stopped.report.steps) << c.name;
    EXPECT_EQ(recovered.report.potential_counts.gradients, stopped.report.potential_counts.gradients) << c.name;
  }
}

TEST_F(ResumeCase, ShowsTheRowsOfARunThatWasNeverStoppedWhereTheyAreTooManyToBeJoined) {
  const std::string plane =
      "[problem]\nname = \"klein_gordon\"\npoints = [128, 130]\nlength = [1.0, 1.0]\n[method]\nh = \"1/64\"\n[time]\nend = 0.5\n"
      "[output]\nsnapshot_every = 2\n";
  run(plane, "whole");
  const std::string not_joined = plane + "join_below = 0\n[checkpoint]\nevery_steps = 5\n";
  run(not_joined, "out", 12);
  EXPECT_EQ(SolutionReader(directory / "out/solution.h5").parts().size(), 3U) << "up to steps 5, 10 and 12";
  EXPECT_THAT(contradicted("out"), testing::IsEmpty());
  recover("out");
  resume("out", 22);
  resume("out");
  EXPECT_THAT(contradicted("out"), testing::IsEmpty());
  const SolutionReader whole(directory / "whole/solution.h5"), shown(directory / "out/solution.h5");
  EXPECT_GT(shown.parts().size(), 4U);
  ASSERT_EQ(shown.times(), whole.times());
  EXPECT_EQ(shown.energies(), whole.energies());
  Vector one, other;
  for (Index k = 0; k < whole.count(); ++k) {
    whole.state(k, one);
    shown.state(k, other);
    ASSERT_TRUE(std::equal(one.begin(), one.end(), other.begin())) << k;
  }
  run(plane, "out");
  EXPECT_FALSE(fs::exists(directory / "out/solution"));
}

// Of steps that no solution was found for, and of one that failed: all there is is in the files, and the next run takes
// their place.
TEST_F(ResumeCase, IsNotOfferedWhereItWouldComeNoFarther) {
  const std::string begin =
      "[problem]\nname = \"custom\"\nfields = [\"q\", \"p\"]\nH = \"p^2/2 - q^4/4\"\n"
      "initial = { q = \"1\", p = \"0\" }\n[time]\nend = 50\n[checkpoint]\nevery_steps = 3\n[method]\nh = \"1/8\"\n";
  for (const std::string method : {"egc4", "seisav"}) {
    const std::string text = fmt::format("{}name = \"{}\"\n", begin, method);
    const CaseResult failed = run(text, method);
    ASSERT_EQ(failed.report.status, RunReport::Status::failed) << failed.message;
    EXPECT_EQ(failed.report.step_failed, method == "seisav") << failed.message;
    EXPECT_THAT(failed.message, Not(HasSubstr("seiche resume"))) << method;
    EXPECT_THAT(checkpoints_in(directory / method), testing::IsEmpty()) << method;
    EXPECT_EQ(run(text, method).message, failed.message) << method;
  }
}

// Into a folder in the place of the file that it would be, nothing is written.
TEST_F(ResumeCase, SaysWhyNoCheckpointIsWrittenAndWhichOneServes) {
  const std::string text = some_cases().front().text;
  StopsAfter stops(20);
  std::vector<std::string> warned;
  RunCaseOptions options;
  options.begins = [&] { return &stops.stop; };
  options.warn = [&](const std::string& note) { warned.push_back(note); };
  options.observers = {&stops};
  fs::create_directories(directory / "out/checkpoint.seiche.partial");
  const CaseResult first = run_case(spec(text), directory / "out", options);
  EXPECT_THAT(warned, testing::ElementsAre(AllOf(HasSubstr("no checkpoint was written at t = "),
                                                 HasSubstr("there is no earlier one"), Not(HasSubstr("goes on")))));
  EXPECT_THAT(first.message, Not(HasSubstr("seiche resume")));

  run(text, "again", 100);
  fs::create_directories(directory / "again/checkpoint.seiche.partial");
  const CaseResult second = resume("again", 150);
  EXPECT_THAT(second.message, HasSubstr("goes on from a checkpoint at t = "));
  fs::remove(directory / "again/checkpoint.seiche.partial");
  EXPECT_EQ(resume("again").report.status, RunReport::Status::success);
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

TEST_F(ResumeCase, GoesOnInAFolderThatIsRenamedMeanwhile) {
  for (const bool resumes : {false, true}) {
    const std::string out = resumes ? "again" : "out", moved = "moved_" + out;
    if (resumes) run(some_cases().front().text, out, 100);
    AfterEachStep renames([&](const State& state) {
      if (state.n == 150 && fs::exists(directory / out)) fs::rename(directory / out, directory / moved);
    });
    std::vector<std::string> warned;
    RunCaseOptions options;
    options.observers = {&renames};
    options.warn = [&](const std::string& note) { warned.push_back(note); };
    const CaseResult done = resumes ? resume_case(going_on(directory / out, {}, options), options)
                                    : run_case(spec(some_cases().front().text), directory / out, options);
    EXPECT_EQ(done.report.status, RunReport::Status::success) << done.message;
    EXPECT_THAT(warned, testing::ElementsAre(HasSubstr("there is no report.html")));
    EXPECT_FALSE(fs::exists(directory / out)) << "nothing is written where it was";
    for (const char* name : {"case.toml", "energy.csv", "final.txt", "solution.h5", "solution.xdmf", "summary.json"})
      EXPECT_TRUE(fs::exists(directory / moved / name)) << name;
    EXPECT_THAT(checkpoints_in(directory / moved), testing::IsEmpty());
    EXPECT_THAT(contradicted(moved), testing::IsEmpty());
  }
}

TEST_F(ResumeCase, RefusesAFolderThatCannotBeMade) {
  write("file", "mine");
  EXPECT_THAT(error_of([&] { run(some_cases().front().text, "file/out"); }), HasSubstr("cannot make the directory"));
  EXPECT_THAT(error_of([&] { run(some_cases().front().text, "file"); }), HasSubstr("file"));
  EXPECT_EQ(text_of(directory / "file"), "mine");
}

TEST_F(ResumeCase, RefusesAFolderThatIsReadOnly) {
  if (::geteuid() == 0) GTEST_SKIP() << "no permission binds root";
  const std::string& text = some_cases().front().text;
  run(text, "out", 100);
  const auto before = files_of("out");
  fs::permissions(directory / "out", fs::perms::owner_read | fs::perms::owner_exec);
  for (const std::string& said : {error_of([&] { resume("out"); }), error_of([&] { run(text, "out"); })})
    EXPECT_THAT(said, HasSubstr("cannot write"));
  fs::permissions(directory / "out", fs::perms::owner_all);
  EXPECT_TRUE(files_of("out") == before);
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
  const std::string bytes = text_of(directory / "out" / checkpoint_name);
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

TEST_F(DamagedCheckpoint, LeavesTheNewEndToTheOneBefore) {
  kill_resume("out", 5.0);
  fs::resize_file(directory / "out" / checkpoint_name, 100);
  EXPECT_EQ(resume("out").report.t, 5.0);
}

// A pipe without a writer would be waited for.
TEST_F(DamagedCheckpoint, IsNotFollowedWhereAPipeIsInThePlaceOfAFile) {
  for (const std::string name : {"energy.csv"}) {
    const fs::path file = directory / "out" / name, partial = directory / "out" / (name + ".partial");
    fs::rename(file, directory / "kept");
    for (const fs::path& place : {file, partial}) {
      ASSERT_EQ(::mkfifo(place.c_str(), 0600), 0);
      EXPECT_THAT(error_of([&] { resume("out"); }), HasSubstr(place.string() + " is not a file"));
      fs::remove(place);
      fs::create_directory(place);
      EXPECT_THAT(error_of([&] { resume("out"); }),
                  AnyOf(HasSubstr(place.string() + " is a folder"), HasSubstr(place.string() + ": Is a directory")));
      fs::remove(place);
    }
    fs::rename(directory / "kept", file);
  }
  EXPECT_EQ(resume("out").report.status, RunReport::Status::success);
}

TEST_F(DamagedCheckpoint, IsNotFollowedWhereTheFilesAreOthers) {
  std::string csv = text_of(directory / "out/energy.csv");
  overwrite("energy.csv", 40, csv[40] == '1' ? '2' : '1');
  EXPECT_THROW(resume("out"), Error);
  overwrite("energy.csv", 40, csv[40]);
  EXPECT_EQ(resume("out").report.status, RunReport::Status::success);
  expect_same_files("whole", "out");
}

}  // namespace TEST_FILE
}  // namespace seiche::test
