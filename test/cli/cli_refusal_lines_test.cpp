// Whatever is wrong, one short line says it, in words of Seiche's own; nothing of it is read aloud.
#include <test/support/hostile_input.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using test::HostileInput;
using test::market;
using test::repeated;
using Result = test::Cli::Result;
using testing::HasSubstr;
using testing::Not;

TEST_F(HostileInput, DamagedRunsAreRefusedByPlotAsByAudit) {
  write_case();
  ASSERT_EQ(seiche("run case.toml --quiet --out run --set output.snapshot_every=8").exit, 0);
  const auto with = [this](const std::string& file, const auto& damage) {
    fs::remove_all(directory / "damaged");
    fs::copy(directory / "run", directory / "damaged", fs::copy_options::recursive);
    damage(directory / "damaged" / file);
    for (const std::string command : {"audit damaged", "plot damaged"}) refused_in_a_line(command);
  };
  with("solution.h5", [](const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2); });
  with("solution.h5", [](const fs::path& file) { std::ofstream(file) << "no HDF5"; });
  with("energy.csv",
       [](const fs::path& file) { std::ofstream(file) << "t,H\n0," << std::string(5'000'000, 'x') << "\n"; });
  with("energy.csv", [](const fs::path& file) { std::ofstream(file) << std::string(5'000'000, 'x') << "\n1\n"; });
  with("summary.json", [](const fs::path& file) { std::ofstream(file) << "{\"steps\": "; });
  with("case.toml", [](const fs::path& file) { std::ofstream(file) << "a" << repeated(".a", deep) << " = 1\n"; });
}

// HDF5 itself said on stderr that it could not close some of these files.
TEST_F(HostileInput, OneBitOfASolutionIsWorthALineAtMost) {
  write_case();
  ASSERT_EQ(seiche("run case.toml --quiet --out run").exit, 0);
  const std::string whole = text("run/solution.h5");
  int refused = 0;
  // Of the superblock, which stands first and has a checksum, and of everything else.
  for (std::size_t at = 8; at < whole.size(); at += at < 40 ? 8 : whole.size() / 40) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    write("run/solution.h5", damaged);
    const Result result = seiche("audit run");
    if (result.exit == 2) expect_one_line(result.err, std::to_string(at));
    EXPECT_THAT(result.err, Not(HasSubstr("HDF5:"))) << at;
    EXPECT_THAT(result.exit, testing::AnyOf(0, 1, 2)) << at;
    refused += result.exit == 2 ? 1 : 0;
  }
  EXPECT_GT(refused, 3);
}

// HDF5 went round in circles, and the command with it.
TEST_F(HostileInput, AHeapOfTextsThatLeadsIntoItselfIsToldInALine) {
  write_case();
  ASSERT_EQ(seiche("run case.toml --quiet --out run").exit, 0);
  std::string damaged = text("run/solution.h5");
  const std::size_t heap = damaged.find("GCOL");
  ASSERT_NE(heap, std::string::npos);
  damaged.replace(heap + 16, 16, 16, '\0');  // its first object, now free space of no length
  write("run/solution.h5", damaged);
  for (const std::string command : {"audit run", "plot run"})
    EXPECT_THAT(refused_in_a_line(command), HasSubstr("solution.h5 is damaged: HDF5 itself breaks down over it"));
}

TEST_F(HostileInput, ASummaryWithTextsForNumbersIsNoErrorOfALibrary) {
  write_case();
  ASSERT_EQ(seiche("run case.toml --quiet --out run").exit, 0);
  const std::string whole = text("run/summary.json");
  for (const std::string key : {"steps", "t", "promised", "gradients", "initial", "wall_seconds", "method", "law"}) {
    std::string changed = whole;
    const std::size_t at = changed.find("\"" + key + "\": ");
    ASSERT_NE(at, std::string::npos) << key;
    const std::size_t value = at + key.size() + 4;
    if (changed[value] == '{') {
      changed.insert(value, "\"x\", \"y\": ");
    } else {
      changed.replace(value, changed.find_first_of(",\n", value) - value, key == "method" ? "1" : "\"x\"");
    }
    write("run/summary.json", changed);
    for (const std::string command : {"audit run", "plot run --format svg"}) {
      const Result result = seiche(command);
      EXPECT_THAT(result.err + result.out, Not(HasSubstr("exception"))) << command << " " << key;
    }
  }
}

TEST_F(HostileInput, EveryRefusalIsOneLineOfAtMost400Bytes) {
  const std::string large(1'000'000, 'x'), wide(100'000, 'x');
  const std::string problem = "[problem]\nname = \"klein_gordon\"\n", custom = "[problem]\nname = \"custom\"\n";
  std::string many = "parameters = { ";
  for (int i = 0; i < 2000; ++i) many += "parameter_" + std::to_string(i) + " = 1, ";
  many.replace(many.size() - 2, 2, " }\n");
  const std::vector<std::string> cases = {large,
                                          large + " = 1\n",
                                          "[" + large + "]\n",
                                          problem + large + " = 1\n",
                                          problem + "gamma = " + large + "\n",
                                          problem + "gamma = \"" + large + "\"\n",
                                          problem + "gamma = \"" + std::string(3900, 'x') + "\"\n",
                                          problem + "gamma = \"" + std::string(3900, '1') + "\"\n",
                                          problem + "gamma = \"2*" + wide + "\"\n",
                                          problem + "points = \"" + large + "\"\n",
                                          problem + "initial = \"" + large + "\"\n",
                                          problem + "initial = { " + large + " = 1 }\n",
                                          problem + "initial = { file = \"" + large + "\" }\n",
                                          problem + "friction = { kind = \"" + large + "\" }\n",
                                          problem + "force = { " + large + " = \"1\" }\n",
                                          "[problem]\nname = \"" + large + "\"\n",
                                          problem + "[method]\nname = \"" + large + "\"\n",
                                          problem + "[method]\nh = \"" + large + "\"\n",
                                          problem + "[method]\nh = 1" + std::string(100'000, '0') + "\n",
                                          problem + "gamma = \"a\\nb\\u001b[2J\"\n",
                                          problem + "\"a\\nb\" = 1\n",
                                          problem + "gamma = \"\"\"\n\n\n0.1 + * t\n\n\"\"\"\n",
                                          problem + "gamma = 1\ngamma = 2\n",
                                          problem + "gamma =\n",
                                          problem + "gamma = [1,\n2\n[time]\n",
                                          problem + "h = 1/64\n",
                                          "\xff\xfe\n",
                                          "a = \"\x01\"\n",
                                          custom + "fields = [\"" + large + "\", \"p\"]\nH = \"p^2\"\n",
                                          custom + "fields = [\"q\", \"p\"]\nH = \"p^2/2 + zeta*q\"\n" + many,
                                          custom + "fields = [\"q\", \"p\"]\nparameters = { " + large +
                                              " = 1 }\nH = \"p^2/2\"\n",
                                          custom + "fields = [\"q\", \"p\"]\nH = \"p^2/2 + q^4\"\nD = { p = \"" +
                                              repeated("1 + ", 900) + "sin(q)\" }\n",
                                          custom + "length = 1.0\npoints = 8\nfields = [\"u\", \"v\"]\nH = \"v^2/2 + " +
                                              repeated("u^2 + ", 600) + "u_x^4\"\n"};
  for (const std::string& text : cases) refused_case(text);

  write_case();
  const std::vector<std::string> commands = {wide,
                                             "run " + wide,
                                             "run case.toml " + wide,
                                             "run case.toml --" + wide,
                                             "run case.toml --threads " + wide,
                                             "run case.toml --out out --set " + wide,
                                             "run case.toml --out out --set " + wide + "=1",
                                             "run case.toml --out out --set problem." + wide + "=1",
                                             "run case.toml --out out --set problem.gamma=" + wide,
                                             "run case.toml --out out --set problem.gamma.x." + wide + "=1",
                                             "run case.toml --out " + wide,
                                             "run case.toml --set output.directory=" + wide,
                                             "audit " + wide,
                                             "plot " + wide,
                                             "plot out --format " + wide,
                                             "new " + wide,
                                             "list " + wide,
                                             "recover " + wide,
                                             "converge case.toml --methods " + wide,
                                             "converge case.toml --h " + wide,
                                             "paper --out out --reference " + wide};
  for (const std::string& arguments : commands) refused_in_a_line(arguments);

  const std::vector<std::string> matrices = {large,
                                             market + large,
                                             market + "2 2 1\n1 1 " + large,
                                             market + "2 2 1\n" + large + "\n",
                                             "%%MatrixMarket " + large + "\n",
                                             market + "2 2 1\n1 1 " + std::string(1000, '9') + "\n"};
  for (const std::string& M : matrices) {
    write_matrices(M);
    refused_in_a_line("check case.toml");
  }
  write("z.txt", large);
  write_case("initial = { file = \"z.txt\" }");
  refused_in_a_line("check case.toml");
}

}  // namespace TEST_FILE
}  // namespace seiche
