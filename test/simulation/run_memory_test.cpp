// What a run is thought to take, against what it takes.
#include <test/support/paths.hpp>
#include <test/support/temporary_directory.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/memory_limit.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/simulation/prepared_run.hpp>
#include <seiche/simulation/run_memory.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

struct MeasuredRun {
  const char* problem;  // the keys of [problem] and what follows it
  const char* method;
  const char* backend;
  double tolerance = 0;  // 0: fixed steps
};

constexpr const char* plane =
    "name = \"klein_gordon\"\npoints = [300, 300]\nlength = [4.0, 4.0]\nboundary = [\"periodic\", \"dirichlet\"]\n";
constexpr const char* rubbed =
    "name = \"klein_gordon\"\npoints = [300, 300]\nlength = [4.0, 4.0]\nboundary = [\"periodic\", \"dirichlet\"]\n"
    "friction = { kind = \"quadratic\", coefficient = 0.3 }\n";
constexpr const char* line = "name = \"klein_gordon\"\npoints = 50000\n";
constexpr const char* torus = "name = \"klein_gordon\"\npoints = [300, 300]\nlength = [4.0, 4.0]\n";
constexpr const char* shallow = "name = \"gkdv\"\npoints = 131072\n";
constexpr const char* alloy = "name = \"cahn_hilliard\"\npoints = [300, 300]\n";
constexpr const char* membrane =
    "name = \"wave\"\npoints = [150, 150]\nlength = [2.0, 2.0]\nboundary = \"dirichlet\"\nmedium = \"inclusion\"\n";

std::string case_of(const MeasuredRun& run) {
  const std::string step = run.tolerance > 0 ? fmt::format("tolerance = {}", run.tolerance) : "h = 0.001";
  return fmt::format(
      "[problem]\n{}[method]\nname = \"{}\"\n{}\n[backend]\nname = \"{}\"\n[time]\nend = 0.002\n[output]\nreport = "
      "\"off\"\n",
      run.problem, run.method, step, run.backend);
}

// As if there were so many bytes.
class Memory {
 public:
  explicit Memory(double bytes) : before_(processes_on_machine()) {
    processes_on_machine() = static_cast<int>(memory_limit() * before_ / bytes);
  }
  ~Memory() { processes_on_machine() = before_; }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

 private:
  int before_;
};

TEST(RunMemory, OfARunIsAskedForWhereThereIsOne) {
  const Problem problem = klein_gordon({.grid = {.points = {64, 64}, .length = {4.0, 4.0}}});
  const SimulationOptions options{.method = "seisav", .backend = "modal"};
  const MethodEntry& method = find_method(options.method);
  const BackendEntry& backend = find_backend(options.backend);
  const Memory between(0.5 * (simulation_bytes(method, backend, problem) + run_bytes(method, backend, problem)));
  EXPECT_NO_THROW(Simulation(problem, options));
  EXPECT_THROW(PreparedRun(problem, {.simulation = options, .h = 0.01, .t_end = 1}), Error);
  EXPECT_THROW(
      Simulation(problem,
                 simulation_options(parse_case(
                     "[problem]\nname = \"klein_gordon\"\npoints = [64, 64]\nlength = [4.0, 4.0]\n[method]\nname "
                     "= \"seisav\"\nh = 0.01\n[time]\nend = 1\n",
                     "a.toml"))),
      Error);
}

class RunMemorySlow : public InTemporaryDirectory {
 protected:
  // The largest resident set of the program with this case, in megabytes.
  double measured(const std::string& text) const {
    std::ofstream(directory / "case.toml") << text;
    const std::string command = fmt::format(
        "cd '{}' && LD_PRELOAD='{}' SEICHE_HIGH_WATER_MARK=mark '{}' run case.toml --quiet --restart --out out",
        directory.string(), high_water_mark_path(), program_path());
    EXPECT_EQ(std::system(command.c_str()), 0) << text;
    std::ifstream mark(directory / "mark");
    std::string name;
    double kilobytes = 0;
    mark >> name >> kilobytes;
    return kilobytes / 1e3;
  }
};

TEST_F(RunMemorySlow, IsWithinAFactorOfWhatARunTakes) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer takes memory of its own";
#endif
  const double program = measured(case_of({"name = \"oscillator\"\n", "seisav", "dense"}));
  const std::vector<MeasuredRun> runs = {{plane, "seisav", "modal"},
                                         {plane, "egc4", "modal"},
                                         {plane, "crkn6", "modal"},
                                         {plane, "etdrk4", "modal"},
                                         {torus, "seilm", "modal"},
                                         {torus, "egc8", "modal"},
                                         {rubbed, "seisav", "modal"},
                                         {rubbed, "egc4", "modal"},
                                         {shallow, "egc8", "modal"},
                                         {alloy, "egc4", "modal"},
                                         {line, "seisav", "sparse"},
                                         {line, "egc8", "sparse"},
                                         {membrane, "seisav", "sparse"},
                                         {membrane, "egc4", "sparse"},
                                         {plane, "seisav", "modal", 1e-6},
                                         {plane, "egc4", "modal", 1e-6},
                                         {torus, "seavf", "modal", 1e-6},
                                         {torus, "crkn6", "modal", 1e-6},
                                         {membrane, "seisav", "sparse", 1e-6},
                                         {membrane, "egc4", "sparse", 1e-6}};
  for (const MeasuredRun& run : runs) {
    const std::string text = case_of(run);
    const Problem problem = make_problem(parse_case(text, "a.toml"));
    const double estimate =
        run_bytes(find_method(run.method), find_backend(run.backend), problem, run.tolerance > 0) / 1e6;
    const double taken = measured(text) - program;
    EXPECT_GE(estimate, 0.7 * taken) << text;
    EXPECT_LE(estimate, 1.5 * taken) << text;
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
