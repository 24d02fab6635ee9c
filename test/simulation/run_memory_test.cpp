// What a run is thought to take, against what it takes.
#include <test/support/paths.hpp>
#include <test/support/temporary_directory.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/simulation/run_memory.hpp>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace seiche::test {
namespace {

struct MeasuredRun {
  const char* problem;  // the keys of [problem] and what follows it
  const char* method;
  const char* backend;
};

constexpr const char* plane =
    "name = \"klein_gordon\"\npoints = [300, 300]\nlength = [4.0, 4.0]\nboundary = [\"periodic\", \"dirichlet\"]\n";
constexpr const char* rubbed =
    "name = \"klein_gordon\"\npoints = [300, 300]\nlength = [4.0, 4.0]\nboundary = [\"periodic\", \"dirichlet\"]\n"
    "friction = { kind = \"quadratic\", coefficient = 0.3 }\n";
constexpr const char* line = "name = \"klein_gordon\"\npoints = 50000\n";
constexpr const char* membrane =
    "name = \"wave\"\npoints = [150, 150]\nlength = [2.0, 2.0]\nboundary = \"dirichlet\"\nmedium = \"inclusion\"\n";

std::string case_of(const MeasuredRun& run) {
  return std::string("[problem]\n") + run.problem + "[method]\nname = \"" + run.method +
         "\"\nh = 0.001\n[backend]\nname = \"" + run.backend + "\"\n[time]\nend = 0.002\n[output]\nreport = \"off\"\n";
}

class RunMemorySlow : public InTemporaryDirectory {
 protected:
  // The largest resident set of the program with this case, in megabytes.
  double measured(const std::string& text) const {
    const std::string file = (directory / "case.toml").string(), out = (directory / "out").string();
    std::ofstream(file) << text;
    const std::string program = program_path();
    const pid_t child = fork();
    if (child == 0) {
      execl(program.c_str(), program.c_str(), "run", file.c_str(), "--quiet", "--out", out.c_str(),
            static_cast<char*>(nullptr));
      _exit(127);
    }
    int status = 0;
    double most = 0;
    while (waitpid(child, &status, WNOHANG) == 0) {
      most = std::max(most, high_water_mark(child));
      usleep(2000);
    }
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << text;
    return most;
  }

 private:
  // Of what the process has executed since; rusage would count what this one had when it forked.
  static double high_water_mark(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/status");
    for (std::string entry; std::getline(file, entry);)
      if (entry.starts_with("VmHWM:")) return std::stod(entry.substr(6)) / 1e3;
    return 0;
  }
};

TEST_F(RunMemorySlow, IsWithinAFactorOfWhatARunTakes) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer takes memory of its own";
#endif
  const double program = measured(case_of({"name = \"oscillator\"\n", "seisav", "dense"}));
  const std::vector<MeasuredRun> runs = {{plane, "seisav", "modal"},     {plane, "egc4", "modal"},
                                         {rubbed, "seisav", "modal"},    {rubbed, "egc4", "modal"},
                                         {line, "seisav", "sparse"},     {line, "egc8", "sparse"},
                                         {membrane, "seisav", "sparse"}, {membrane, "egc4", "sparse"}};
  for (const MeasuredRun& run : runs) {
    const std::string text = case_of(run);
    const Problem problem = make_problem(parse_case(text, "a.toml"));
    const double estimate = run_bytes(find_method(run.method), find_backend(run.backend), problem) / 1e6;
    const double taken = measured(text) - program;
    EXPECT_GE(estimate, 0.5 * taken) << text;
    EXPECT_LE(estimate, 2.5 * taken) << text;
  }
}

}  // namespace
}  // namespace seiche::test
