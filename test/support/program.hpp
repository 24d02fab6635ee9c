// The program in a temporary directory: its exit code, and what it said.
#pragma once

#include <test/support/paths.hpp>
#include <test/support/temporary_directory.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <seiche/output/solution_reader.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace seiche::test {

class Cli : public InTemporaryDirectory {
 public:
  struct Result {
    int exit = -1;
    std::string out, err;
  };

 protected:
  // `arguments` as a shell would split them, in the temporary directory.
  Result seiche(const std::string& arguments, const std::string& before = "") const {
    const std::string command = "cd '" + directory.string() + "' && " + before + " '" + test::program_path() + "' " +
                                arguments + " >stdout.txt 2>stderr.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text("stdout.txt"), text("stderr.txt")};
  }
  bool has(const std::filesystem::path& name) const { return std::filesystem::exists(directory / name); }
  std::string text(const std::filesystem::path& name) const {
    std::ifstream in(directory / name);
    std::ostringstream all;
    all << in.rdbuf();
    return all.str();
  }
  std::vector<std::string> lines(const std::filesystem::path& name) const {
    std::ifstream in(directory / name);
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
  static Vector state(const SolutionReader& solution, Index k) {
    Vector values;
    solution.state(k, values);
    return values;
  }
  void write(const std::filesystem::path& name, const std::string& content) const {
    std::ofstream(directory / name) << content;
  }

  // A small Klein–Gordon case, with what a test wants to change put behind it.
  void write_case(const std::string& problem = "", const std::string& method = "h = \"1/64\"") const {
    write("case.toml", "[problem]\nname = \"klein_gordon\"\npoints = 8\n" + problem +
                           "\n[method]\nname = \"seisav\"\n" + method + "\n[time]\nend = 1.0\n");
  }
  // What is refused: exit code 2, a sentence on stderr, nothing on stdout, no directory begun.
  std::string refused(const std::string& arguments) const {
    const Result result = seiche(arguments);
    EXPECT_EQ(result.exit, 2) << arguments << "\n" << result.err;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_FALSE(std::filesystem::exists(directory / "out")) << arguments;
    EXPECT_THAT(result.err, testing::HasSubstr("seiche: "));
    return result.err;
  }
};

}  // namespace seiche::test
