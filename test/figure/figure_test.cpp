// Every picture is drawn, the report holds every verdict and nothing from elsewhere, and bad numbers break neither.
#include <test/support/error_of.hpp>
#include <test/support/run_folder.hpp>
#include <test/support/temporary_directory.hpp>
#include <test/support/text_of.hpp>

#include <paper/pictures.hpp>
#include <paper/report.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/figure/drawing.hpp>
#include <seiche/figure/html.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cstdlib>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace seiche {
namespace TEST_FILE {

namespace fs = std::filesystem;
using test::can_draw;
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

class Figures : public test::InTemporaryDirectory {
 protected:
  std::string report() const { return text_of(directory / "report.html"); }

  void expect_drawn(const PaperResults& paper) const {
    for (const CurvePicture& picture : paper_pictures(paper)) {
      const fs::path stem = directory / "figures" / picture.stem;
      EXPECT_TRUE(text_of(stem.string() + ".png").starts_with("\x89PNG\r\n\x1a\n")) << stem;
      EXPECT_TRUE(text_of(stem.string() + ".pdf").starts_with("%PDF-")) << stem;
    }
  }
};

TEST_F(Figures, EveryPanelBecomesAPngAndAPdf) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  const PaperResults paper = results();
  std::set<std::string> stems;
  for (const CurvePicture& picture : paper_pictures(paper)) stems.insert(picture.stem);
  EXPECT_EQ(stems.size(), 5U * 4 + 1 + 1);
  for (const char* stem : {"klein_gordon_order", "klein_gordon_efficiency", "klein_gordon_energy",
                           "klein_gordon_energy_error", "alpha_fpu_formulations_efficiency", "gkdv_sigma1"}) {
    EXPECT_TRUE(stems.contains(stem)) << stem;
  }
  draw_paper(paper, directory);
  expect_drawn(paper);
}

TEST_F(Figures, ValuesThatNoAxisCanShowAreLeftOut) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
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
  write_report(paper, draw_paper(paper, directory), directory);
  expect_drawn(paper);
  std::string page = report();
  for (std::size_t at = 0; (at = page.find("base64,", at)) != std::string::npos; ++at) {
    page.erase(at, page.find('"', at) - at);  // there any three letters may meet
  }
  EXPECT_THAT(page, Not(HasSubstr("nan")));
}

TEST_F(Figures, TextIsDrawnAndNeverRun) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  PaperResults paper = results();
  paper.examples.resize(1);
  const std::string victim = (directory / "made_by_a_title").string();
  const std::vector<std::string> commands = {"`touch " + victim + "`",
                                             "'; system('touch " + victim + "'); '",
                                             "x'\nsystem('touch " + victim + "')\n",
                                             R"($\frac{ a_b^c @x &{y} ~z \)",
                                             "100 $",
                                             "a $\\alpha$"};
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

TEST_F(Figures, ZerosStandOnALineOfTheirOwnAndCoincidingCurvesAreNamed) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  PaperResults paper = results();  // the last curve of its study ends at zero
  paper.examples.resize(1);
  const auto captions = [&] {
    std::map<std::string, std::string> all;
    for (const CurvePicture& picture : draw_paper(paper, directory)) all[picture.stem] = picture.caption;
    return all;
  };
  std::map<std::string, std::string> of = captions();
  EXPECT_THAT(of["gkdv_sigma1"], HasSubstr("exactly zero"));
  EXPECT_THAT(of["klein_gordon_order"], Not(HasSubstr("coincide")));
  paper.side_studies[0].curves.pop_back();
  for (StudyRow& row : paper.examples[0].rows) {
    if (row.method == "seilm") row.error = 1e-3 * row.h * row.h;
    if (row.method == "seavf") row.error = 1.01e-3 * row.h * row.h;
  }
  of = captions();
  EXPECT_THAT(of["gkdv_sigma1"], Not(HasSubstr("exactly zero")));
  EXPECT_THAT(of["klein_gordon_order"], HasSubstr("the first of them the widest: SEAVF and SEILM."));
}

TEST_F(Figures, SideStudiesUseTheWordsOfTheMainAxes) {
  const PaperResults paper = results();
  EXPECT_EQ(side_picture(paper.side_studies[0]).x.label, example_pictures(paper.examples[0])[0].x.label);
}

// The paper has seven figures of two pictures each.
TEST_F(Figures, PicturesHaveTheNumbersOfThePaperAndVerdictsLinkToThem) {
  PaperResults paper = results();
  std::set<std::string> numbers;
  for (const CurvePicture& picture : paper_pictures(paper)) numbers.insert(picture.number);
  EXPECT_EQ(numbers.size(), 14U + 1) << "one for those that the paper has not";
  paper.verdicts[0].source = "Figure 1, left";
  paper.verdicts[1].source = "Figure 7, right, and Section 5";
  write_report(paper, paper_pictures(paper), directory);
  for (const char* text :
       {"<a href=\"#figure-1-left\">Figure 1, left</a>", "<figure id=\"figure-1-left\">", "<b>Figure 1, left.</b>",
        "<a href=\"#figure-7-right\">Figure 7, right</a>, and Section 5", "<figure id=\"figure-7-right\">"})
    EXPECT_THAT(report(), HasSubstr(text));
}

TEST_F(Figures, TheReportHoldsEveryVerdictAndNothingFromElsewhere) {
  const PaperResults paper = results();
  write_report(paper, can_draw() ? draw_paper(paper, directory) : paper_pictures(paper), directory,
               {{"Seiche", "0.1.0"}, {"a < b", "1 & 2"}});
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
  if (!can_draw()) return;
  for (const CurvePicture& picture : paper_pictures(paper))
    EXPECT_THAT(page, HasSubstr("figures/" + picture.stem + ".pdf"));
  EXPECT_THAT(page, Not(HasSubstr("not drawn")));
}

TEST_F(Figures, AQuickRunIsMarkedInPageAndFigures) {
  PaperResults paper = results();
  paper.quick = true;
  write_report(paper, paper_pictures(paper), directory);
  EXPECT_THAT(report(), HasSubstr("Quick run"));
  for (const CurvePicture& picture : paper_pictures(paper)) EXPECT_THAT(picture.title, HasSubstr("quick"));
}

TEST_F(Figures, FailedAndUnsolvedRunsAreNamed) {
  PaperResults paper = results();
  paper.examples[0].rows[0].failure = "no root for η <at> t = 3";
  paper.examples[0].rows[5].unresolved = 7;
  write_report(paper, paper_pictures(paper), directory);
  EXPECT_THAT(report(), HasSubstr("AVF at h = 2⁻⁵ did not reach the end: no root for η &lt;at&gt; t = 3"));
  EXPECT_THAT(report(), HasSubstr("SAV at h = 2⁻⁶: in 7 of 640 steps the scalar equation was not solved"));
}

class WithoutPython {
 public:
  WithoutPython() { setenv("SEICHE_PYTHON", "/nonexistent/python", 1); }
  ~WithoutPython() { unsetenv("SEICHE_PYTHON"); }
  WithoutPython(const WithoutPython&) = delete;
  WithoutPython& operator=(const WithoutPython&) = delete;
};

TEST_F(Figures, WithoutPythonTheReportIsStillWritten) {
  const PaperResults paper = results();
  const std::string sentence = [&] {
    const WithoutPython without;
    return error_of([&] { draw_paper(paper, directory); });
  }();
  EXPECT_THAT(sentence, HasSubstr("/nonexistent/python was not found"));
  EXPECT_THAT(sentence, HasSubstr("python3-matplotlib"));
  write_report(paper, paper_pictures(paper), directory, {}, sentence);
  EXPECT_THAT(report(), HasSubstr("python3-matplotlib"));
  EXPECT_THAT(report(), HasSubstr("not drawn"));
  EXPECT_THAT(report(), HasSubstr(paper.verdicts[0].claim));
}

TEST_F(Figures, FiguresOfAnEarlierRunDoNotOutliveAFailure) {
  const PaperResults paper = results();
  fs::create_directories(directory / "figures");
  std::ofstream(directory / "figures" / "klein_gordon_order.png") << "old";
  const WithoutPython without;
  EXPECT_THROW(draw_paper(paper, directory), Error);
  EXPECT_FALSE(fs::exists(directory / "figures" / "klein_gordon_order.png"));
}

TEST_F(Figures, WhatFailsIsReported) {
  if (!can_draw()) GTEST_SKIP() << "Matplotlib or h5py is not installed";
  EXPECT_THAT(error_of([&] { draw("{\"pictures\": [{}], \"formats\": [\"png\"]}", directory); }),
              HasSubstr("drawing failed: KeyError"));
  EXPECT_THAT(error_of([&] { draw("{}", directory / "absent"); }), HasSubstr("absent"));
}

}  // namespace TEST_FILE
}  // namespace seiche
