// What the documentation shows is what is compiled, run and listed.
#include <test/support/paths.hpp>

#include <seiche/config/case/case_file.hpp>
#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

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

TEST(Documentation, EveryFileThatTheReadmeLinksToExists) {
  const std::string readme = text_of("README.md");
  const std::regex link("\\]\\(([^):#]+)\\)");
  int links = 0;
  for (std::sregex_iterator i(readme.begin(), readme.end(), link), end; i != end; ++i, ++links)
    EXPECT_TRUE(std::filesystem::exists(source_directory() + "/" + (*i)[1].str())) << (*i)[1];
  EXPECT_GT(links, 20);
}

// A file of seiche/ that a page names, and after a colon a function or class of it.
struct Place {
  std::string file, name;
};

std::vector<Place> places_in(const std::string& text) {
  static const std::regex place("`((?:[a-z_]+/)+[a-z_]+\\.(?:hpp|cpp))(?:: ([A-Za-z_:]+))?`");
  std::vector<Place> places;
  for (std::sregex_iterator i(text.begin(), text.end(), place), end; i != end; ++i)
    places.push_back({"seiche/" + (*i)[1].str(), (*i)[2]});
  return places;
}

// Of each declaration or definition of the function, with the comment right above it; of a class its head. Calls are
// not among them: no type stands before their name.
std::string code_of(const Place& place) {
  std::istringstream in(text_of(place.file));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  const std::regex function("^ *(?!return )[A-Za-z_\\[][^=().]*[ :&*]" + place.name + "\\(");
  const std::regex type("^ *(?:class|struct) " + place.name + " ");
  const std::regex above("^ *(?://|template <)");
  std::string code;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const bool is_type = std::regex_search(lines[i], type);
    if (!is_type && !std::regex_search(lines[i], function)) continue;
    std::size_t first = i;
    while (first > 0 && std::regex_search(lines[first - 1], above)) --first;
    const std::string closed = lines[i].substr(0, lines[i].find_first_not_of(' ')) + "}";
    bool has_body = false, ends = false;
    for (std::size_t at = first; at < lines.size() && !ends; ++at) {
      code += lines[at] + "\n";
      if (at < i) continue;
      has_body = has_body || lines[at].find('{') != std::string::npos;
      const bool in_one_line = at == i && (is_type || lines[at].ends_with(';') || lines[at].ends_with('}'));
      ends = in_one_line || (has_body ? lines[at].starts_with(closed) : lines[at].ends_with(';'));
    }
  }
  return code;
}

TEST(Documentation, EveryTestFileAndFunctionThatTheMapOfThePaperAndTheTheoryNameExists) {
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
  int functions = 0;
  for (const Place& place : places_in(map)) {
    if (place.name.empty()) continue;
    ++functions;
    EXPECT_NE(code_of(place), "") << place.file << ": " << place.name;
  }
  EXPECT_GT(functions, 10);
  // Suite.Name, the beginning of a name before …, or every test of a suite: Suite.*
  const std::regex claim("`(?:[A-Za-z]+/)?([A-Z][A-Za-z]+)\\.([A-Za-z]+|\\*)((?:…)?)`");
  int claims = 0;
  for (std::sregex_iterator i(map.begin(), map.end(), claim), end; i != end; ++i, ++claims) {
    const std::string name = (*i)[2] == "*" ? "" : (*i)[2].str() + ((*i)[3].length() == 0 ? "\\)" : "");
    const std::regex written("TEST(_[FP])?\\(" + (*i)[1].str() + ",\\s+" + name);
    EXPECT_TRUE(std::regex_search(tests, written)) << (*i)[0];
  }
  EXPECT_GT(claims, 20);
}

// Every number in the first cell of a row stands in one of the functions that the others name, or in the comment right
// above it; where the theory names files alone, in one of these.
TEST(Documentation, EveryEquationNumberOfTheMapStandsInAFunctionThatItsRowNames) {
  const std::regex number("\\((?:[1-5]\\.[0-9]+[a-z]?|[ADE][0-9])\\)");
  int numbers = 0;
  for (const char* page : {"docs/paper_map.md", "docs/site/theory.md"}) {
    std::istringstream lines(text_of(page));
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("| ")) continue;
      const std::size_t end = line.find(" |", 2);
      const std::string first = line.substr(0, end);
      std::string files, functions;
      for (const Place& place : places_in(line.substr(end)))
        place.name.empty() ? files += text_of(place.file) : functions += code_of(place);
      const bool is_map = page == std::string("docs/paper_map.md");
      for (std::sregex_iterator i(first.begin(), first.end(), number), none; i != none; ++i, ++numbers)
        EXPECT_NE((functions.empty() && !is_map ? files : functions).find(i->str()), std::string::npos)
            << page << ": " << i->str();
    }
  }
  EXPECT_GT(numbers, 20);
  // A number in another function of the file is not enough.
  const std::string file = "seiche/method/closure/sav.cpp";
  EXPECT_NE(code_of({file, "advance_damped"}).find("(3.1a)"), std::string::npos);
  EXPECT_EQ(code_of({file, "margin_against_drift"}).find("(3.1a)"), std::string::npos);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
