// Reads every #include of the library, the program and the Python module and compares it with the table of who may
// include whom.
#include <test/support/paths.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace TEST_FILE {

namespace fs = std::filesystem;
using Folders = std::set<std::string>;

const fs::path root = seiche::test::source_directory();

// Who may include which room of ours, beside its own; a room and the rooms inside it are one. What stands above may
// include what stands below.
const std::map<std::string, Folders> may_include = {
    {"core", {}},
    {"formula", {"core"}},
    {"law", {"core"}},
    {"noise", {"core"}},
    {"backend", {"core", "noise"}},
    {"potential", {"core", "formula"}},
    {"damping", {"core", "formula"}},
    {"method", {"core"}},
    {"loop", {"core"}},
    {"output", {"core"}},
    {"record", {"core", "output"}},
    {"problem", {"core", "potential", "damping"}},
    {"simulation", {"core", "noise", "law", "method", "backend", "loop"}},
    {"config",
     {"core", "noise", "formula", "law", "potential", "damping", "method", "backend", "problem", "simulation"}},
    {"ensemble", {"core", "method", "problem", "loop", "simulation", "config"}},
    {"study",
     {"core", "law", "potential", "damping", "method", "backend", "problem", "output", "record", "loop", "simulation",
      "config", "ensemble"}},
    {"figure",
     {"core", "output", "record", "study", "config", "formula"}},  // the page of a run shows its case as formulas
    {"driver",
     {"core", "law", "method", "backend", "problem", "loop", "output", "record", "simulation", "config", "ensemble",
      "study", "figure"}},
    {"mpi", {"core"}},
    {"petsc", {"core", "law", "method", "backend", "potential", "problem", "simulation", "mpi"}},
    {"paper", {"core", "damping", "problem", "loop", "output", "record", "simulation", "study", "figure"}},
    {"cli",
     {"core", "law", "potential", "damping", "method", "backend", "problem", "output", "record", "loop", "simulation",
      "config", "study", "figure", "ensemble", "driver", "paper"}},
    {"python",
     {"core", "formula", "law", "potential", "damping", "method", "backend", "problem", "output", "record", "loop",
      "simulation", "config", "study", "figure", "ensemble", "driver"}},
};

// Written by CMake, of no room.
bool is_configured(const std::string& header) {
  return header == "seiche/version.hpp" || header == "seiche/allocation.hpp";
}

// Which folders may include a third-party header; the longest prefix decides. fmt is for all folders.
struct ThirdParty {
  std::string prefix;
  Folders folders;
};
const std::vector<ThirdParty> third_party = {
    {"Eigen/", {"core", "noise", "law", "backend", "method", "ensemble", "petsc"}},
    {"unsupported/Eigen/", {}},
    {"Random123/", {"noise"}},
    {"fftw3.h", {"backend"}},
    {"sleef.h", {"core"}},
    {"toml++/", {"config"}},
    {"ginac/", {"formula", "config"}},
    {"cln/", {"formula", "config"}},
    {"nlohmann/", {"simulation", "output", "study", "figure", "driver", "paper", "cli"}},
    {"hdf5.h", {"output"}},
    {"openssl/", {"output"}},
    {"mpi.h", {"mpi"}},
    {"petsc", {"petsc"}},
    {"CLI/", {"cli"}},
    {"pybind11/", {"python"}},
    {"boost/numeric/odeint", {"study"}},
    {"zlib.h", {"output"}},
    {"boost/math/", {"core", "damping", "study", "method", "loop"}},
};

struct Include {
  fs::path file;  // from the root
  int line = 0;
  std::string target;
  bool quoted = false;
};

std::string joined(const Folders& folders) {
  std::string text;
  for (const std::string& folder : folders) text += (text.empty() ? "" : ", ") + folder;
  return text;
}

// "core" for seiche/core/x.hpp, "cli" for cli/x.cpp, "" for what lies in seiche/ itself.
std::string folder_of(const fs::path& path) {
  auto part = path.begin();
  if (*part != "seiche") return part->string();
  ++part;
  return std::next(part) == path.end() ? "" : part->string();
}

bool in_standard_library(const std::string& target) {
  return target.find('/') == std::string::npos ? target != "fftw3.h" && target != "hdf5.h" && target != "mpi.h" &&
                                                     !target.starts_with("petsc") && !target.ends_with(".hpp")
                                               : target.starts_with("sys/");
}

// The rule that an include breaks, or "".
std::string broken_rule(const Include& include) {
  const std::string folder = folder_of(include.file);
  const bool umbrella = include.file == fs::path("seiche/seiche.hpp");
  const fs::path beside = (include.file.parent_path() / include.target).lexically_normal();
  const bool ours = include.quoted || include.target.starts_with("seiche/") || include.target.starts_with("cli/") ||
                    include.target.starts_with("paper/");

  if (ours) {
    const fs::path target =
        include.quoted && !include.target.starts_with("seiche/") ? beside : fs::path(include.target);
    if (is_configured(include.target) || umbrella) return "";
    if (target == fs::path("seiche/seiche.hpp")) return folder == "cli" ? "" : "only cli includes the umbrella header";
    const auto rule = may_include.find(folder);
    if (rule == may_include.end()) return "folder '" + folder + "' is not in the layering table";
    const std::string target_folder = folder_of(target);
    if (target_folder == folder || rule->second.contains(target_folder)) return "";
    return folder + " includes only " + joined(rule->second) + (rule->second.empty() ? "" : " and ") + folder;
  }

  if (in_standard_library(include.target) || include.target.starts_with("fmt/")) return "";
  const ThirdParty* owner = nullptr;
  for (const ThirdParty& entry : third_party) {
    if (include.target.starts_with(entry.prefix) && (!owner || entry.prefix.size() > owner->prefix.size())) {
      owner = &entry;
    }
  }
  if (!owner) return "this third-party header is not in the table of test/layering_test.cpp";
  if (owner->folders.contains(folder)) return "";
  return owner->prefix + " stays in " + joined(owner->folders);
}

// CMakeLists.txt leaves these out when it installs.
const std::set<fs::path> not_installed = {"seiche/formula/formula_expression.hpp", "seiche/formula/expression_text.hpp",
                                          "seiche/formula/algebra_functions.hpp", "seiche/formula/expansion.hpp",
                                          "seiche/config/custom/outward_growth.hpp"};

// Headers are installed, so what they include is what a user of the library must have.
std::string broken_header_rule(const Include& include) {
  const bool header = include.file.extension() == ".hpp" && *include.file.begin() == "seiche" &&
                      !not_installed.contains(include.file) && folder_of(include.file) != "petsc";
  if (header && not_installed.contains(include.target)) return "that header is not installed";
  const bool allowed = include.quoted || include.target.starts_with("seiche/") ||
                       include.target.starts_with("Eigen/") || include.target.starts_with("fmt/") ||
                       in_standard_library(include.target);
  return header && !allowed ? "an installed header includes only ours, Eigen, fmt and the standard library" : "";
}

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::is_regular_file(root / folder)) return {folder};
  if (!fs::is_directory(root / folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(root));
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(root / file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<Include> includes_of(const fs::path& file) {
  std::vector<Include> includes;
  int number = 0;
  for (const std::string& line : lines_of(file)) {
    ++number;
    std::istringstream words(line);
    char hash = 0;
    std::string word;
    if (!(words >> hash) || hash != '#' || !(words >> word) || !word.starts_with("include")) continue;
    const std::size_t open = line.find_first_of("<\"");
    if (open == std::string::npos) continue;
    const bool quoted = line[open] == '"';
    const std::size_t close = line.find(quoted ? '"' : '>', open + 1);
    includes.push_back({file, number, line.substr(open + 1, close - open - 1), quoted});
  }
  return includes;
}

std::vector<Include> all_includes() {
  std::vector<Include> all;
  for (const char* folder : {"seiche", "paper", "cli", "python"}) {
    for (const fs::path& file : files_below(folder)) {
      if (file.extension() != ".hpp" && file.extension() != ".cpp") continue;
      const std::vector<Include> includes = includes_of(file);
      all.insert(all.end(), includes.begin(), includes.end());
    }
  }
  return all;
}

std::string description(const Include& include, const std::string& rule) {
  return include.file.string() + ":" + std::to_string(include.line) + " includes " + include.target + ", but " + rule;
}

TEST(Layering, EveryIncludeObeysTheTable) {
  const std::vector<Include> includes = all_includes();
  ASSERT_GT(includes.size(), 10U) << "found too few includes below " << root << " to believe it";
  for (const Include& include : includes) {
    const std::string rule = broken_rule(include);
    EXPECT_TRUE(rule.empty()) << description(include, rule);
  }
}

TEST(Layering, InstalledHeadersNeedOnlyEigenAndFmt) {
  for (const Include& include : all_includes()) {
    const std::string rule = broken_header_rule(include);
    EXPECT_TRUE(rule.empty()) << description(include, rule);
  }
}

TEST(Layering, EveryHeaderThatIsIncludedIsThere) {
  for (const Include& include : all_includes()) {
    if (!include.target.starts_with("seiche/") || is_configured(include.target)) continue;
    EXPECT_TRUE(fs::exists(root / include.target)) << description(include, "there is no such file");
  }
}

// The reader of includes can fail: what the table forbids is refused, what it allows is not.
TEST(Layering, ForbiddenIncludesAreRefused) {
  const std::vector<Include> forbidden = {
      {"seiche/core/x.hpp", 1, "seiche/method/closure/sav.hpp", false},
      {"seiche/method/x.cpp", 1, "seiche/backend/dense/dense.hpp", false},
      {"seiche/method/x.cpp", 1, "../backend/dense/dense.hpp", true},
      {"seiche/problem/x.cpp", 1, "seiche/backend/backends.hpp", false},
      {"seiche/loop/x.cpp", 1, "seiche/output/outputs.hpp", false},
      {"seiche/config/x.cpp", 1, "seiche/study/converge.hpp", false},
      {"seiche/figure/x.cpp", 1, "seiche/method/methods.hpp", false},
      {"seiche/study/x.cpp", 1, "seiche/figure/curve_picture.hpp", false},
      {"seiche/study/x.cpp", 1, "cli/commands.hpp", false},
      {"seiche/study/x.cpp", 1, "paper/examples.hpp", false},
      {"seiche/core/x.cpp", 1, "seiche/seiche.hpp", false},
      {"seiche/novel/x.cpp", 1, "seiche/core/state.hpp", false},
      {"seiche/loop/x.cpp", 1, "Eigen/Core", false},
      {"seiche/core/x.cpp", 1, "unsupported/Eigen/MatrixFunctions", false},
      {"seiche/method/x.cpp", 1, "fftw3.h", false},
      {"seiche/study/x.cpp", 1, "toml++/toml.h", false},
      {"seiche/core/x.cpp", 1, "ginac/ginac.h", false},
      {"seiche/config/x.cpp", 1, "nlohmann/json.hpp", false},
      {"seiche/study/x.cpp", 1, "hdf5.h", false},
      {"seiche/backend/x.cpp", 1, "mpi.h", false},
      {"seiche/config/x.cpp", 1, "CLI/CLI.hpp", false},
      {"seiche/method/x.cpp", 1, "boost/numeric/odeint.hpp", false},
      {"seiche/potential/x.cpp", 1, "boost/math/quadrature/gauss.hpp", false},
      {"seiche/core/x.cpp", 1, "gsl/gsl_math.h", false},
  };
  for (const Include& include : forbidden) {
    EXPECT_NE(broken_rule(include), "") << include.file << " includes " << include.target;
  }
  EXPECT_NE(broken_header_rule({"seiche/output/x.hpp", 1, "nlohmann/json.hpp", false}), "");
  EXPECT_NE(broken_header_rule({"seiche/output/x.hpp", 1, "hdf5.h", false}), "");

  const std::vector<Include> allowed = {
      {"seiche/core/x.hpp", 1, "Eigen/Core", false},
      {"seiche/core/x.cpp", 1, "vector", false},
      {"seiche/core/x.cpp", 1, "unistd.h", false},
      {"seiche/core/x.cpp", 1, "seiche/version.hpp", false},
      {"seiche/method/x.cpp", 1, "sav.hpp", true},
      {"seiche/method/x.cpp", 1, "seiche/core/state.hpp", false},
      {"seiche/problem/x.cpp", 1, "seiche/potential/nodal.hpp", false},
      {"seiche/config/x.cpp", 1, "seiche/method/methods.hpp", false},
      {"seiche/study/x.cpp", 1, "seiche/simulation/simulation.hpp", false},
      {"seiche/seiche.hpp", 1, "seiche/study/converge.hpp", false},
      {"cli/main.cpp", 1, "seiche/figure/curve_picture.hpp", false},
      {"cli/main.cpp", 1, "commands.hpp", true},
      {"cli/main.cpp", 1, "CLI/CLI.hpp", false},
  };
  for (const Include& include : allowed) EXPECT_EQ(broken_rule(include), "") << description(include, "");
}

// Rooms of one room, and it as a whole, by what they include of one another.
using Neighbours = std::map<fs::path, std::set<fs::path>>;

std::map<std::string, Neighbours> rooms_inside() {
  std::map<std::string, Neighbours> inside;
  for (const Include& include : all_includes()) {
    const fs::path from = include.file.parent_path();
    const fs::path to = fs::path(include.target).parent_path();
    if (folder_of(include.file) == folder_of(include.target) && from != to)
      inside[folder_of(include.file)][from].insert(to);
  }
  return inside;
}

// "a → b → a" where includes lead round, else "".
std::string circle(const Neighbours& rooms) {
  std::set<fs::path> done;
  std::vector<fs::path> path;
  const std::function<std::string(const fs::path&)> visit = [&](const fs::path& room) -> std::string {
    if (const auto begin = std::find(path.begin(), path.end(), room); begin != path.end()) {
      std::string text;
      for (auto it = begin; it != path.end(); ++it) text += it->string() + " → ";
      return text + room.string();
    }
    if (!done.insert(room).second || !rooms.contains(room)) return "";
    path.push_back(room);
    for (const fs::path& next : rooms.at(room))
      if (std::string found = visit(next); !found.empty()) return found;
    path.pop_back();
    return "";
  };
  for (const auto& [room, next] : rooms)
    if (std::string found = visit(room); !found.empty()) return found;
  return "";
}

// Rooms inside a room have an order as the rooms have: what lists them stands above them, what they share below.
TEST(Layering, RoomsInsideARoomDoNotRunInCircles) {
  EXPECT_EQ(circle({{"a", {"b"}}, {"b", {"c"}}, {"c", {}}}), "");
  EXPECT_EQ(circle({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {"b"}}}), "b → c → b");
  const std::map<std::string, Neighbours> inside = rooms_inside();
  EXPECT_GT(inside.size(), 5U);
  for (const auto& [room, neighbours] : inside) EXPECT_EQ(circle(neighbours), "") << room;
}

// Of vectors of a state in method/, loop/ and simulation/ what all of it decides goes through Space, which knows who
// else holds a part of it.
TEST(Layering, LengthsAndMaximaOfStatesGoThroughTheirSpace) {
  const std::regex direct(
      R"((\.|->)(dot|norm|squaredNorm|stableNorm|lpNorm<[^>]*>|allFinite|isFinite|maxCoeff|minCoeff|sum|mean|prod)\()");
  const auto breaks = [&](const std::string& line) {
    const std::string code = line.substr(0, line.find("//"));
    for (std::sregex_iterator i(code.begin(), code.end(), direct), end; i != end; ++i)
      if (!std::regex_search(i->prefix().str(), std::regex("space(_|\\(\\))?$|probe$|terms$"))) return true;
    return false;
  };
  EXPECT_TRUE(breaks("  const double size = s.z.norm();"));
  EXPECT_TRUE(breaks("  if (!z_.allFinite()) return false;"));
  EXPECT_TRUE(breaks("  const double mass = s.z.sum();"));
  EXPECT_FALSE(breaks("  const double size = system_.space->norm(s.z) + space().dot(a, b);  // z.norm()"));
  for (const char* folder : {"seiche/method", "seiche/loop", "seiche/simulation"}) {
    const std::vector<fs::path> files = files_below(folder);
    ASSERT_FALSE(files.empty()) << folder;
    for (const fs::path& file : files)
      for (const std::string& line : lines_of(file)) EXPECT_FALSE(breaks(line)) << file << ": " << line;
  }
}

// Else a program that includes it alone would miss what the command lists.
TEST(Layering, TheUmbrellaHeaderHasEveryProblemOfTheList) {
  std::set<std::string> umbrella;
  for (const Include& include : includes_of("seiche/seiche.hpp")) umbrella.insert(include.target);
  int problems = 0;
  for (const Include& include : includes_of("seiche/problem/problems.cpp")) {
    if (!include.target.starts_with("seiche/problem/")) continue;
    ++problems;
    EXPECT_TRUE(umbrella.contains(include.target)) << include.target;
  }
  EXPECT_GT(problems, 10);
}

// A room that shows more files than one looks through holds more than one idea. core/ itself is the vocabulary.
TEST(Layering, EveryRoomIsSeenAtAGlance) {
  std::map<fs::path, int> files;
  for (const char* folder : {"seiche", "paper", "cli", "python/src", "test"})
    for (const fs::path& file : files_below(folder))
      if (file.extension() == ".hpp" || file.extension() == ".cpp") ++files[file.parent_path()];
  ASSERT_GT(files.size(), 20U);
  for (const auto& [room, count] : files) EXPECT_LE(count, room == fs::path("seiche/core") ? 40 : 30) << room;
}

// Who looks for the header of a .cpp finds it beside it, and the two hold more than a fragment.
TEST(Layering, EverySourceHasTheHeaderOfItsNameAndIsNoFragment) {
  const std::set<fs::path> without_header = {
      // sleef_kernels.hpp, compiled for one instruction set each; vector_functions.cpp chooses.
      "seiche/core/simd/vector_functions_avx2.cpp",
      "seiche/core/simd/vector_functions_avx512.cpp",
  };
  std::size_t sources = 0;
  for (const char* folder : {"seiche", "paper"}) {
    for (const fs::path& file : files_below(folder)) {
      if (file.extension() != ".cpp") continue;
      ++sources;
      const fs::path header = fs::path(file).replace_extension(".hpp");
      const bool has_header = fs::exists(root / header);
      EXPECT_NE(has_header, without_header.contains(file))
          << file << (has_header ? " has a header, so it is no exception of this test" : " has no header of its name");
      if (!has_header) continue;
      EXPECT_GE(lines_of(file).size() + lines_of(header).size(), 25U)
          << file << " and its header are a fragment: they join the file whose idea they are";
    }
  }
  EXPECT_GT(sources, 100U);
}

TEST(Layering, NothingIsLeftForLaterInTheSources) {
  const std::vector<std::string> marks = {std::string("TO") + "DO", std::string("FIX") + "ME"};
  for (const char* folder :
       {"seiche", "paper", "cli", "test", "cases", "docs", "scripts", "bench", "Makefile", "README.md"}) {
    for (const fs::path& file : files_below(folder)) {
      int number = 0;
      for (const std::string& line : lines_of(file)) {
        ++number;
        for (const std::string& mark : marks) {
          EXPECT_EQ(line.find(mark), std::string::npos)
              << file.string() << ":" << number << " holds " << mark << "; make it an issue and name its number";
        }
      }
    }
  }
}

}  // namespace TEST_FILE
