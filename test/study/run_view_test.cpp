// A run that has not ended, as those see it who look at it: what its checkpoint vouches for, and nothing behind that.
#include <test/support/after_each_step.hpp>
#include <test/support/error_of.hpp>
#include <test/support/temporary_directory.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <seiche/config/case/case_file.hpp>
#include <seiche/driver/run_case.hpp>
#include <seiche/output/file/folder_lock.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/study/run_view.hpp>
#include <seiche/study/unfinished_run.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace seiche::test {
namespace TEST_FILE {

namespace fs = std::filesystem;
using testing::HasSubstr;

class RunViews : public InTemporaryDirectory {
 protected:
  struct Killed {};
  RunSpec spec(const std::string& points, const std::string& more = "") const {
    return parse_case("[problem]\nname = \"klein_gordon\"\n" + points +
                          "[method]\nh = \"1/64\"\n[time]\nend = 0.5\n[output]\nsnapshot_every = 2\nledger = \"on\"\n"
                          "[checkpoint]\nevery_steps = 7\n" +
                          more,
                      "case.toml", {}, directory);
  }
  // As a kill ends it: no error, and nothing behind the loop is done.
  void kill(const RunSpec& spec, const std::string& folder = "out") const {
    AfterEachStep kills([](const State& state) {
      if (state.n >= 25) throw Killed();
    });
    EXPECT_THROW(run_case(spec, directory / folder, {.observers = {&kills}}), Killed);
  }
};

TEST_F(RunViews, HoldTheRowsThatTheCheckpointVouchesFor) {
  // Many rows in a chunk, and one: with rows that the checkpoint holds itself, and in segments.
  for (const std::string points : {"points = 16\n", "points = [128, 130]\nlength = [1.0, 1.0]\n"}) {
    fs::remove_all(directory / "out");
    run_case(spec(points), directory / "whole", {});
    kill(spec(points));
    std::ofstream(directory / "out/energy.csv.partial", std::ios::app)
        << "0.39,0.1\n0.4,0.0";  // torn, and not vouched for
    const RunView view = view_of_run(directory / "out"), whole = view_of_run(directory / "whole");
    EXPECT_TRUE(whole.run.has_ended);
    EXPECT_FALSE(view.run.has_ended);
    EXPECT_EQ(view.run.t, 21.0 / 64);
    EXPECT_EQ(view.run.steps, 21);
    EXPECT_EQ(shortfall(view.run), "not finished, up to t = 0.328125");
    EXPECT_EQ(view.run.backend, whole.run.backend);
    EXPECT_EQ(view.run.energy.initial, whole.run.energy.initial);
    EXPECT_EQ(view.history.rows, 22);
    EXPECT_EQ(view.history.H.t.back(), 21.0 / 64);
    EXPECT_EQ(view.history.causes.size(), whole.history.causes.size());

    const SolutionReader shown(view.run.solution), all(whole.run.solution);
    ASSERT_EQ(shown.count(), 11);
    EXPECT_EQ(shown.parts().empty(), points == "points = 16\n");
    Vector one, other;
    for (Index k = 0; k < shown.count(); ++k) {
      EXPECT_EQ(shown.time(k), all.time(k));
      shown.state(k, one);
      all.state(k, other);
      ASSERT_TRUE(std::equal(one.begin(), one.end(), other.begin())) << k;
    }
    EXPECT_EQ(shown.meaning(0), all.meaning(0));
  }
}

// HDF5 takes % in the name of another file for the begin of a format.
TEST_F(RunViews, ShowEveryRowWhateverTheFolderIsCalledAndWhateverTheRunDoesMeanwhile) {
  const RunSpec plane = spec("points = [128, 130]\nlength = [1.0, 1.0]\n");
  kill(plane, "50%d %%");
  const RunView view = view_of_run(directory / "50%d %%");
  fs::remove_all(directory / "50%d %%" / "solution");
  const SolutionReader shown(view.run.solution);
  EXPECT_FALSE(shown.parts().empty());
  Vector values;
  for (Index k = 0; k < shown.count(); ++k) {
    shown.state(k, values);
    EXPECT_TRUE(values.allFinite()) << k;
  }
}

TEST_F(RunViews, LeaveNothingBehindAndChangeNothing) {
  kill(spec("points = 16\n"));
  const auto listed = [&] {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(directory / "out"))
      names.push_back(entry.path().string());
    return names;
  };
  const std::vector<std::string> before = listed();
  fs::create_directory(directory / "out/.seiche-view-999999999-abcdef");  // of a program that is gone
  fs::path temporary;
  {
    const RunView view = view_of_run(directory / "out");
    temporary = view.run.solution;
    EXPECT_TRUE(fs::exists(temporary));
  }
  EXPECT_FALSE(fs::exists(temporary.parent_path()));
  EXPECT_EQ(listed(), before);
}

TEST_F(RunViews, SayWhetherTheRunGoesOn) {
  kill(spec("points = 16\n"));
  EXPECT_EQ(unfinished_run(directory / "out")->how_far(), "not finished, up to t = 0.328125");
  {
    const FolderLock held{Folder(directory / "out")};
    EXPECT_EQ(unfinished_run(directory / "out")->how_far(), "still running, up to t = 0.328125");
  }
  fs::create_directory(directory / "begun");
  {
    const FolderLock held{Folder(directory / "begun")};
    EXPECT_THAT(error_of([&] { view_of_run(directory / "begun"); }), HasSubstr("has no checkpoint yet"));
  }
  EXPECT_THAT(error_of([&] { view_of_run(directory / "begun"); }), HasSubstr("no directory of a finished run"));
  const RunView view = view_of_run(directory / "out");
  EXPECT_NO_THROW(require_still_unfinished(view.run));
  std::ofstream(directory / "out/summary.json") << "{}";
  EXPECT_THAT(error_of([&] { require_still_unfinished(view.run); }), HasSubstr("ended while it was looked at"));
  EXPECT_FALSE(unfinished_run(directory / "out").has_value());
}

TEST_F(RunViews, TakeTheEarlierCheckpointWhereTheNewestIsDamaged) {
  kill(spec("points = 16\n"));
  fs::resize_file(directory / "out/checkpoint.seiche", 100);
  EXPECT_EQ(view_of_run(directory / "out").run.t, 14.0 / 64);
  fs::resize_file(directory / "out/checkpoint_prev.seiche", 100);
  EXPECT_THAT(error_of([&] { view_of_run(directory / "out"); }), HasSubstr("checkpoint.seiche is damaged"));
}

}  // namespace TEST_FILE
}  // namespace seiche::test
