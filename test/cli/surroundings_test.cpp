// What is around a run and none of its business: the time of the day, and how much memory it may have.
#include <test/support/program.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace seiche::test {
namespace TEST_FILE {

using nlohmann::json;
using testing::HasSubstr;

class Surroundings : public Cli {};

TEST_F(Surroundings, AClockThatJumpsChangesNoFile) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer has to be loaded first";
#endif
  write_case();
  const std::string run = " --quiet --set time.end=20 output.snapshot_every=1 checkpoint.every_steps=100";
  ASSERT_EQ(seiche("run case.toml --out steady" + run).exit, 0);
  const Result jumped =
      seiche("run case.toml --out jumped" + run, fmt::format("LD_PRELOAD='{}'", jumping_clock_path()));
  ASSERT_EQ(jumped.exit, 0) << jumped.err;
  const std::string date = fmt::format("cd '{}' && date +%s >now.txt && LD_PRELOAD='{}' date +%s >then.txt",
                                       directory.string(), jumping_clock_path());
  ASSERT_EQ(std::system(date.c_str()), 0);
  EXPECT_GT(std::abs(std::stol(text("now.txt")) - std::stol(text("then.txt"))), 1'000'000) << "the clock did not jump";
  for (const std::string name : {"energy.csv", "final.txt", "solution.h5", "solution.xdmf"})
    EXPECT_EQ(text("jumped/" + name), text("steady/" + name)) << name;
  const double seconds = json::parse(text("jumped/summary.json"))["wall_seconds"];
  EXPECT_GE(seconds, 0);
  EXPECT_LT(seconds, 600) << "years";
  EXPECT_EQ(seiche("audit jumped").exit, 0);
}

// Less and less of it, from enough down to nothing: a run is whole, or says in a line that it has no room.
TEST_F(Surroundings, WhereMemoryIsLimitedARunSaysSo) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer takes terabytes of addresses";
#endif
  write_case();
  int refused = 0, whole = 0;
  constexpr int unlimited = 0;
  for (const int megabytes : {unlimited, 400, 350, 300, 260, 230, 200, 150, 100, 70}) {
    const Result result =
        seiche("run case.toml --quiet --out out --restart --set problem.points=1048576 time.end=1/16 method.h=1/64",
               megabytes == unlimited ? "" : fmt::format("ulimit -v {}; ", megabytes * 1024));
    const std::string where = fmt::format("{} MB: {}", megabytes, result.err);
    if (result.exit == 0) {
      ++whole;
      continue;
    }
    ++refused;
    if (result.exit == 127) continue;                              // the loader had no room for the libraries
    if (result.err.find("fftw: ") != std::string::npos) continue;  // which ends the program itself
    EXPECT_THAT(result.exit, testing::AnyOf(1, 2)) << where;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << where;
    EXPECT_THAT(result.err, testing::AnyOf(HasSubstr("memory"), HasSubstr("bytes"))) << where;
  }
  EXPECT_GT(whole, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
