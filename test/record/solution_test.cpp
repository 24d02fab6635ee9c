// solution.h5 as others read it: shapes, axes, coordinates, what it costs, and what is left when a run ends early.
#include <test/support/error_of.hpp>
#include <test/support/memory_in_use.hpp>
#include <test/support/paths.hpp>
#include <test/support/temporary_directory.hpp>
#include <test/support/text_of.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <seiche/config/case/case_file.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/output/xdmf.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/problem/truss.hpp>
#include <seiche/record/solution_file.hpp>
#include <seiche/study/audit/audit.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <vector>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using test::error_of;
using testing::HasSubstr;
using testing::Not;

// z is the double of the physical values.
class HalvingSpace : public Space {
 public:
  explicit HalvingSpace(Index size) : size_(size) {}
  Index size() const override { return size_; }
  Index physical_size() const override { return size_; }
  void to_physical(const Vector& z, Vector& values) const override { values = z / 2; }
  void from_physical(const Vector& values, Vector& z) const override { z = 2 * values; }

 private:
  Index size_;
};

class Solution : public test::InTemporaryDirectory {
 protected:
  fs::path file() const { return directory / "solution.h5"; }
  std::string text(const char* name) const { return test::text_of(directory / name); }
  // Value i of time k is 1000 k + i.
  void write(const Problem& problem, Index times, double interval = 0) const {
    const HalvingSpace space(problem.size());
    SolutionFile solution(Folder(directory), problem, space, {.interval = interval}, true,
                          {.meanings = {"displacement"}});
    for (Index k = 0; k < times; ++k) observe(solution, problem, k);
    solution.finish({});
    solution.describe();
  }
  static void observe(SolutionFile& solution, const Problem& problem, Index k) {
    const Vector values = Vector::LinSpaced(problem.size(), 0, static_cast<double>(problem.size() - 1));
    const State state{.z = 2 * (values.array() + 1000.0 * static_cast<double>(k)).matrix(),
                      .t = 0.5 * static_cast<double>(k),
                      .n = k};
    solution.observe(state, {.H = 7.0 - static_cast<double>(k), .modified = 8.0 - static_cast<double>(k)});
  }
};

Problem plane() {
  return klein_gordon(
      {.grid = {.points = {4, 6}, .length = {2.0, 3.0}, .boundary = {Boundary::neumann, Boundary::dirichlet}}});
}

TEST_F(Solution, HoldsEveryFieldOnItsGridWithNamedAxes) {
  write(plane(), 3);
  const SolutionReader solution(file());
  EXPECT_EQ(solution.fields(), (std::vector<std::string>{"u", "v"}));
  ASSERT_EQ(solution.axes().size(), 2U);
  EXPECT_EQ(solution.axes()[0].name, "x");
  EXPECT_EQ(solution.axes()[0].values, (std::vector<double>{0.25, 0.75, 1.25, 1.75}));
  EXPECT_EQ(solution.axes()[1].name, "y");
  EXPECT_EQ(solution.axes()[1].values, (std::vector<double>{0.5, 1, 1.5, 2, 2.5}));
  EXPECT_EQ(solution.times(), (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(solution.energies(), (std::vector<double>{7, 6, 5}));
  Vector values;
  solution.state(2, values);
  EXPECT_EQ(values, Vector::LinSpaced(40, 2000, 2039)) << "physical values, in the order of z";
  solution.field(1, 1, values);
  EXPECT_EQ(values, Vector::LinSpaced(20, 1020, 1039));
  EXPECT_EQ(solution.meaning(0), "displacement");
  const Hdf5File raw = Hdf5File::open(file());
  EXPECT_EQ(raw.dataset("u").shape(), (Hdf5Shape{3, 4, 5})) << "u[t, x, y]";
  std::vector<double> modified(3);
  raw.dataset("H_modified").read(0, modified);
  EXPECT_EQ(modified, (std::vector<double>{8, 7, 6}));
  std::vector<double> points(60);
  raw.dataset("mesh/points").read(0, points);
  EXPECT_EQ(std::vector<double>(points.begin() + 18, points.begin() + 21), (std::vector<double>{0.75, 1, 0}));
}

TEST_F(Solution, NamesTheAxesOfPointsWithoutAGrid) {
  write(oscillator({}), 2);
  EXPECT_TRUE(SolutionReader(file()).axes().empty());
  EXPECT_EQ(Hdf5File::open(file()).dataset("q").shape(), (Hdf5Shape{2})) << "q[t]";

  write(oscillator({.points = 3}), 2);
  EXPECT_EQ(SolutionReader(file()).axes()[0].name, "point");
  EXPECT_EQ(SolutionReader(file()).axes()[0].values, (std::vector<double>{1, 2, 3}));
  EXPECT_TRUE(SolutionReader(file()).nodes().empty()) << "they lie nowhere";
  EXPECT_THAT(text("solution.xdmf"), HasSubstr("solution.h5:/mesh/numbers")) << "and are not listed at every time";

  const Problem bridge = truss({.panels = 3});
  write(bridge, 2);
  const SolutionReader solution(file());
  EXPECT_EQ(solution.fields(), bridge.fields) << "fields called x and y are no coordinates";
  EXPECT_EQ(solution.nodes(), (std::vector<Place>{{1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 1, 0}}));
}

TEST_F(Solution, AFieldThatIsCalledAsAnAxisGetsAnotherName) {
  Problem problem = klein_gordon({.grid = {.points = {8}, .length = {2.0}}});
  problem.fields = {"x", "H"};
  write(problem, 2);
  EXPECT_EQ(SolutionReader(file()).fields(), (std::vector<std::string>{"x_field", "H_field"}));
}

TEST_F(Solution, IsTheSameHoweverManyRowsMakeAChunk) {
  const Problem small = oscillator({.points = 2});
  constexpr Index many = 2500;  // more than two chunks of rows
  write(small, many);
  const SolutionReader solution(file());
  ASSERT_EQ(solution.count(), many);
  Vector values;
  for (const Index k : {Index{0}, Index{1023}, Index{1024}, many - 1}) {
    solution.state(k, values);
    EXPECT_EQ(values, Vector::LinSpaced(4, 1000.0 * static_cast<double>(k), 1000.0 * static_cast<double>(k) + 3));
    EXPECT_EQ(solution.time(k), 0.5 * static_cast<double>(k));
  }
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST_F(Solution, OfVeryManyTimesParaViewIsShownSome) {
  const Problem one = oscillator({});
  const HalvingSpace space(one.size());
  SolutionFile solution(Folder(directory), one, space, {}, true);
  for (Index k = 0; k < 2500; ++k) observe(solution, one, k);
  solution.finish({});
  EXPECT_EQ(solution.describe(), 3U);
  const std::string shown = text("solution.xdmf");
  EXPECT_EQ(count(shown, "<Time "), 1U + 833U);
  for (const char* time : {"<Time Value=\"0\"/>", "<Time Value=\"1.5\"/>", "<Time Value=\"1249.5\"/>"})
    EXPECT_EQ(count(shown, time), 1U) << time;
  EXPECT_THAT(shown, HasSubstr("\"3 1\" Format=\"XML\">2499 1 1<")) << "the last one too";
  EXPECT_EQ(write_xdmf(Folder(directory), "solution.h5", solution_layout(one), {.all_times = true}), 1U);
  EXPECT_EQ(count(text("solution.xdmf"), "<Time "), 2500U);
}

TEST_F(Solution, ChunksOfLargeGridsArePiecesOfOneInstant) {
  const SolutionLayout layout = solution_layout(klein_gordon({.grid = {.points = {512, 512}, .length = {2.0, 2.0}}}));
  EXPECT_EQ(layout.chunk(), (Hdf5Shape{1, 128, 512}));
  const SolutionLayout cube =
      solution_layout(klein_gordon({.grid = {.points = {4, 512, 512}, .length = {2.0, 2.0, 2.0}}}));
  EXPECT_EQ(cube.chunk(), (Hdf5Shape{1, 1, 128, 512}));
  EXPECT_EQ(solution_layout(oscillator({})).chunk(), (Hdf5Shape{1024}));
}

TEST_F(Solution, MemoryDoesNotGrowWithTheRun) {
  const Problem problem = klein_gordon({.grid = {.points = {2048}, .length = {2.0}}});
  const HalvingSpace space(problem.size());
  SolutionFile solution(Folder(directory), problem, space, {}, false);
  for (Index k = 0; k < 200; ++k) observe(solution, problem, k);
  const std::ptrdiff_t before = test::bytes_in_use();
  for (Index k = 200; k < 4200; ++k) observe(solution, problem, k);  // 131 MB of doubles
  EXPECT_LT(test::bytes_in_use() - before, 1 << 20);
  solution.finish({});
  EXPECT_EQ(SolutionReader(file()).count(), 4200);
  EXPECT_LT(fs::file_size(file()), std::uintmax_t{4200} * 2 * 2048 * 8 / 2) << "and it is compressed";
}

TEST_F(Solution, IsThereWholeOrNotAtAll) {
  const Problem problem = oscillator({});
  const HalvingSpace space(problem.size());
  { const SolutionFile solution(Folder(directory), problem, space, {}, false); }
  EXPECT_TRUE(fs::is_empty(directory)) << "nothing is left of a run without a row";
  {
    SolutionFile solution(Folder(directory), problem, space, {}, false);
    observe(solution, problem, 0);
    EXPECT_FALSE(fs::exists(file()));
  }
  EXPECT_TRUE(fs::is_empty(directory)) << "nor of one that was not finished";
  {
    SolutionFile solution(Folder(directory), problem, space, {}, false);
    observe(solution, problem, 0);
    RunReport report;
    report.status = RunReport::Status::interrupted;
    report.message = "stopped";
    solution.finish(report);
    solution.describe();
  }
  EXPECT_EQ(SolutionReader(file()).text("status"), "interrupted");
  EXPECT_EQ(SolutionReader(file()).text("message"), "stopped");
  EXPECT_THAT(text("solution.xdmf"), HasSubstr("solution.h5:/q"));
}

TEST_F(Solution, AsksForItsTimesWithAnInterval) {
  const Problem problem = oscillator({});
  const HalvingSpace space(problem.size());
  SolutionFile solution(Folder(directory), problem, space, {.schedule = {.every_steps = 1}, .interval = 0.25}, false);
  EXPECT_TRUE(solution.is_due({.z = {}, .t = 0, .n = 0}, false));
  EXPECT_EQ(solution.next_time(), 0.25);
  observe(solution, problem, 1);  // t = ½
  EXPECT_EQ(solution.next_time(), 0.75);
  EXPECT_FALSE(solution.is_due({.z = {}, .t = 0.6, .n = 2}, false));
  EXPECT_TRUE(solution.is_due({.z = {}, .t = 0.6, .n = 2}, true));
}

TEST_F(Solution, TheSameRunLeavesTheSameBytes) {
  write(plane(), 3);
  const std::string first = text("solution.h5");
  write(plane(), 3);
  EXPECT_EQ(text("solution.h5"), first);
}

TEST_F(Solution, WhatCannotBeWrittenOrReadIsSaidInOneSentence) {
  const Problem problem = oscillator({});
  const HalvingSpace space(problem.size());
  EXPECT_THAT(error_of([&] { SolutionFile solution(Folder(directory / "none"), problem, space, {}, false); }),
              HasSubstr("none: No such file or directory"));
  EXPECT_THAT(error_of([&] { SolutionReader solution(file()); }), HasSubstr("cannot read " + file().string()));
  std::ofstream(file()) << "no HDF5";
  EXPECT_THAT(error_of([&] { SolutionReader solution(file()); }), HasSubstr("cannot read " + file().string()));
  {
    PartialPath empty(file());
    Hdf5File::create(empty.open(), file()).close();
    empty.commit();
  }
  EXPECT_THAT(error_of([&] { SolutionReader solution(file()); }), HasSubstr("there is no t in"));
}

// Values changed behind our back.
void change(const fs::path& file, const char* name, const std::function<void(std::vector<double>&)>& how) {
  const hid_t h5 = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(h5, 0);
  const hid_t data = H5Dopen2(h5, name, H5P_DEFAULT);
  const hid_t space = H5Dget_space(data);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  how(values);
  H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(data);
  H5Fclose(h5);
}

class AuditedSolution : public Solution {
 protected:
  void SetUp() override {
    std::ofstream(directory / "case.toml") << "[problem]\nname = \"klein_gordon\"\npoints = 8\n[method]\nname = "
                                              "\"seisav\"\nh = \"1/64\"\n[time]\nend = 1.0\n";
    const std::string run = "'" + test::program_path() + "' run '" + (directory / "case.toml").string() +
                            "' --quiet --out '" + out().string() + "' --set output.snapshot_every=16";
    ASSERT_EQ(std::system(run.c_str()), 0);
    ASSERT_TRUE(audit(out()).confirms());
    whole_ = text("out/solution.h5");
  }
  fs::path out() const { return directory / "out"; }
  fs::path solution() const { return out() / "solution.h5"; }
  void restore() const { std::ofstream(solution(), std::ios::binary) << whole_; }
  int exit_of_audit() const {
    const std::string call =
        "'" + test::program_path() + "' audit '" + out().string() + "' >'" + (directory / "said").string() + "' 2>&1";
    return WEXITSTATUS(std::system(call.c_str()));
  }

 private:
  std::string whole_;
};

TEST_F(AuditedSolution, AChangedDigitIsSeen) {
  change(solution(), "v", [](std::vector<double>& values) { values[values.size() / 2] *= 1 + 1e-8; });
  const Audit after = audit(out());
  EXPECT_FALSE(after.confirms());
  for (const AuditEntry& entry : after.entries)
    EXPECT_EQ(entry.verdict == AuditEntry::Verdict::contradicted,
              entry.claim.find("state in solution.h5") != std::string::npos)
        << entry.claim;
}

TEST_F(AuditedSolution, WhatIsNaNOrAtNoTimeOfTheRunIsRefuted) {
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const char* name : {"t", "u", "v", "H", "H_modified"}) {
    change(solution(), name, [](std::vector<double>& values) { values.back() = nan; });
    EXPECT_EQ(exit_of_audit(), 1) << name;
    EXPECT_THAT(text("said"), HasSubstr("nan")) << name;
    change(solution(), name, [](std::vector<double>& values) { std::fill(values.begin(), values.end(), nan); });
    EXPECT_EQ(exit_of_audit(), 1) << "all of " << name;
    restore();
  }
  change(solution(), "t", [](std::vector<double>& t) {
    for (double& one : t) one += 1e-3;
  });
  EXPECT_EQ(exit_of_audit(), 1);
  EXPECT_THAT(text("said"), HasSubstr("none of them at a time of energy.csv"));
  restore();
  change(solution(), "t", [](std::vector<double>& t) { std::swap(t[1], t[2]); });
  EXPECT_EQ(exit_of_audit(), 1);
  restore();
  change(solution(), "H_modified", [](std::vector<double>& values) { values[2] *= 1 + 1e-8; });
  EXPECT_EQ(exit_of_audit(), 1);
  restore();
  EXPECT_EQ(exit_of_audit(), 0);
}

TEST_F(AuditedSolution, NaNInTheEnergiesIsRefuted) {
  const std::string rows = text("out/energy.csv");
  for (const std::size_t row : {std::size_t{1}, std::size_t{30}, std::size_t{65}}) {
    for (const int column : {0, 1, 2}) {
      std::istringstream in(rows);
      std::ofstream changed(out() / "energy.csv");
      std::string line;
      for (std::size_t i = 0; std::getline(in, line); ++i) {
        std::vector<std::string> cells;
        std::istringstream parts(line);
        for (std::string cell; std::getline(parts, cell, ',');) cells.push_back(cell);
        if (i == row) cells[static_cast<std::size_t>(column)] = "nan";
        changed << cells[0] << ',' << cells[1] << ',' << cells[2] << '\n';
      }
      changed.close();
      EXPECT_EQ(exit_of_audit(), 1) << row << " " << column << text("said");
    }
  }
}

TEST_F(AuditedSolution, AFileThatLeadsElsewhereIsRefused) {
  fs::copy(solution(), out() / "other.h5");
  const auto with = [this](const std::function<void(hid_t)>& how) {
    const hid_t h5 = H5Fopen(solution().c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    how(h5);
    H5Fclose(h5);
    const int exit = exit_of_audit();
    restore();
    return exit;
  };
  for (const char* name : {"t", "u", "mesh"}) {
    EXPECT_EQ(with([&](hid_t h5) {
                if (H5Lexists(h5, name, H5P_DEFAULT) > 0) H5Ldelete(h5, name, H5P_DEFAULT);
                H5Lcreate_external("other.h5", name, h5, name, H5P_DEFAULT, H5P_DEFAULT);
              }),
              2)
        << name;
    EXPECT_THAT(text("said"), HasSubstr(std::string(name) + " in ")) << name;
    EXPECT_THAT(text("said"), HasSubstr("is a link")) << name;
  }
  EXPECT_EQ(with([](hid_t h5) {
              H5Ldelete(h5, "v", H5P_DEFAULT);
              H5Lcreate_soft("/u", h5, "v", H5P_DEFAULT, H5P_DEFAULT);
            }),
            2);
  EXPECT_EQ(with([this](hid_t h5) {
              H5Ldelete(h5, "H", H5P_DEFAULT);
              const hsize_t rows = 5;
              const hid_t space = H5Screate_simple(1, &rows, nullptr);
              const hid_t options = H5Pcreate(H5P_DATASET_CREATE);
              H5Pset_external(options, (out() / "energy.csv").c_str(), 0, rows * sizeof(double));
              const hid_t data = H5Dcreate2(h5, "H", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, options, H5P_DEFAULT);
              ASSERT_GE(data, 0);
              H5Dclose(data);
              H5Pclose(options);
              H5Sclose(space);
            }),
            2);
  EXPECT_THAT(text("said"), HasSubstr("H is stored in another file"));
}

// Whatever it hits: refused, refuted, or of no consequence to any reader.
TEST_F(AuditedSolution, DamageThatHdf5CannotReadIsRefused) {
  std::string damaged = text("out/solution.h5");
  const std::size_t heap = damaged.find("GCOL");  // texts of attributes
  ASSERT_NE(heap, std::string::npos);
  damaged[heap] = 'X';
  std::ofstream(solution(), std::ios::binary) << damaged;
  EXPECT_EQ(exit_of_audit(), 2) << text("said");
  restore();
  // The length of the verdict on the law becomes 2^61, which HDF5 1.10 copies.
  damaged = text("out/solution.h5");
  const std::size_t verdict = damaged.find("holds");
  ASSERT_NE(verdict, std::string::npos);
  damaged[verdict - 1] |= 32;
  std::ofstream(solution(), std::ios::binary) << damaged;
  EXPECT_EQ(exit_of_audit(), 2) << text("said");
  restore();
  fs::resize_file(solution(), fs::file_size(solution()) / 2);
  EXPECT_EQ(exit_of_audit(), 2) << text("said");
}

// A disk that is full, by way of the largest size that the shell allows a file.
TEST_F(Solution, AFullDiskEndsTheRunWithASentence) {
  std::ofstream(directory / "case.toml")
      << "[problem]\nname = \"klein_gordon\"\npoints = 512\n[method]\nname = "
         "\"seisav\"\nh = \"1/64\"\n[time]\nend = 50.0\n[output]\nsnapshot_every = 1\n"
         "energy_every = 100\n";
  const std::string run = "cd '" + directory.string() + "' && trap '' XFSZ && ulimit -f 2048 && '" +
                          test::program_path() + "' run case.toml --out out --quiet 2>stderr.txt";
  const int status = std::system(("bash -c \"" + run + "\"").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1) << text("stderr.txt");
  EXPECT_THAT(text("stderr.txt"), HasSubstr("solution.h5"));
  EXPECT_THAT(text("stderr.txt"), HasSubstr("File too large"));
  EXPECT_THAT(text("stderr.txt"), Not(HasSubstr("HDF5"))) << "which says the same in a hundred lines";
  EXPECT_FALSE(fs::exists(directory / "out/solution.h5.partial"));
  EXPECT_THAT(text("out/summary.json"), HasSubstr("\"status\": \"failed\""));
  EXPECT_TRUE(fs::exists(directory / "out/final.txt"));
}

}  // namespace TEST_FILE
}  // namespace seiche
