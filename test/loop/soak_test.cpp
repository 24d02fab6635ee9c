// Runs of very many steps: no memory that grows, no energy that drifts, no step that becomes slower.
#include <test/support/memory_in_use.hpp>
#include <test/support/temporary_directory.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/driver/run_case.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

namespace seiche::test {
namespace TEST_FILE {

// `make soak` asks for ten million.
std::int64_t steps_to_take() {
  const char* text = std::getenv("SEICHE_SOAK_STEPS");
  return text == nullptr ? 200'000 : std::strtoll(text, nullptr, 10);
}

// Memory after a tenth of the steps and at the end; the time of each third.
class Watch : public Observer {
 public:
  explicit Watch(std::int64_t steps) : steps_(steps) {}
  bool is_due(const State& state, bool is_last) const override {
    if (state.n == steps_ / 10) early_ = bytes_in_use();
    if (state.n >= third_ * steps_ / 3) {
      times_[static_cast<std::size_t>(third_)] = std::chrono::steady_clock::now();
      if (third_ < 3) ++third_;
    }
    if (is_last) late_ = bytes_in_use();
    return false;
  }
  void observe(const State&, const EnergyReading&) override {}
  void finish(const RunReport&) override {}

  std::ptrdiff_t growth() const { return late_ - early_; }
  double seconds(std::size_t third) const {
    return std::chrono::duration<double>(times_[third + 1] - times_[third]).count();
  }

 private:
  std::int64_t steps_;
  mutable std::int64_t third_ = 0;
  mutable std::ptrdiff_t early_ = 0, late_ = 0;  // bytes
  mutable std::array<std::chrono::steady_clock::time_point, 4> times_ = {};
};

// The largest |x − x₀| of a column of energy.csv.
double drift(const std::string& file, int column) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  double first = std::nan(""), most = 0;
  while (std::getline(in, line)) {
    std::size_t at = 0;
    for (int i = 0; i < column; ++i) at = line.find(',', at) + 1;
    const double x = std::stod(line.substr(at));
    if (std::isnan(first)) first = x;
    most = std::max(most, std::abs(x - first));
  }
  return most / std::abs(first);
}

class SoakSlow : public InTemporaryDirectory {};

TEST_F(SoakSlow, MillionsOfStepsOfAFreePendulumKeepMemoryAndEnergy) {
  struct Case {
    const char* method;
    int column;   // of energy.csv: H, or the modified energy
    double most;  // drift
  };
  // H is computed anew from z and does not drift. H̃ of sav holds r², to which each step adds: rounding r moves H̃
  // by at most 2u = 2.2·10⁻¹⁶ of it a step. While the wave moves that is some 10⁻¹⁸; once H has gone over into r
  // altogether (after 5·10⁶ steps here) the steps add less than the last place of r holds, and all are rounded to one
  // side. Memory grows with rows and snapshots (HDF5's index of a million of them takes 7 MB), of which there are as
  // many in a run of any length, and once with HDF5's first flush, after 5 s (170 kB).
  const std::int64_t steps = steps_to_take();
  for (const Case& c : {Case{"egc4", 1, 1e-14}, Case{"crkn6", 1, 1e-14}, Case{"seisav", 2, 1e-12}}) {
    const RunSpec spec = parse_case(
        fmt::format("[problem]\nname = \"custom\"\nfields = [\"q\", \"p\"]\nH = \"p^2/2 + 1 - cos(q)\"\n"
                    "initial = {{ q = 2, p = 0.3 }}\n[method]\nname = \"{}\"\nh = 0.1\n[time]\nend = {:.1f}\n"
                    "[output]\nenergy_every = {}\nsnapshot_every = {}\nreport = \"off\"\n",
                    c.method, 0.1 * static_cast<double>(steps), steps / 20'000, steps / 1000),
        "case.toml", {}, directory);
    Watch watch(steps);
    RunCaseOptions options;
    options.observers = {&watch};
    const CaseResult result = run_case(spec, directory / c.method, options);
    ASSERT_EQ(result.report.status, RunReport::Status::success) << result.message;
    EXPECT_EQ(result.report.steps, steps);
    const double moved = drift((directory / c.method / "energy.csv").string(), c.column);
    const double parted = c.column == 2 ? drift((directory / c.method / "energy.csv").string(), 1) : 0.0;
    fmt::print(
        "soak: {} {} steps: {:+} bytes after the first tenth, the energy moved by {:.1e}, H by {:.1e}; thirds in {:.2f}, {:.2f} and "
        "{:.2f} s\n",
        c.method, steps, watch.growth(), moved, c.column == 2 ? parted : moved, watch.seconds(0), watch.seconds(1),
        watch.seconds(2));
    EXPECT_LT(watch.growth(), std::max<std::int64_t>(1 << 16, steps / 20)) << c.method << ": bytes";
    EXPECT_LE(moved, c.most + (c.column == 2 ? 2.2e-16 * static_cast<double>(steps) : 0.0)) << c.method;
    if (parted > 0.1) {
      EXPECT_THAT(result.message, testing::HasSubstr("H itself")) << "that H and its modified form part is said";
    }
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
