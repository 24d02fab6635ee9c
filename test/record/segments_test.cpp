#include <seiche/core/base/error.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/record/checkpoint_file.hpp>
#include <seiche/record/segments.hpp>
#include <seiche/record/whole_solution.hpp>
#include <test/support/error_of.hpp>
#include <test/support/paths.hpp>
#include <test/support/repetitions.hpp>
#include <test/support/temporary_directory.hpp>
#include <test/support/text_of.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace TEST_FILE {

using namespace seiche;
using namespace seiche::test;
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

SolutionAxis axis(const char* name, std::size_t size) {
  SolutionAxis axis{.name = name, .meaning = "where it is", .values = {}};
  for (std::size_t i = 1; i <= size; ++i) axis.values.push_back(static_cast<double>(i));
  return axis;
}

SolutionLayout laid_out(std::vector<std::string> fields, std::vector<SolutionAxis> axes) {
  SolutionLayout layout;
  layout.fields = std::move(fields);
  layout.axes = std::move(axes);
  return layout;
}

// The columns of a solution, and rows that are told from one another.
struct Solution {
  std::string name;
  SolutionLayout layout;
  bool has_modified = true;

  Segments segments(const fs::path& directory, SegmentsMark mark = {}, double join_below = 8e9) const {
    return Segments(Folder(directory), layout, {.texts = {{"title", name}}}, has_modified, std::move(mark), join_below);
  }
  std::vector<double> state(std::uint64_t row) const {
    std::vector<double> values(layout.fields.size() * layout.points());
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = std::sin(0.01 * static_cast<double>(i)) + static_cast<double>(row);
    return values;
  }
  static double time(std::uint64_t row) { return 0.5 * static_cast<double>(row); }
  static double energy(std::uint64_t row) { return 1 / (1.0 + static_cast<double>(row)); }
  void append(Segments& to, std::uint64_t row) const {
    const double H = energy(row), t = time(row);
    const std::vector<double> numbers = has_modified ? std::vector{H, 2 * H, t} : std::vector{H, t};
    to.append(state(row), numbers);
  }
};

// Chunks of many rows, of few, of one, of less than a row; of one point.
std::vector<Solution> solutions() {
  SolutionLayout truss = laid_out({"q", "p"}, {axis("point", 3)});
  truss.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  truss.supports = {{1, 1, 0}};
  truss.bars = {{0, 1}, {1, 2}, {2, 3}};
  return {{"line", laid_out({"u", "v"}, {axis("x", 20)})},
          {"few", laid_out({"u"}, {axis("x", 4096)}), false},
          {"plane", laid_out({"u", "v"}, {axis("x", 96), axis("y", 128)})},
          {"large", laid_out({"u"}, {axis("x", 70), axis("y", 1000)})},
          {"point", laid_out({"u", "v"}, {})},
          {"truss", truss}};
}

const RunReport& success() {
  static const RunReport report = [] {
    RunReport made;
    made.message = "reached the end";
    return made;
  }();
  return report;
}

// 8 chunks in 4 segments.
SegmentsMark sealed_four_times(const Solution& solution, const fs::path& directory) {
  Segments segments = solution.segments(directory);
  const std::uint64_t chunk = solution.layout.chunk().front();
  SegmentsMark mark;
  for (std::uint64_t row = 0; row < 8 * chunk; ++row) {
    solution.append(segments, row);
    if ((row + 1) % (2 * chunk) == 0) mark = segments.seal();
  }
  return mark;
}

class SegmentFiles : public InTemporaryDirectory {
 protected:
  fs::path fresh() {
    fs::path folder = directory / std::to_string(++folders_);
    fs::create_directory(folder);
    return folder;
  }
  std::string in_one_go(const Solution& solution, std::uint64_t rows) {
    const fs::path folder = fresh();
    Segments segments = solution.segments(folder);
    for (std::uint64_t row = 0; row < rows; ++row) solution.append(segments, row);
    segments.finish(success());
    EXPECT_FALSE(fs::exists(folder / segments_folder));
    return text_of(folder / "solution.h5");
  }

 private:
  int folders_ = 0;
};

void expect_rows(const SolutionReader& record, const Solution& solution, std::uint64_t rows) {
  ASSERT_EQ(record.count(), static_cast<Index>(rows));
  const std::vector<double> t = record.times(), H = record.energies(), modified = record.modified_energies();
  Vector values;
  for (std::uint64_t row = 0; row < rows; ++row) {
    ASSERT_EQ(t[row], Solution::time(row));
    ASSERT_EQ(H[row], Solution::energy(row));
    if (solution.has_modified) {
      ASSERT_EQ(modified[row], 2 * Solution::energy(row));
    }
    record.state(static_cast<Index>(row), values);
    ASSERT_EQ(std::vector<double>(values.begin(), values.end()), solution.state(row)) << row;
  }
}

// What a run that goes on shows of itself: links to its segments in another folder.
void expect_shown(const fs::path& directory, const SegmentsMark& mark, const Solution& solution) {
  const fs::path elsewhere = directory / "shown";
  fs::create_directories(elsewhere / segments_folder);
  for (std::size_t k = 1; k <= mark.sealed.size(); ++k)
    fs::create_hard_link(directory / segments_folder / segment_name(k), elsewhere / segments_folder / segment_name(k));
  show_segments(Folder(elsewhere), solution.layout, {}, mark, success());
  expect_rows(SolutionReader(elsewhere / solution_name), solution, mark.rows());
  fs::remove_all(elsewhere);
}

TEST_F(SegmentFiles, AreJoinedToTheBytesOfAFileThatWasNeverSealed) {
  for (const Solution& solution : solutions()) {
    const std::uint64_t chunk = solution.layout.chunk().front(), rows = 5 * chunk + chunk / 3 + 2;
    const std::string expected = in_one_go(solution, rows);
    for (const std::uint64_t every : {chunk / 2 + 1, chunk + 1, 2 * chunk, rows - 1}) {
      const fs::path folder = fresh();
      SegmentsMark mark;
      while (mark.rows() < rows) {
        Segments segments = solution.segments(folder, mark);  // goes on behind the mark
        const std::uint64_t end = std::min(rows, mark.rows() + every);
        for (std::uint64_t row = mark.rows(); row < end; ++row) solution.append(segments, row);
        mark = segments.seal();
        ASSERT_EQ(mark.rows(), end);
      }
      solution.segments(folder, mark).finish(success());
      EXPECT_EQ(text_of(folder / "solution.h5"), expected) << solution.name << " sealed every " << every;
    }
  }
}

TEST_F(SegmentFiles, AreReadWithTheRowsThatTheMarkHolds) {
  for (const Solution& solution : solutions()) {
    const fs::path folder = fresh();
    Segments segments = solution.segments(folder);
    const std::uint64_t chunk = solution.layout.chunk().front();
    for (std::uint64_t row = 0, k = 1; k <= 3; ++k) {
      for (const std::uint64_t end = k * (chunk + chunk / 2); row < end; ++row) solution.append(segments, row);
      const SegmentsMark mark = segments.seal();
      ASSERT_EQ(mark.rows(), row);
      expect_shown(folder, mark, solution);
    }
    segments.finish(success());
    const SolutionReader joined(folder / "solution.h5");
    EXPECT_EQ(joined.count(), static_cast<Index>(3 * (chunk + chunk / 2)));
    EXPECT_EQ(joined.text("status"), "success");
  }
}

TEST_F(SegmentFiles, ThatAreTooLargeAreNotJoinedAndShown) {
  for (const Solution& solution : solutions()) {
    const std::uint64_t chunk = solution.layout.chunk().front(), rows = 3 * chunk + chunk / 2;
    for (const double join_below : {0.0, 1e9}) {
      const fs::path folder = fresh();
      Segments segments = solution.segments(folder, {}, join_below);
      for (std::uint64_t row = 0; row < rows; ++row) {
        solution.append(segments, row);
        if (row == chunk) segments.seal();
      }
      segments.finish(success());
      EXPECT_EQ(segments.is_joined(), join_below > 0);
      const SolutionReader shown(folder / solution_name);
      EXPECT_EQ(shown.parts().size(), join_below > 0 ? 0U : 2U) << solution.name;
      expect_rows(shown, solution, rows);
      if (join_below > 0) fs::remove_all(folder / segments_folder);
      expect_rows(SolutionReader(folder / solution_name), solution, rows);
    }
  }
}

// Each would be read as rows of NaN, or show what the file of another holds.
TEST_F(SegmentFiles, AreShownOnlyWhereTheyAreThoseThatWereWritten) {
  const Solution few = solutions()[1];
  const fs::path folder = fresh(), file = folder / solution_name, second = folder / segments_folder / "000002.h5";
  Segments segments = few.segments(folder, {}, 0);
  const std::uint64_t chunk = few.layout.chunk().front();
  for (std::uint64_t row = 0; row < 5 * chunk; ++row) {
    few.append(segments, row);
    if (row + 1 == 2 * chunk || row + 1 == 3 * chunk) segments.seal();
  }
  segments.finish(success());
  EXPECT_EQ(error_of([&] { SolutionReader reads(file); }), "");
  const std::string bytes = text_of(second);

  fs::remove(second);
  EXPECT_THAT(error_of([&] { SolutionReader reads(file); }), HasSubstr("000002.h5, which is not there"));
  std::ofstream(folder / "other.h5", std::ios::binary) << bytes;
  fs::create_symlink(folder / "other.h5", second);
  EXPECT_THAT(error_of([&] { SolutionReader reads(file); }), HasSubstr("or is not a file"));
  fs::remove(second);
  fs::copy_file(folder / segments_folder / "000001.h5", second);
  EXPECT_THAT(error_of([&] { SolutionReader reads(file); }), HasSubstr("has other rows of u"));
  fs::remove(second);
  std::ofstream(second, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  EXPECT_THAT(error_of([&] { SolutionReader reads(file); }), HasSubstr("000002.h5"));
  std::ofstream(second, std::ios::binary) << bytes;
  EXPECT_EQ(error_of([&] { SolutionReader reads(file); }), "");

  fs::rename(folder / segments_folder, folder / "elsewhere");
  EXPECT_THAT(error_of([&] { SolutionReader reads(file); }), HasSubstr("solution is not there, or is no folder"));
  fs::create_directory_symlink(folder / "elsewhere", folder / segments_folder);
  EXPECT_THAT(error_of([&] { SolutionReader reads(file); }), HasSubstr("solution is not there, or is no folder"));
  for (const std::string other :
       {"elsewhere/000001.h5", "solution/000002.h5", "solution/other.h5", "/solution/000001.h5"}) {
    OpenSolution shows(Folder(folder), few.layout, {}, few.has_modified, {{.file = other, .rows = 2 * chunk}});
    shows.commit(few.layout, success());
    EXPECT_THAT(error_of([&] { SolutionReader reads(file); }), HasSubstr("where no solution has it")) << other;
  }
}

// As only a checkpoint that was made by hand has them, since its checksum fits.
TEST_F(SegmentFiles, AreNotShownByTheMarkOfAnotherSolution) {
  const Solution few = solutions()[1];
  const fs::path folder = fresh();
  const SegmentsMark whole = sealed_four_times(few, folder);
  const auto refusal = [&](const std::function<void(SegmentsMark&)>& change) {
    SegmentsMark mark = whole;
    change(mark);
    std::string shown = error_of([&] { show_segments(Folder(folder), few.layout, {}, mark, success()); });
    EXPECT_EQ(error_of([&] { join_segments(Folder(folder), few.layout, {}, mark, success()); }), shown);
    return shown;
  };
  EXPECT_EQ(refusal([](SegmentsMark&) {}), "");
  EXPECT_THAT(refusal([](SegmentsMark& m) { m.unfinished.pop_back(); }), HasSubstr("other fields"));
  EXPECT_THAT(refusal([](SegmentsMark& m) { m.has_modified = !m.has_modified; }), HasSubstr("other fields"));
  EXPECT_THAT(refusal([](SegmentsMark& m) { m.sealed[1].rows += 1; }), HasSubstr("other fields"));
  EXPECT_THAT(refusal([](SegmentsMark& m) { m.unfinished.front().resize(7); }), HasSubstr("other fields"));
}

TEST_F(SegmentFiles, ThatAreNoHdf5FilesAreNotRemoved) {
  const fs::path folder = fresh(), inside = folder / segments_folder;
  sealed_four_times(solutions()[1], folder);
  std::ofstream(inside / "000002.h5") << "mine";
  remove_segments(Folder(folder));
  EXPECT_FALSE(fs::exists(inside / "000001.h5"));
  EXPECT_EQ(text_of(inside / "000002.h5"), "mine");
  EXPECT_FALSE(fs::exists(inside / "000004.h5"));
}

TEST_F(SegmentFiles, AreNotMadeWhereNoChunkWasFull) {
  const Solution line = solutions().front();
  const fs::path folder = fresh();
  Segments segments = line.segments(folder);
  for (std::uint64_t row = 0; row < 10; ++row) {
    line.append(segments, row);
    EXPECT_THAT(segments.seal().sealed, IsEmpty());
  }
  EXPECT_TRUE(fs::is_empty(folder));
  segments.finish(success());
  EXPECT_EQ(text_of(folder / "solution.h5"), in_one_go(line, 10));
}

TEST_F(SegmentFiles, ThatNoMarkNamesAreRemovedAndNothingElse) {
  const Solution few = solutions()[1];
  const fs::path folder = fresh();
  SegmentsMark mark = sealed_four_times(few, folder);
  const fs::path inside = folder / segments_folder;
  std::ofstream(inside / "notes.txt") << "mine";
  mark.sealed.resize(2);
  Segments segments = few.segments(folder, mark);
  EXPECT_TRUE(fs::exists(inside / "000003.h5")) << "nothing has changed yet";
  for (std::uint64_t row = 0; row < few.layout.chunk().front(); ++row) few.append(segments, row);
  EXPECT_TRUE(fs::exists(inside / "000002.h5"));
  EXPECT_FALSE(fs::exists(inside / "000003.h5"));
  EXPECT_FALSE(fs::exists(inside / "000004.h5"));
  remove_segments(Folder(folder));
  EXPECT_FALSE(fs::exists(inside / "000001.h5"));
  EXPECT_EQ(text_of(inside / "notes.txt"), "mine");
  fs::remove(inside / "notes.txt");
  remove_segments(Folder(folder));
  EXPECT_FALSE(fs::exists(inside));
}

TEST_F(SegmentFiles, ThatAreNotWhatTheyWereAreTold) {
  const Solution few = solutions()[1];
  const fs::path folder = fresh();
  const SegmentsMark mark = sealed_four_times(few, folder);
  const Folder open(folder);
  EXPECT_EQ(complaint_about(open, mark), "");
  const fs::path second = folder / segments_folder / "000002.h5";
  const std::string bytes = text_of(second);
  for (const std::size_t at : {std::size_t{0}, bytes.size() / 2, bytes.size() - 1}) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(~damaged[at]);
    std::ofstream(second, std::ios::binary) << damaged;
    EXPECT_EQ(complaint_about(open, mark), "solution/000002.h5 is not what it was at the checkpoint") << at;
  }
  std::ofstream(second, std::ios::binary) << bytes << "more";
  EXPECT_THAT(complaint_about(open, mark), HasSubstr("solution/000002.h5 has"));
  std::ofstream(second, std::ios::binary) << bytes;
  std::ofstream(second.string() + ".partial") << "of another program";
  EXPECT_EQ(complaint_about(open, mark), "");
  std::ofstream(second, std::ios::binary) << bytes.substr(0, 100);
  EXPECT_THAT(complaint_about(open, mark), HasSubstr("solution/000002.h5 has 100 bytes, and had"));
  fs::remove(second);
  EXPECT_THAT(error_of([&] { complaint_about(open, mark); }), HasSubstr("cannot open"));
}

TEST_F(SegmentFiles, AreRefusedWithTheMarkOfAnotherSolution) {
  const std::vector<Solution> all = solutions();
  const SegmentsMark mark = sealed_four_times(all[1], fresh());
  EXPECT_THAT(error_of([&] { all[0].segments(fresh(), mark); }), HasSubstr("other fields, or another grid"));
}

TEST_F(SegmentFiles, TakeNoRowBehindTheirEnd) {
  const Solution line = solutions().front();
  Segments segments = line.segments(fresh());
  line.append(segments, 0);
  segments.finish(success());
  EXPECT_THAT(error_of([&] { line.append(segments, 1); }), HasSubstr("takes no more rows"));
  EXPECT_THAT(error_of([&] { segments.finish(success()); }), HasSubstr("takes no more rows"));
}

TEST_F(SegmentFiles, DoNotFollowALinkInThePlaceOfTheirFolder) {
  const Solution few = solutions()[1];
  const fs::path folder = fresh(), elsewhere = fresh();
  fs::create_directory_symlink(elsewhere, folder / segments_folder);
  Segments segments = few.segments(folder);
  for (std::uint64_t row = 0; row < few.layout.chunk().front(); ++row) few.append(segments, row);
  EXPECT_THAT(error_of([&] { segments.seal(); }), HasSubstr("cannot open the folder"));
  EXPECT_TRUE(fs::is_empty(elsewhere));
}

// ---- Ended anywhere: what a checkpoint vouches for is there, and the end has the same bytes

constexpr std::uint64_t rows_of_a_run = 31, rows_between_checkpoints = 7;
const char* const writer = "SegmentsWriter.DISABLED_GoesOnFromTheNewestCheckpoint";

SegmentsMark newest_mark(const Folder& folder) {
  for (const std::string& name : checkpoints_in(folder.path())) {
    try {
      SegmentsMark mark;
      Archive archive = read_checkpoint_file(folder.path() / name);
      archive(mark);
      if (complaint_about(folder, mark).empty()) return mark;
    } catch (const Error&) {  // the one before it may serve
    }
  }
  return {};
}

// Disabled, since it is no test by itself: those below run it in another process, which they kill.
TEST(SegmentsWriter, DISABLED_GoesOnFromTheNewestCheckpoint) {
  const char* const directory = std::getenv("SEICHE_TEST_FOLDER");
  ASSERT_NE(directory, nullptr);
  hdf5_without_cleanup_at_exit();
  const Folder folder{fs::path(directory)};
  const Solution few = solutions()[1];
  SegmentsMark mark = newest_mark(folder);
  Segments segments = few.segments(directory, mark);
  for (std::uint64_t row = mark.rows(); row < rows_of_a_run; ++row) {
    few.append(segments, row);
    if ((row + 1) % rows_between_checkpoints != 0) continue;
    mark = segments.seal();
    commit_checkpoint(folder, true, [&](Archive& archive) { archive(mark); });
  }
  segments.finish(success());
  remove_checkpoints(folder);
  remove_segments(folder);
}

// How it ended: 0, an exit code, or 128 and the number of a signal.
int end_of(const fs::path& directory, const std::string& fault) {
  const std::string command = fmt::format(
      "LD_PRELOAD='{}' SEICHE_TEST_FOLDER='{}' {} '{}' --gtest_also_run_disabled_tests --gtest_filter={} "
      "> /dev/null 2>&1",
      fault.empty() ? "" : failing_writes_path(), directory.string(), fault,
      fs::read_symlink("/proc/self/exe").string(), writer);
  const int status = std::system(command.c_str());
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

// The newest checkpoint serves, if there is one; going on from it ends with these bytes, and nothing is left beside.
void expect_the_end(const fs::path& directory, const std::string& expected, const std::string& after) {
  const std::vector<std::string> checkpoints = checkpoints_in(directory);
  const SegmentsMark mark = newest_mark(Folder(directory));
  if (!checkpoints.empty()) {
    SegmentsMark newest;
    Archive archive = read_checkpoint_file(directory / checkpoints.front());
    archive(newest);
    ASSERT_EQ(mark.rows(), newest.rows()) << after;
    ASSERT_GT(mark.rows(), 0U) << after;
    expect_shown(directory, mark, solutions()[1]);
  }
  ASSERT_EQ(end_of(directory, ""), 0) << after;
  EXPECT_EQ(text_of(directory / "solution.h5"), expected) << after;
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(directory)) left.push_back(entry.path().filename().string());
  EXPECT_THAT(left, testing::ElementsAre("solution.h5")) << after;
}

TEST_F(SegmentFiles, AreWholeWhereverARunAndItsResumesAreKilled) {
  const std::string expected = in_one_go(solutions()[1], rows_of_a_run);
  constexpr int killed = 128 + SIGKILL, stride = sanitized ? 29 : 7, most = 2000;
  int n = 1, vouched = 0;
  for (int end = killed; end != 0 && n < most; n += stride) {
    const fs::path folder = fresh();
    end = end_of(folder, fmt::format("SEICHE_KILL_AT={}", n));
    ASSERT_TRUE(end == 0 || end == killed) << end << " at call " << n;
    if (end == 0) {
      EXPECT_EQ(text_of(folder / "solution.h5"), expected);
    } else {
      end_of(folder, fmt::format("SEICHE_KILL_AT={}", 1 + n / 2));  // killed once more
    }
    vouched += checkpoints_in(folder).empty() ? 0 : 1;
    expect_the_end(folder, expected, fmt::format("killed before call {}", n));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(n, 50);
  EXPECT_LT(n, most);
  EXPECT_GT(vouched, 1);
}

TEST_F(SegmentFiles, AreWholeWhateverWriteFails) {
  const std::string expected = in_one_go(solutions()[1], rows_of_a_run);
  constexpr int stride = sanitized ? 31 : 11, most = 2000;
  for (const bool once : {true, false}) {
    int n = 1;
    for (int end = 1; end != 0 && n < most; n += stride) {
      const fs::path folder = fresh();
      end = end_of(folder, fmt::format("SEICHE_FAIL_AT={} SEICHE_FAIL_WITH={} {}", n, ENOSPC,
                                       once ? "SEICHE_FAIL_ONCE=1" : ""));
      ASSERT_LT(end, 128) << "a crash where write " << n << " fails";
      if (end == 0) {
        EXPECT_EQ(text_of(folder / "solution.h5"), expected);
      }
      expect_the_end(folder, expected, fmt::format("write {} failed, {}", n, once ? "once" : "and all behind"));
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(n, 50);
    EXPECT_LT(n, most);
  }
}

// What is vouched for is on the disk before: else a power cut would leave a name without its bytes.
TEST_F(SegmentFiles, AreOnTheDiskBeforeTheirNamesAndTheseBeforeTheCheckpoint) {
  const fs::path folder = fresh(), beside = fresh();
  const fs::path log = beside / "log";
  ASSERT_EQ(end_of(folder, fmt::format("SEICHE_SYNC_LOG='{}'", log.string())), 0);
  std::istringstream in(text_of(log));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  int segments = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i].starts_with("name 0000")) continue;
    ++segments;
    ASSERT_GT(i, 0U);
    EXPECT_EQ(lines[i - 1], "sync solution.h5.partial");
    ASSERT_LT(i + 2, lines.size());
    EXPECT_EQ(lines[i + 1], "sync solution");
    EXPECT_EQ(lines[i + 2], "sync checkpoint.seiche.partial");
  }
  EXPECT_EQ(segments, 4);
}

}  // namespace TEST_FILE
