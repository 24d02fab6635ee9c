// Every picture is drawn, the report holds every verdict and nothing from elsewhere, and bad numbers break neither.
#include <test/support/error_of.hpp>
#include <test/support/temporary_directory.hpp>
#include <test/support/text_of.hpp>

#include <paper/pictures.hpp>
#include <paper/report.hpp>
#include <seiche/core/error.hpp>
#include <seiche/figure/gnuplot.hpp>
#include <seiche/figure/html.hpp>
#include <seiche/figure/plot/coincide.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cstdlib>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using test::error_of;
using test::text_of;
using testing::HasSubstr;
using testing::Not;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// Errors of order two, energies that decay: what a study brings.
ExampleResult example(const std::string& key, const std::string& title) {
  ExampleResult result;
  result.key = key;
  result.title = title;
  result.parameters = "N = 20";
  result.t_end = 10;
  result.methods = {"avf", "sav", "savf", "seavf", "ssav", "slm", "seisav", "seilm"};
  for (int j = 5; j < 9; ++j) result.step_sizes.push_back(std::ldexp(1.0, -j));
  result.curve_h = result.step_sizes.front();
  result.reference = "Fehlberg 7(8)";
  result.reference_error = 1e-14;
  double size = 7.0;
  for (const std::string& method : result.methods) {
    Curve energy{method, {}, {}};
    Curve error{method, {}, {}};
    for (int i = 0; i <= 400; ++i) {
      const double t = i / 40.0;
      energy.t.push_back(t);
      error.t.push_back(t);
      energy.value.push_back(0.5 * std::exp(-t));
      error.value.push_back(std::abs(size * 1e-4 * std::sin(3 * t) * std::exp(-t)));
    }
    result.energy.push_back(energy);
    result.energy_errors.push_back(error);
    for (const double h : result.step_sizes) {
      StudyRow row;
      row.method = method;
      row.h = h;
      row.error = size * h * h;
      row.energy_error = size * 1e-2 * h * h;
      if (h < result.curve_h) row.order = 2.0;
      row.steps = static_cast<long long>(10 / h);
      row.cpu_seconds = 1e-5 / h;
      row.energy_law_held = true;
      result.rows.push_back(row);
    }
    size /= 5;
  }
  Curve reference = result.energy.front();
  reference.name = "reference";
  result.energy.push_back(reference);
  return result;
}

PaperResults results() {
  PaperResults paper;
  paper.examples = {example("klein_gordon", "Example 1: damped nonlinear Klein–Gordon equation"),
                    example("alpha_fpu_conservative", "Example 2.1: damped α-FPU equation"),
                    example("alpha_fpu_dissipative", "Example 2.2: damped α-FPU equation"),
                    example("gkdv", "Example 3: damped gKdV equation"),
                    example("gkdv_mu01", "Example 3 with μ = 0.1, where SEILM is fragile")};
  paper.side_studies = {{.key = "gkdv_sigma1",
                         .title = "gKdV with σ = 1",
                         .explanation = "Printed & repaired.",
                         .x_label = "time step h",
                         .y_label = "maximal error",
                         .curves = {{"SEISAV as printed", {0.25, 0.125, 0.0625}, {1e-2, 1e-2, 1e-2}},
                                    {"SEISAV, repaired", {0.25, 0.125, 0.0625}, {4e-4, 1e-4, 2.5e-5}},
                                    {"something else", {0.25, 0.125, 0.0625}, {1e-1, 2e-1, 0}}}}};
  paper.verdicts = {
      {"Example 1", "Every method is of order two.", "Section 5", "orders 2.00 to 2.01", Outcome::holds, ""},
      {"Example 3", "All decay.", "Section 5", "a rise of 3", Outcome::does_not_hold, "only if μ < 0.1 & h > 1"},
      {"all", "Two are the fastest.", "Section 5", "1.2 × \"faster\"", Outcome::depends, "<script>alert(1)</script>"}};
  paper.seconds = 12;
  return paper;
}

bool have_gnuplot() {
  static const bool found = error_of([] { run_gnuplot({"exit\n"}, fs::temp_directory_path()); }).empty();
  return found;
}

class Figures : public test::InTemporaryDirectory {
 protected:
  std::string report() const { return text_of(directory / "report.html"); }

  void expect_drawn(const PaperResults& paper) const {
    for (const CurvePicture& picture : paper_pictures(paper)) {
      const fs::path stem = directory / "figures" / picture.plot.stem;
      EXPECT_TRUE(text_of(stem.string() + ".png").starts_with("\x89PNG\r\n\x1a\n")) << stem;
      EXPECT_TRUE(text_of(stem.string() + ".pdf").starts_with("%PDF-")) << stem;
    }
  }
};

TEST_F(Figures, EveryPanelBecomesAPngAndAPdf) {
  if (!have_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const PaperResults paper = results();
  std::set<std::string> stems;
  for (const CurvePicture& picture : paper_pictures(paper)) stems.insert(picture.plot.stem);
  EXPECT_EQ(stems.size(), 5U * 4 + 1 + 1);
  for (const char* stem : {"klein_gordon_order", "klein_gordon_efficiency", "klein_gordon_energy",
                           "klein_gordon_energy_error", "alpha_fpu_formulations_efficiency", "gkdv_sigma1"}) {
    EXPECT_TRUE(stems.contains(stem)) << stem;
  }
  draw_paper(paper, directory);
  expect_drawn(paper);
}

TEST_F(Figures, ValuesThatNoAxisCanShowAreLeftOut) {
  if (!have_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const double bad[] = {0, -1, nan, infinity, -infinity, 5e-324, 1e308};
  PaperResults paper = results();
  std::size_t next = 0;
  for (ExampleResult& one : paper.examples) {
    for (StudyRow& row : one.rows) {
      if (next % 3 == 0) row.error = bad[next % std::size(bad)];
      if (next % 4 == 0) row.cpu_seconds = bad[next % std::size(bad)];
      ++next;
    }
    for (std::vector<Curve>* curves : {&one.energy, &one.energy_errors}) {
      for (Curve& curve : *curves) {
        curve.value[next % curve.value.size()] = bad[next % std::size(bad)];
        ++next;
      }
    }
  }
  // Nothing at all to show; a curve that stops early; one point only.
  for (StudyRow& row : paper.examples[1].rows) row.error = row.cpu_seconds = nan;
  for (Curve& curve : paper.examples[2].energy_errors) curve.value.assign(curve.value.size(), 0.0);
  paper.examples[3].energy[0] = {"avf", {0.0}, {0.5}};
  paper.examples[3].energy_errors.clear();
  paper.examples[4].rows.clear();
  paper.examples[4].energy.clear();
  paper.side_studies[0].curves.clear();
  draw_paper(paper, directory);
  expect_drawn(paper);
  write_report(paper, directory);
  std::string page = report();
  for (std::size_t at = 0; (at = page.find("base64,", at)) != std::string::npos; ++at) {
    page.erase(at, page.find('"', at) - at);  // there any three letters may meet
  }
  EXPECT_THAT(page, Not(HasSubstr("nan")));
}

TEST_F(Figures, TextIsDrawnAndNeverRun) {
  if (!have_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  PaperResults paper = results();
  paper.examples.resize(1);
  const std::string victim = (directory / "made_by_a_title").string();
  const std::vector<std::string> commands = {"`touch " + victim + "`", "'; system('touch " + victim + "'); '",
                                             "x'\nsystem('touch " + victim + "')\n", R"({/=99 a_b^c @x &{y} ~z \)"};
  for (const std::string& command : commands) {
    paper.examples[0].title = command;
    paper.side_studies[0].title = paper.side_studies[0].x_label = paper.side_studies[0].curves[2].name = command;
    draw_paper(paper, directory);
    EXPECT_FALSE(fs::exists(victim)) << command;
    expect_drawn(paper);
  }
  paper.side_studies[0].key = "../outside";
  EXPECT_THAT(error_of([&] { draw_paper(paper, directory); }), HasSubstr("../outside"));
}

TEST_F(Figures, DigitsAfterPunctuationStayDigits) {
  if (!have_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const std::vector<std::string> texts = {"μ = 0.1", "2.1", "a_1", "(1,2)", "h = 2^-7, 89.0", "7.77.7"};
  std::string script = "set print 'printed.txt'\n";
  for (const std::string& text : texts) script += "print " + gnuplot_file(text) + "\n";
  run_gnuplot({script + "print " + gnuplot_text("0.1_2") + "\n"}, directory);
  std::string expected;
  for (const std::string& text : texts) expected += text + "\n";
  EXPECT_EQ(text_of(directory / "printed.txt"), expected + "0.1\\_2\n");
}

TEST_F(Figures, ZerosStandOnALineOfTheirOwn) {
  const PaperResults paper = results();
  const CurvePicture picture = side_picture(paper.side_studies[0]);  // its last curve ends at zero
  const Plot& plot = picture.plot;
  EXPECT_THAT(picture.caption, HasSubstr("exactly zero"));
  EXPECT_THAT(plot.y.ticks, HasSubstr("'0'"));
  ASSERT_EQ(plot.series.size(), 3U);
  const double zero = plot.series.back().y.back();
  EXPECT_GT(plot.y.place(zero), 0);
  for (const Series& series : plot.series) {
    for (const double value : series.y) EXPECT_LE(plot.y.place(zero), plot.y.place(value));
  }
  SideStudy without = paper.side_studies[0];
  without.curves.pop_back();
  without.curves.push_back({"SEILM, not a point", {}, {}});
  const CurvePicture other = side_picture(without);
  EXPECT_THAT(other.caption, Not(HasSubstr("exactly zero")));
  EXPECT_EQ(other.plot.series.size(), 2U) << "a curve without a point stays out of the legend";
}

TEST_F(Figures, SideStudiesUseTheWordsOfTheMainAxes) {
  const PaperResults paper = results();
  EXPECT_EQ(side_picture(paper.side_studies[0]).plot.x_label, example_pictures(paper.examples[0])[0].plot.x_label);
}

TEST_F(Figures, CoincidingCurvesAreNamedAndToldApart) {
  ExampleResult one = results().examples[0];
  const std::string before = example_pictures(one)[0].caption;
  EXPECT_THAT(before, Not(HasSubstr("coincide")));
  for (StudyRow& row : one.rows) {
    if (row.method == "seilm") row.error = 1e-3 * row.h * row.h;
    if (row.method == "seavf") row.error = 1.01e-3 * row.h * row.h;
  }
  const CurvePicture picture = example_pictures(one)[0];
  EXPECT_THAT(picture.caption, HasSubstr("coincide within the width of a line: SEAVF and SEILM."));
  EXPECT_THAT(picture.caption, HasSubstr("SEAVF is drawn as dashes"));
  int dashed = 0;
  for (const Series& series : picture.plot.series) {
    if (series.style.dash != Dash::long_dashed) continue;
    EXPECT_EQ(series.label, "SEAVF");
    EXPECT_EQ(series.layer, coinciding_layer);
    ++dashed;
  }
  EXPECT_EQ(dashed, 1);
}

TEST_F(Figures, TheReportHoldsEveryVerdictAndNothingFromElsewhere) {
  const PaperResults paper = results();
  if (have_gnuplot()) draw_paper(paper, directory);
  write_report(paper, directory, {{"Seiche", "0.1.0"}, {"a < b", "1 & 2"}});
  const std::string page = report();
  for (const Verdict& verdict : paper.verdicts) {
    for (const std::string& text : {verdict.claim, verdict.measured, verdict.remark, to_string(verdict.outcome)}) {
      EXPECT_THAT(page, HasSubstr(html_escaped(text)));
    }
  }
  EXPECT_THAT(page, HasSubstr("a &lt; b"));
  for (const char* foreign : {"http:", "https:", "src=\"//", "@import", "url(", "<link", "<script", "<iframe"}) {
    EXPECT_EQ(page.find(foreign), std::string::npos) << foreign;
  }
  EXPECT_THAT(page, Not(HasSubstr("Quick run")));
  if (!have_gnuplot()) return;
  for (const CurvePicture& picture : paper_pictures(paper))
    EXPECT_THAT(page, HasSubstr("figures/" + picture.plot.stem + ".pdf"));
  EXPECT_THAT(page, Not(HasSubstr("not drawn")));
}

TEST_F(Figures, AQuickRunIsMarkedInPageAndFigures) {
  PaperResults paper = results();
  paper.quick = true;
  write_report(paper, directory);
  EXPECT_THAT(report(), HasSubstr("Quick run"));
  for (const CurvePicture& picture : paper_pictures(paper)) EXPECT_THAT(picture.plot.title, HasSubstr("quick"));
}

TEST_F(Figures, FailedAndUnsolvedRunsAreNamed) {
  PaperResults paper = results();
  paper.examples[0].rows[0].failure = "no root for η <at> t = 3";
  paper.examples[0].rows[5].unresolved = 7;
  write_report(paper, directory);
  EXPECT_THAT(report(), HasSubstr("AVF at h = 2⁻⁵ did not reach the end: no root for η &lt;at&gt; t = 3"));
  EXPECT_THAT(report(), HasSubstr("SAV at h = 2⁻⁶: in 7 of 640 steps the scalar equation was not solved"));
}

TEST_F(Figures, WithoutGnuplotTheReportIsStillWritten) {
  const PaperResults paper = results();
  const char* before = std::getenv("PATH");
  const std::string path = before ? before : "";
  setenv("PATH", directory.c_str(), 1);
  const std::string sentence = error_of([&] { draw_paper(paper, directory); });
  setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(sentence, HasSubstr("gnuplot was not found"));
  EXPECT_THAT(sentence, HasSubstr("gnuplot-nox"));
  write_report(paper, directory, {}, sentence);
  EXPECT_THAT(report(), HasSubstr("gnuplot-nox"));
  EXPECT_THAT(report(), HasSubstr("not drawn"));
  EXPECT_THAT(report(), HasSubstr(paper.verdicts[0].claim));
}

TEST_F(Figures, FiguresOfAnEarlierRunDoNotOutliveAFailure) {
  const PaperResults paper = results();
  fs::create_directories(directory / "figures");
  std::ofstream(directory / "figures" / "klein_gordon_order.png") << "old";
  const char* before = std::getenv("PATH");
  const std::string path = before ? before : "";
  setenv("PATH", directory.c_str(), 1);
  EXPECT_THROW(draw_paper(paper, directory), Error);
  setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(fs::exists(directory / "figures" / "klein_gordon_order.png"));
}

TEST_F(Figures, WhatGnuplotSaysIsReported) {
  if (!have_gnuplot()) GTEST_SKIP() << "gnuplot is not installed";
  const std::string message = error_of([&] { run_gnuplot({"exit\n", "set no_such_option\n"}, directory); });
  EXPECT_THAT(message, HasSubstr("no_such_option"));
  EXPECT_THAT(error_of([&] { run_gnuplot({"exit\n"}, directory / "absent"); }), HasSubstr("absent"));
}

}  // namespace TEST_FILE
}  // namespace seiche
