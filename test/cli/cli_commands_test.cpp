// The other commands: list, converge, spectrum, paper.
#include <test/support/background.hpp>
#include <test/support/paths.hpp>
#include <test/support/program.hpp>
#include <test/support/run_folder.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <seiche/backend/backends.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/problem/problems.hpp>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Background;
using test::can_draw;
using test::Cli;
using Result = Cli::Result;
using testing::AllOf;
using testing::HasSubstr;

class CliSlow : public Cli {};

TEST_F(Cli, CheckSaysWhatAStepWillCost) {
  write("case.toml", "[problem]\nname = \"wave\"\npoints = [8, 8]\nspeed = 1e5\n[method]\nh = \"1/64\"\n");
  const Result costly = seiche("check case.toml");
  EXPECT_EQ(costly.exit, 0) << costly.err;
  EXPECT_THAT(costly.err, AllOf(HasSubstr("Padé parts"), HasSubstr("pade_degree = 6")));
  EXPECT_EQ(seiche("check case.toml --set problem.speed=1").err, "");
}

TEST_F(Cli, ListsNameEverythingThereIs) {
  const json methods = json::parse(seiche("list methods --json").out);
  std::vector<std::string> names;
  for (const json& method : methods) {
    names.push_back(method["name"]);
    for (const char* key : {"closure", "propagator", "composition", "order", "law", "projection", "reference"}) {
      EXPECT_TRUE(method.contains(key)) << key;
    }
  }
  EXPECT_EQ(names.back(), "auto");
  EXPECT_THAT(methods.back()["reference"], HasSubstr("chosen by tolerance"));
  EXPECT_EQ(std::vector<std::string>(names.begin(), names.end() - 1), method_names());
  EXPECT_EQ(json::parse(seiche("list problems --json").out).size(), problems().size() + 1);
  EXPECT_EQ(json::parse(seiche("list backends --json").out).size(), backend_names().size());
  for (const std::string& name : names) EXPECT_THAT(seiche("list methods").out, HasSubstr(name));
}

TEST_F(Cli, VersionNamesLibrariesAndInstructionSet) {
  const Result result = seiche("--version");
  EXPECT_EQ(result.exit, 0);
  for (const char* word : {"seiche 0.", "eigen", "fftw", "fmt", "cli11", "compiler", "instruction_set"}) {
    EXPECT_THAT(result.out, HasSubstr(word));
  }
  EXPECT_EQ(result.err, "");
}

TEST_F(Cli, ConvergeShowsTheOrderOfTheMethod) {
  write_case();
  const Result result = seiche("converge case.toml --methods seisav,savf --h 1/16,1/32 --json");
  ASSERT_EQ(result.exit, 0) << result.err;
  const json rows = json::parse(result.out)["rows"];
  ASSERT_EQ(rows.size(), 4U);
  for (const json& row : rows) {
    if (row["h"] == 1.0 / 16) {
      EXPECT_TRUE(row["order"].is_null());
    } else {
      EXPECT_NEAR(row["order"].get<double>(), 2.0, 0.1) << row;
    }
  }
}

TEST_F(Cli, ConvergeGivesEachMethodTheOptionsItKnows) {
  write_case();
  const Result result =
      seiche("converge case.toml --methods seisav,crkn4 --h 1/16,1/32 --json --set method.linear=explicit method.C=2");
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["rows"].size(), 4U);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("method.C is left out by crkn4"), HasSubstr("method.linear is left out by seisav")));
  EXPECT_THAT(refused("converge case.toml --methods seisav,savf --set method.linear=explicit"),
              HasSubstr("belongs to crkn4 and crkn6"));
  EXPECT_THAT(refused("converge case.toml --set method.linear=explicit"), HasSubstr("belongs to crkn4 and crkn6"));
}

TEST_F(CliSlow, ThePaperLeavesDataFiguresAndAReport) {
  const Result result = seiche("paper --quick --json");  // by itself not where a full run goes
  const json document = json::parse(result.out);
  EXPECT_FALSE(document["verdicts"].empty());
  EXPECT_TRUE(fs::exists(directory / "out/paper-quick/report.html"));
  EXPECT_TRUE(fs::exists(directory / "out/paper-quick/verdicts.csv"));
  if (result.exit == 0) {
    EXPECT_FALSE(fs::is_empty(directory / "out/paper-quick/figures"));
  } else {
    EXPECT_EQ(result.exit, 1);
    EXPECT_THAT(result.err, HasSubstr("python3-matplotlib")) << "the only excuse";
  }
}

// What it finds is on the page of the tutorial, which is played; here what stands before the search.
TEST_F(Cli, FitRefusesWhatItCannotAskPython) {
  write_case();
  EXPECT_THAT(refused("fit case.toml data.csv"), HasSubstr("--parameter is missing"));
  EXPECT_THAT(refused("fit case.toml data.csv --paramter gamma=1"), HasSubstr("did you mean '--parameter'?"));
  EXPECT_THAT(refused("fit case.toml data.csv --parameter gamma=1 --set method.nme=avf"),
              HasSubstr("did you mean 'name'?"));
  EXPECT_THAT(refused("fit - data.csv --parameter gamma=1"), HasSubstr("reads the case from a file"));
  const Result without = seiche("fit case.toml data.csv --parameter gamma=1", "SEICHE_PYTHON=/nonexistent/python");
  EXPECT_EQ(without.exit, 1);
  EXPECT_THAT(without.err, HasSubstr("/nonexistent/python was not found"));
}

TEST_F(Cli, SpectrumTellsWhetherTheDampingIsPhysical) {
  write_case();
  const Result good = seiche("spectrum case.toml");
  EXPECT_EQ(good.exit, 0) << good.err;
  EXPECT_THAT(good.out, AllOf(HasSubstr("without V: one step of seisav"), HasSubstr("The damping is physical: every")));
  const Result merged = seiche("spectrum case.toml --json --threads 2 --set method.name=avf method.h=1/4");
  ASSERT_EQ(merged.exit, 0) << merged.err;
  const json document = json::parse(merged.out);
  EXPECT_EQ(document["method"], "avf");
  EXPECT_EQ(document["modes"].size(), 5U);
  EXPECT_GT(document["verdict"]["largest_relative_error"].get<double>(), 1e-4);
  EXPECT_FALSE(fs::exists(directory / "out"));

  EXPECT_THAT(refused("spectrum case.toml --out ''"), HasSubstr("--out must not be empty"));
  write_case("gamma = \"0.1 + 0.05*sin(t)\"");
  EXPECT_THAT(refused("spectrum case.toml --set method.name=avf"), HasSubstr("avf does not apply"));
  EXPECT_THAT(seiche("spectrum case.toml").out, HasSubstr("γ as it is at t = 0"));
  write_case("", "tolerance = 1e-6");
  EXPECT_THAT(refused("spectrum case.toml"), AllOf(HasSubstr("give --set method.h="), HasSubstr("tells the sizes")));
}

TEST_F(Cli, SpectrumWithoutPythonSaysAndKeepsWhatItComputed) {
  write_case();
  const Result result = seiche("spectrum case.toml --out out", "SEICHE_PYTHON=/nonexistent/python");
  EXPECT_EQ(result.exit, 1);
  EXPECT_THAT(result.out, HasSubstr("The damping is physical: every"));
  EXPECT_THAT(result.err, HasSubstr("/nonexistent/python was not found"));
  EXPECT_EQ(lines("out/spectrum.csv").size(), 1U + 5U);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory / "out"), {}), 1);
}

TEST_F(Cli, ConvergeTakesTheBackendOfTheCase) {
  const std::string sparse = "converge '" + test::source_directory() +
                             "/cases/sparse.toml' --json --h 1/2,1/4 --set time.end=1 "
                             "method.name=seisav backend.name=sparse backend.exponential=pade backend.pade_degree=";
  const auto error = [&](const std::string& degree) {
    const Result result = seiche(sparse + degree);
    EXPECT_EQ(result.exit, 0) << result.err;
    return json::parse(result.out)["rows"][0]["error"].get<double>();
  };
  EXPECT_GT(std::abs(error("1") - error("8")), 1e-6);
}

TEST_F(Cli, ASignalDuringSetUpEndsTheProgram) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  Background waiting(directory, {"converge", "-"}, ends[0]);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(waiting.end(SIGINT), -SIGINT);
  for (const int end : ends) close(end);
}

TEST_F(Cli, SpectrumLeavesATableAndFigures) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  write_case();
  const Result result = seiche("spectrum case.toml --out out");
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_EQ(lines("out/spectrum.csv").size(), 1U + 5U);
  for (const char* name : {"spectrum_decay.png", "spectrum_decay.pdf", "spectrum_phase.png", "spectrum_phase.pdf"})
    EXPECT_GT(fs::file_size(directory / "out" / name), 1000U) << name;
}

}  // namespace TEST_FILE
}  // namespace seiche
