// What a run is thought to take, against what runs took.
#include <seiche/config/case/case_file.hpp>
#include <seiche/simulation/run_memory.hpp>

#include <gtest/gtest.h>

#include <string>
namespace seiche::test {
namespace {

struct Measured {
  const char* problem;  // the keys of [problem] and what follows it
  const char* method;
  const char* backend;
  double megabytes;  // the largest resident set of a run of two steps, without the 13 of a small one
};

constexpr const char* plane =
    "name = \"klein_gordon\"\npoints = [500, 500]\nlength = [4.0, 4.0]\nboundary = [\"periodic\", \"dirichlet\"]\n";
constexpr const char* rubbed =
    "name = \"klein_gordon\"\npoints = [500, 500]\nlength = [4.0, 4.0]\nboundary = [\"periodic\", \"dirichlet\"]\n"
    "friction = { kind = \"quadratic\", coefficient = 0.3 }\n";
constexpr const char* line = "name = \"klein_gordon\"\npoints = 100000\n";
constexpr const char* membrane =
    "name = \"wave\"\npoints = [300, 300]\nlength = [2.0, 2.0]\nboundary = \"dirichlet\"\nmedium = \"inclusion\"\n";

TEST(RunMemory, IsWithinAFactorOfWhatRunsTook) {
  for (const Measured& m : {Measured{plane, "seisav", "modal", 75},
                            {plane, "egc4", "modal", 226},
                            {rubbed, "seisav", "modal", 88},
                            {rubbed, "egc4", "modal", 363},
                            {line, "seisav", "sparse", 153},
                            {line, "egc8", "sparse", 165},
                            {membrane, "seisav", "sparse", 385},
                            {membrane, "egc4", "sparse", 177}}) {
    const Problem problem =
        make_problem(parse_case(std::string("[problem]\n") + m.problem + "[time]\nend = 1.0\n", "a.toml"));
    const double estimate = run_bytes(find_method(m.method), find_backend(m.backend), problem) / 1e6;
    EXPECT_GE(estimate, 0.5 * m.megabytes) << m.problem << m.method;
    EXPECT_LE(estimate, 2.5 * m.megabytes) << m.problem << m.method;
  }
}

}  // namespace
}  // namespace seiche::test
