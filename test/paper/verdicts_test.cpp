// What the paper claims, judged by rows of numbers.
#include <paper/paper.hpp>
#include <paper/verdicts.hpp>
#include <paper/verdicts_overall.hpp>
#include <seiche/study/converge.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace seiche {
namespace TEST_FILE {

// Rows with error = scale·h^order and time = cost/h.
std::vector<StudyRow> synthetic(const std::string& method, double scale, double order, double cost) {
  std::vector<StudyRow> rows;
  for (const double h : {0.1, 0.05, 0.025}) {
    StudyRow row;
    row.method = method;
    row.h = h;
    row.error = scale * std::pow(h, order);
    row.energy_error = row.error / 10;
    row.max_energy_increase = -1e-6;
    row.steps = static_cast<long long>(10 / h);
    row.cpu_seconds = cost / h;
    row.energy_law_held = true;
    rows.push_back(row);
  }
  return rows;
}

std::vector<StudyRow> operator+(std::vector<StudyRow> a, const std::vector<StudyRow>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

ExampleResult example_with(std::vector<StudyRow> rows) {
  ExampleResult example;
  example.key = "klein_gordon";
  example.t_end = 50;
  example.rows = std::move(rows);
  for (const StudyRow& row : example.rows) {
    if (example.methods.empty() || example.methods.back() != row.method) example.methods.push_back(row.method);
  }
  return example;
}

TEST(Findings, OrderTwoIsSeenAndMissed) {
  EXPECT_EQ(all_of_order_two(synthetic("a", 1, 2, 1) + synthetic("b", 3, 2.05, 1), {"a", "b"}).outcome, Outcome::holds);
  EXPECT_EQ(all_of_order_two(synthetic("a", 1, 2, 1) + synthetic("b", 3, 1, 1), {"a", "b"}).outcome, Outcome::depends);
  EXPECT_EQ(all_of_order_two(synthetic("a", 1, 1, 1), {"a"}).outcome, Outcome::does_not_hold);
  EXPECT_NE(all_of_order_two({}, {"a"}).outcome, Outcome::holds);
  std::vector<StudyRow> stopped = synthetic("a", 1, 2, 1);
  stopped.back().failure = "stopped";
  EXPECT_NE(all_of_order_two(stopped, {"a"}).outcome, Outcome::holds);
}

TEST(Findings, AccuracyIsComparedAtEveryStepSize) {
  const auto rows = synthetic("good", 1, 2, 1) + synthetic("bad", 5, 2, 1) + synthetic("mixed", 0.07, 1, 1);
  EXPECT_EQ(more_accurate(rows, {"good"}, {"bad"}).outcome, Outcome::holds);
  EXPECT_EQ(more_accurate(rows, {"bad"}, {"good"}).outcome, Outcome::does_not_hold);
  EXPECT_EQ(more_accurate(rows, {"good"}, {"bad", "mixed"}).outcome, Outcome::depends);
  EXPECT_EQ(smaller(rows, "good", "bad", error_of, "error").outcome, Outcome::holds);
  EXPECT_EQ(smaller(rows, "bad", "good", error_of, "error").outcome, Outcome::does_not_hold);
  EXPECT_EQ(smaller(rows, "good", "good", error_of, "error").outcome, Outcome::depends);
  EXPECT_EQ(larger_by(rows, "bad", "good", error_of, 3, "error").outcome, Outcome::holds);
  EXPECT_EQ(larger_by(rows, "bad", "good", error_of, 6, "error").outcome, Outcome::depends);
  EXPECT_EQ(larger_by(rows, "good", "bad", error_of, 3, "error").outcome, Outcome::does_not_hold);
  EXPECT_EQ(comparable(rows, {"good", "good"}, error_of, 1.5, "error").outcome, Outcome::holds);
  EXPECT_EQ(comparable(rows, {"good", "bad"}, error_of, 4, "error").outcome, Outcome::depends);
  EXPECT_EQ(comparable(rows, {"good", "bad"}, error_of, 1.5, "error").outcome, Outcome::does_not_hold);
}

TEST(Findings, EfficiencyWeighsErrorAgainstTime) {
  // Of order two, a quarter of the error is worth twice the time.
  const auto rows = synthetic("exact", 1, 2, 2) + synthetic("cheap", 16, 2, 1);
  EXPECT_NEAR(*speed_ratio(rows, "cheap", "exact"), 2.0, 1e-9);
  EXPECT_EQ(more_efficient(rows, {{"exact", "cheap"}}).outcome, Outcome::holds);
  EXPECT_EQ(more_efficient(rows, {{"exact", "cheap"}}, 3.0).outcome, Outcome::depends);
  EXPECT_EQ(more_efficient(rows, {{"cheap", "exact"}}).outcome, Outcome::does_not_hold);
  const std::vector<std::pair<std::string, std::string>> mixed = {{"exact", "cheap"}, {"cheap", "exact"}};
  EXPECT_EQ(more_efficient(rows, mixed).outcome, Outcome::does_not_hold);
  EXPECT_EQ(more_efficient(rows, mixed, clear_ratio, Quantifier::most).outcome, Outcome::depends);
  EXPECT_EQ(cheaper(rows, {{"cheap", "exact"}}).outcome, Outcome::holds);
  EXPECT_EQ(cheaper(rows, {{"exact", "cheap"}}).outcome, Outcome::does_not_hold);
  EXPECT_FALSE(speed_ratio(rows, "cheap", "absent").has_value());
  EXPECT_EQ(more_efficient(rows, {{"absent", "cheap"}}).outcome, Outcome::depends);  // not measured
}

TEST(Findings, ARisingEnergyIsSeen) {
  std::vector<StudyRow> rows = synthetic("a", 1, 2, 1);
  EXPECT_EQ(monotone(rows, 1.0).outcome, Outcome::holds);
  rows[0].max_energy_increase = 1e-16;  // round-off
  EXPECT_EQ(monotone(rows, 1.0).outcome, Outcome::holds);
  rows[0].max_energy_increase = 1e-9;
  EXPECT_EQ(monotone(rows, 1.0).outcome, Outcome::depends);
  for (StudyRow& row : rows) row.max_energy_increase = 1e-9;
  EXPECT_EQ(monotone(rows, 1.0).outcome, Outcome::does_not_hold);
}

TEST(Findings, TheWorstOfSeveralCounts) {
  const Finding good{Outcome::holds, "1"}, unsure{Outcome::depends, "2"}, bad{Outcome::does_not_hold, "3"};
  EXPECT_EQ(combined({good, good}).outcome, Outcome::holds);
  EXPECT_EQ(combined({good, unsure}).outcome, Outcome::depends);
  EXPECT_EQ(combined({bad, unsure, good}).outcome, Outcome::does_not_hold);
  EXPECT_EQ(combined({good, unsure}).measured, "1; 2");
}

TEST(Verdicts, LawsAreJudgedByTheRuns) {
  Evidence evidence;
  evidence.seisav_laws = {{.scheme = "s", .runs = 3, .held = 3}};
  evidence.seilm_laws = {{.scheme = "s", .runs = 3, .held = 3}};
  EXPECT_EQ(law_of_seisav(evidence).outcome, Outcome::holds);
  EXPECT_EQ(law_of_seilm(evidence).outcome, Outcome::holds);
  evidence.seisav_laws[0].held = evidence.seilm_laws[0].held = 2;
  EXPECT_EQ(law_of_seisav(evidence).outcome, Outcome::does_not_hold);
  EXPECT_EQ(law_of_seilm(evidence).outcome, Outcome::does_not_hold);
  evidence.seisav_laws[0].failed = evidence.seilm_laws[0].failed = 1;
  EXPECT_EQ(law_of_seisav(evidence).outcome, Outcome::depends);
  EXPECT_EQ(law_of_seilm(evidence).outcome, Outcome::depends);

  const std::vector<LawCheck> exact = {{.scheme = "s", .runs = 1, .held = 1, .largest_drift = 1e-15}};
  const std::vector<LawCheck> drifting = {{.scheme = "s", .runs = 1, .held = 1, .largest_drift = 1e-9}};
  EXPECT_EQ(laws_without_damping(exact, true).outcome, Outcome::holds);
  EXPECT_EQ(laws_without_damping(drifting, true).outcome, Outcome::does_not_hold);
  EXPECT_EQ(laws_without_damping(drifting, false).outcome, Outcome::holds);
}

TEST(Verdicts, WordsFitTheNumbers) {
  const std::vector<LawCheck> falling = {{.scheme = "s", .runs = 8, .held = 8}};
  EXPECT_EQ(laws_without_damping(falling, false).measured, "no rise in 8 runs");
  Evidence evidence;
  for (const char* key : {"klein_gordon", "gkdv"}) {
    ExampleEvidence example;
    example.key = key;
    evidence.examples.push_back(example);
  }
  evidence.examples[1].refused = {"avf", "sav"};
  EXPECT_EQ(only_where_a_gradient_form_exists(evidence).measured,
            "all accept both, except gkdv, which refuses avf and sav");
  EXPECT_EQ(only_where_a_gradient_form_exists(evidence).outcome, Outcome::holds);
  evidence.examples[1].refused = {};
  EXPECT_EQ(only_where_a_gradient_form_exists(evidence).measured, "all accept both");
  EXPECT_EQ(only_where_a_gradient_form_exists(evidence).outcome, Outcome::does_not_hold);
  evidence.without_ecld_exact_rise = 1;
  evidence.without_ecld = {synthetic("seilm", 1, 2, 1).front()};
  const Finding finding = law_of_seilm(evidence);
  EXPECT_NE(finding.measured.find("by 100 % of |H(z₀)|"), std::string::npos) << finding.measured;
  EXPECT_EQ(finding.measured.find("ECLD"), std::string::npos) << finding.measured;
}

TEST(Verdicts, TheMultiplierTheoremNeedsMoreThanTheMetric) {
  Evidence evidence;
  evidence.seilm_laws = {{.scheme = "s", .runs = 3, .held = 3}};
  evidence.without_ecld_exact_rise = 0.5;
  evidence.without_ecld = {synthetic("seilm", 1, 2, 1).front()};
  EXPECT_EQ(law_of_seilm(evidence).outcome, Outcome::holds);
  evidence.without_ecld[0].energy_law_held = false;
  EXPECT_EQ(law_of_seilm(evidence).outcome, Outcome::depends);
}

TEST(Verdicts, TheReferenceIsJudgedAgainstTheSmallestError) {
  PaperResults results;
  results.examples = {example_with(synthetic("seisav", 1, 2, 1))};  // smallest error 6e-4
  Evidence evidence;
  evidence.examples = {ExampleEvidence()};
  evidence.examples[0].key = "klein_gordon";
  evidence.examples[0].seavf_reference_end = 1;
  for (const auto& [distance, outcome] :
       {std::pair(1e-9, Outcome::holds), std::pair(1e-6, Outcome::depends), std::pair(1e-3, Outcome::does_not_hold)}) {
    evidence.examples[0].seavf_reference_distance = distance;
    EXPECT_EQ(paper_reference_suffices(results, evidence).outcome, outcome) << distance;
  }
}

TEST(Verdicts, EfficiencyAtAnyToleranceNeedsAMargin) {
  PaperResults results;
  const auto ours = synthetic("seisav", 1, 2, 1) + synthetic("seilm", 1, 2, 1);
  const auto with_rival = [&](double cost, long long sweeps) {
    std::vector<StudyRow> rival = synthetic("seavf", 1, 2, cost);
    for (StudyRow& row : rival) row.scalar_iterations = sweeps * row.steps;
    results.examples = {example_with(ours + rival)};
    return efficient_at_any_tolerance(results).outcome;
  };
  EXPECT_EQ(with_rival(5, 2), Outcome::holds);
  EXPECT_EQ(competitive(results).outcome, Outcome::holds);
  EXPECT_EQ(with_rival(2, 4), Outcome::depends);
  EXPECT_EQ(with_rival(0.5, 1), Outcome::does_not_hold);
  EXPECT_EQ(competitive(results).outcome, Outcome::does_not_hold);
}

TEST(Verdicts, FragilityIsSeenAndItsCauseToldApart) {
  const ExampleResult example = example_with(synthetic("seilm", 1, 2, 1));
  ExampleEvidence evidence;
  evidence.others = synthetic("seilm frozen newton", 1000, 1, 1) + synthetic("seilm newton", 1, 2, 1);
  EXPECT_EQ(printed_multiplier_is_fragile(example, evidence).outcome, Outcome::holds);
  EXPECT_EQ(newton_is_the_cause(example, evidence).outcome, Outcome::does_not_hold);
  evidence.others = synthetic("seilm frozen newton", 1, 2, 1) + synthetic("seilm newton", 50, 1, 1);
  EXPECT_EQ(printed_multiplier_is_fragile(example, evidence).outcome, Outcome::does_not_hold);
  EXPECT_EQ(newton_is_the_cause(example, evidence).outcome, Outcome::holds);
}

TEST(Verdicts, SolversAreJudgedByTheirWork) {
  PaperResults results;
  results.examples = {example_with(synthetic("seisav", 1, 2, 1) + synthetic("seilm", 1, 2, 1.5))};
  EXPECT_EQ(needs_no_iteration(results).outcome, Outcome::holds);
  EXPECT_EQ(multiplier_is_cheap(results, {}).outcome, Outcome::holds);
  results.examples = {example_with(synthetic("seisav", 1, 2, 1) + synthetic("seilm", 1, 2, 5))};
  results.examples[0].rows[0].scalar_iterations = 1;
  EXPECT_EQ(needs_no_iteration(results).outcome, Outcome::does_not_hold);
  EXPECT_EQ(multiplier_is_cheap(results, {}).outcome, Outcome::does_not_hold);

  Evidence evidence;
  evidence.examples = {ExampleEvidence()};
  evidence.examples[0].key = "klein_gordon";
  evidence.examples[0].others = synthetic("seilm newton", 1, 2, 1);
  evidence.examples[0].share_of_tiny_potential = 0.5;
  evidence.examples[0].others[0].unresolved = 3;
  const Finding tolerance = absolute_tolerance_is_enough(evidence);  // that test itself is not run
  EXPECT_EQ(tolerance.outcome, Outcome::depends);
  EXPECT_NE(tolerance.measured.find("50 %"), std::string::npos) << tolerance.measured;
  EXPECT_NE(tolerance.measured.find("3 scalar equations"), std::string::npos) << tolerance.measured;
}

}  // namespace TEST_FILE
}  // namespace seiche
