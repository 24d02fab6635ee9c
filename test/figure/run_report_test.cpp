// The pictures and the report of a run: drawn for every kind of problem, on both grounds, complete, and honest where
// something is missing.
#include <test/support/run_folder.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <seiche/figure/html.hpp>
#include <seiche/figure/run_report.hpp>
#include <seiche/study/run_files.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using test::can_draw;
using test::text_of;
using testing::HasSubstr;

using RunReports = test::RunFolder;

struct Kind {
  std::string problem, settings;
  std::set<std::string> pictures;  // beside energy and ledger
};

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.problem << ' ' << kind.settings; }

class RunPicturesOf : public RunReports, public testing::WithParamInterface<Kind> {};

TEST_P(RunPicturesOf, AreDrawnOnLightAndDarkGround) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  const Kind kind = GetParam();
  run(kind.problem, kind.settings);
  ASSERT_EQ(seiche("plot --no-film --format png '" + out().string() + "'"), 0) << said();
  std::set<std::string> stems = kind.pictures;
  stems.insert({"energy", "ledger"});
  expect_drawn(stems);
  remove_pictures(out());
  EXPECT_TRUE(fs::is_empty(out() / "figures")) << "what is drawn is known when the next run comes";
}

INSTANTIATE_TEST_SUITE_P(
    Each, RunPicturesOf,
    testing::Values(
        Kind{"klein_gordon", "", {"space_time_u", "space_time_v", "profiles_u", "profiles_v"}},
        Kind{"klein_gordon", "problem.points=[12,8] problem.length=[2.0,2.0]", {"slices_u", "slices_v"}},
        Kind{"sine_gordon", "problem.points=[4,6,8] problem.length=[4.0,4.0,4.0]", {"planes_u", "planes_v"}},
        Kind{"oscillator", "", {"fields", "portrait_q_p"}},
        Kind{"oscillator", "problem.points=3", {"fields", "portrait_q_p"}},
        Kind{"rigid_body", "", {"fields", "portrait_l1_l2", "portrait_l2_l3"}},
        Kind{"network", "", {"space_time_u", "space_time_v", "profiles_u", "profiles_v"}}, Kind{"truss", "", {"bars"}}),
    [](const auto& kind) { return kind.param.problem + std::to_string(kind.index); });

TEST_F(RunReports, APictureIsDrawnInEveryFormatThatIsAskedFor) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  run("oscillator");
  ASSERT_EQ(seiche("plot '" + out().string() + "'"), 0) << said();
  EXPECT_TRUE(text_of(out() / "figures/energy.pdf").starts_with("%PDF-"));
  EXPECT_THAT(text_of(out() / "figures/energy.svg"), HasSubstr("<svg"));
  EXPECT_FALSE(fs::exists(out() / "figures/energy_dark.svg")) << "dark ones are for the report";
  ASSERT_EQ(seiche("plot --format svg '" + out().string() + "'"), 0) << said();
  EXPECT_FALSE(fs::exists(out() / "figures/energy.pdf")) << "what an earlier call drew is gone";
  EXPECT_TRUE(fs::exists(out() / "figures/energy.png")) << "the report shows it";
  EXPECT_EQ(seiche("plot --format jpg '" + out().string() + "'"), 2);
  EXPECT_THAT(said(), HasSubstr("unknown --format 'jpg'"));
}

// H moves by round-off alone, and so does the modified energy.
TEST_F(RunReports, WhatHardlyChangesIsDrawnAsItsChange) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  run("oscillator", "method.name=seisav problem.alpha=0 problem.gamma=0");
  ASSERT_EQ(seiche("plot --format png '" + out().string() + "'"), 0) << said();
  EXPECT_THAT(report(), HasSubstr("as its change since the start"));
}

TEST_F(RunReports, ARunLeavesAReportThatNeedsNothingBesideIt) {
  run("klein_gordon");
  const std::string page = report();
  for (const char* text :
       {"<h1>Klein–Gordon equation by SEISAV</h1>",
        "<mi>γ</mi><msub><mrow><mi>u</mi></mrow><mrow><mi>t</mi></mrow></msub>", "Finished on 20",
        "<code>omega_squared</code></th><td>0.2</td>", "@software{seiche", "Reached t = 0.5 in 16 steps",
        "the energy law holds", "sym(S) ⪯ 0", "by structure", "verified with margin", "Ledger",
        "half step before the Hamiltonian step", "all together", "seiche plot", "name = &quot;klein_gordon&quot;",
        "seiche run case.toml", "eigen", "Li, Li, Shang"}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
  for (const char* foreign : {"http:", "https:", "src=\"//", "@import", "url(", "<link", "<script", "<iframe"})
    EXPECT_EQ(page.find(foreign), std::string::npos) << foreign;
  run("klein_gordon", "output.report=off");
  EXPECT_FALSE(fs::exists(out() / "report.html"));
}

TEST_F(RunReports, PicturesOfAnEarlierRunDoNotStandBesideANewOne) {
  run("oscillator");
  fs::create_directories(out() / "figures/film");
  for (const char* old : {"figures/energy.png", "figures/film/u_0001.png", "figures/film_u.mp4",
                          "figures/film_u_dark.mp4", "figures/notes.txt"})
    std::ofstream(out() / old) << "old";
  run("oscillator", "output.report=off");
  EXPECT_FALSE(fs::exists(out() / "report.html"));
  EXPECT_FALSE(fs::exists(out() / "figures/energy.png"));
  EXPECT_FALSE(fs::exists(out() / "figures/film"));
  EXPECT_FALSE(fs::exists(out() / "figures/film_u_dark.mp4"));
  EXPECT_TRUE(fs::exists(out() / "figures/notes.txt")) << "only what plot draws";
}

TEST_F(RunReports, AWrittenProblemIsCalledAsItsFolder) {
  std::ofstream(directory / "case.toml")
      << "[problem]\nname = \"custom\"\nfields = [\"q\", \"p\"]\nH = \"p^2/2 + q^4/4\"\n"
         "initial = { q = \"1\", p = \"0\" }\n[method]\nh = 0.125\n[time]\nend = 0.5\n";
  const fs::path folder = directory / "anharmonic";
  ASSERT_EQ(seiche("run '" + (directory / "case.toml").string() + "' --quiet --out '" + folder.string() + "'"), 0)
      << said();
  EXPECT_THAT(text_of(folder / "report.html"), HasSubstr("<h1>anharmonic by "));
  RunFiles files = read_run(folder);
  EXPECT_EQ(files.problem, "custom");
  files.directory = folder / "figures/../";
  EXPECT_EQ(run_name(files), "anharmonic");
  files.title = "Duffing oscillator";
  EXPECT_EQ(run_name(files), "Duffing oscillator");
}

TEST_F(RunReports, WithoutPythonTheRunSucceedsAndTheReportSaysWhatIsMissing) {
  run("oscillator");
  EXPECT_EQ(seiche("plot '" + out().string() + "'", "SEICHE_PYTHON=/nonexistent/python"), 1);
  EXPECT_THAT(said(), HasSubstr("/nonexistent/python was not found"));
  EXPECT_THAT(report(), HasSubstr("Without pictures"));
  EXPECT_THAT(report(), HasSubstr("python3-matplotlib"));
  EXPECT_THAT(report(), HasSubstr("Certificate"));
}

TEST_F(RunReports, AFolderOfNoRunGetsOneSentence) {
  EXPECT_EQ(seiche("plot '" + (directory / "none").string() + "'"), 2);
  EXPECT_THAT(said(), HasSubstr("none is no directory of a run"));
  EXPECT_EQ(seiche("plot '" + directory.string() + "'"), 2);
  EXPECT_THAT(said(), HasSubstr("is no directory of a finished run: it has no case.toml"));
  run("oscillator");
  fs::remove(out() / "solution.h5");
  EXPECT_EQ(seiche("plot '" + out().string() + "'"), 2);
  EXPECT_THAT(said(), HasSubstr("has no solution.h5 and nothing to draw: its run ended before a state was written"));
}

TEST_F(RunReports, AFailedRunIsShownUpToItsLastGoodState) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  std::ofstream(directory / "case.toml")
      << "[problem]\nname = \"klein_gordon\"\ngamma = 0\n[method]\nname = \"seilm\"\n"
         "[time]\nend = 50.0\n";
  ASSERT_EQ(seiche("run '" + (directory / "case.toml").string() + "' --quiet --out '" + out().string() + "'"), 1);
  EXPECT_EQ(seiche("plot --format svg '" + out().string() + "'"), 0) << said();
  const RunFiles files = read_run(out());
  EXPECT_EQ(shortfall(files), fmt::format("failed at t = {:.6g}", files.t));
  EXPECT_THAT(report(), HasSubstr(shortfall(files) + "</span>"));
  for (const char* picture : {"energy", "space_time_u", "profiles_v"})
    EXPECT_THAT(text_of(out() / "figures" / (std::string(picture) + ".svg")), HasSubstr("failed at t = ")) << picture;
  EXPECT_THAT(report(), HasSubstr("energy; failed at t = ")) << "instead of a picture, and for those who hear the page";
}

TEST_F(RunReports, WhatARunFallsShortOfIsKnownFromItsFiles) {
  run("klein_gordon");
  RunFiles files = read_run(out());
  EXPECT_EQ(shortfall(files), "");
  files.law = "violated";
  EXPECT_EQ(shortfall(files), "the energy law is violated");
  files.status = "interrupted";
  files.t = 0.25;
  EXPECT_EQ(shortfall(files), "interrupted at t = 0.25, the energy law is violated");
}

TEST(EnergyHistories, KeepPeaksAndSumsOfLongRunsInFewPoints) {
  const fs::path file = fs::temp_directory_path() / ("seiche_history_" + std::to_string(getpid()) + ".csv");
  {
    std::ofstream csv(file);
    csv << "t,H,H_modified,work,round_off\n";
    for (int i = 0; i <= 100000; ++i)
      csv << i * 0.01 << ',' << (i == 54321 ? 9 : std::sin(i * 0.7)) << ',' << 5 << ',' << (i == 0 ? 0 : 0.25)
          << ",0\n";
  }
  const EnergyHistory history = read_energy_history(file);
  fs::remove(file);
  EXPECT_EQ(history.rows, 100001);
  EXPECT_LT(history.H.t.size(), 5000U);
  EXPECT_EQ(history.H.t.front(), 0);
  EXPECT_EQ(history.H.t.back(), 1000);
  EXPECT_EQ(*std::max_element(history.H.value.begin(), history.H.value.end()), 9) << "no peak is lost";
  ASSERT_EQ(history.causes.size(), 2U);
  EXPECT_EQ(history.causes[0].name, "work");
  EXPECT_EQ(history.causes[0].value.back(), 25000);
  for (std::size_t i = 1; i < history.H.t.size(); ++i) ASSERT_GE(history.H.t[i], history.H.t[i - 1]);
}

}  // namespace TEST_FILE
}  // namespace seiche
