// What the documentation shows is what is compiled, run and listed.
#include <test/support/paths.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace seiche::test {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(test::source_directory() + "/" + path);
  EXPECT_TRUE(file) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string block(const std::string& text, const std::string& language) {
  const std::string fence = "```" + language + "\n";
  const std::size_t begin = text.find(fence);
  if (begin == std::string::npos) return "";
  const std::size_t from = begin + fence.size();
  return text.substr(from, text.find("```", from) - from);
}

TEST(Documentation, TheProgramOfThePageIsTheOneThatThePackageTestBuilds) {
  EXPECT_EQ(block(text_of("docs/site/tutorials/library.md"), "cpp"), text_of("test/package/main.cpp"));
}

TEST(Documentation, TheCaseOfTheReadmeRuns) {
  const RunSpec spec = parse_case(block(text_of("README.md"), "toml"), "README.md");
  Simulation simulation(make_problem(spec), simulation_options(spec));
  const double first = simulation.energy().modified;
  double last = first;
  for (int n = 0; n < 100; ++n) {
    ASSERT_TRUE(simulation.step(spec.h).solved());
    EXPECT_LE(simulation.energy().modified, last + 1e-12 * first) << n;
    last = simulation.energy().modified;
  }
  EXPECT_LT(last, 0.995 * first);
}

TEST(Documentation, EveryTestAndFileThatTheMapOfThePaperAndTheTheoryNameExists) {
  const std::string map = text_of("docs/paper_map.md") + text_of("docs/site/theory.md");
  std::string tests;
  const std::filesystem::path root = test::source_directory();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "test"))
    if (entry.path().extension() == ".cpp") tests += text_of(entry.path().lexically_relative(root).string());
  const std::regex file("`((?:[a-z_]+/)+[a-z_]+\\.(?:hpp|cpp|toml|md))");
  int files = 0;
  for (std::sregex_iterator i(map.begin(), map.end(), file), end; i != end; ++i, ++files) {
    const std::string path = (*i)[1];
    const bool ours = std::filesystem::exists(test::source_directory() + "/seiche/" + path) ||
                      std::filesystem::exists(test::source_directory() + "/" + path);
    EXPECT_TRUE(ours) << path;
  }
  EXPECT_GT(files, 10);
  const std::regex claim("`([A-Z][A-Za-z]+)\\.([A-Za-z]+)[…`]");
  int claims = 0;
  for (std::sregex_iterator i(map.begin(), map.end(), claim), end; i != end; ++i, ++claims) {
    const std::regex written("TEST(_P)?\\(" + (*i)[1].str() + ",\\s+" + (*i)[2].str());
    EXPECT_TRUE(std::regex_search(tests, written)) << (*i)[0];
  }
  EXPECT_GT(claims, 8);
}

// Every number in the first cell of a row stands in one of the files of the others.
TEST(Documentation, EveryEquationNumberOfTheMapStandsBesideALineOfItsFile) {
  const std::regex number("\\((?:[1-5]\\.[0-9]+[a-z]?|[ADE][0-9])\\)");
  const std::regex file("`((?:[a-z_]+/)+[a-z_]+\\.(?:hpp|cpp))");
  int numbers = 0;
  for (const char* page : {"docs/paper_map.md", "docs/site/theory.md"}) {
    std::istringstream lines(text_of(page));
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("| ")) continue;
      const std::size_t end = line.find(" |", 2);
      const std::string first = line.substr(0, end), rest = line.substr(end);
      std::string code;
      for (std::sregex_iterator i(rest.begin(), rest.end(), file), none; i != none; ++i)
        code += text_of("seiche/" + (*i)[1].str());
      for (std::sregex_iterator i(first.begin(), first.end(), number), none; i != none; ++i, ++numbers)
        EXPECT_NE(code.find(i->str()), std::string::npos) << page << ": " << i->str();
    }
  }
  EXPECT_GT(numbers, 20);
}

}  // namespace
}  // namespace seiche::test
