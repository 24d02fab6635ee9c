// The studies: references that can judge, errors and orders, findings that can fail, and the paper end to end.
#include <seiche/core/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/run/integrate.hpp>
#include <seiche/study/converge.hpp>
#include <seiche/study/multiplier_trace.hpp>
#include <seiche/study/paper.hpp>
#include <seiche/study/text_table.hpp>
#include <seiche/study/verdicts.hpp>
#include <test/support/error_of.hpp>
#include <test/support/paper_cases.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

namespace seiche {
namespace {

using test::gkdv_case;
using test::klein_gordon_case;

// ---- Reference

TEST(TextTables, HoldQuotedCellsOverSeveralLines) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("seiche_table_{}.csv", getpid());
  std::ofstream(file) << "member,H,message\n1,0.5,\"a, \"\"b\"\"\nand c\"\n2,,d\n";
  const TextTable table(file);
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.text(0, "message"), "a, \"b\"\nand c");
  EXPECT_EQ(table.number(0, "H"), 0.5);
  EXPECT_TRUE(std::isnan(table.number(1, "H"))) << "nothing was written";
  EXPECT_THAT(test::error_of([&] { table.number(0, "message"); }),
              testing::HasSubstr("in row 1 under message is no number"));
  EXPECT_THAT(test::error_of([&] { table.text(0, "t"); }), testing::HasSubstr("has no column t"));
  for (const auto& [text, complaint] :
       {std::pair("a,b\n1\n", "row 1 has 1 cells under 2 names"), {"a\n\"1\n", "ends inside quotes"}}) {
    std::ofstream(file) << text;
    EXPECT_THAT(test::error_of([&] { TextTable{file}; }), testing::HasSubstr(complaint));
  }
  std::filesystem::remove(file);
}

TEST(Reference, FollowsTheDampedOscillatorExactly) {
  const double gamma = 0.2;
  Problem problem = test::duffing_case(gamma);
  problem.potential = nullptr;  // q̈ + γq̇ + q = 0 from rest at q = 1
  const Reference reference = make_reference(problem, sample_times(std::vector<double>{0.01}, 20.0));
  const double w = std::sqrt(1 - gamma * gamma / 4);
  for (std::size_t k = 0; k < reference.count(); ++k) {
    const double t = reference.time(k);
    const double decay = std::exp(-gamma * t / 2);
    ASSERT_NEAR(reference.state(k)[0], decay * (std::cos(w * t) + gamma / (2 * w) * std::sin(w * t)), 1e-13) << t;
    ASSERT_NEAR(reference.state(k)[1], -decay / w * std::sin(w * t), 1e-13) << t;
  }
  EXPECT_GT(reference.error, 0);
  EXPECT_LT(reference.error, 1e-13);
}

TEST(Reference, SamplesEveryStepOfEveryStepSizeOnce) {
  const std::vector<double> times = sample_times(std::vector<double>{0.1, 0.3, 0.2}, 1.0);
  ASSERT_EQ(times.size(), 11U);
  EXPECT_EQ(times.back(), 1.0);
  const std::vector<double> uneven = sample_times(std::vector<double>{0.3}, 1.0);  // the last step is shortened
  EXPECT_EQ(uneven, (std::vector<double>{0.0, 0.3, 0.6, 3 * 0.3, 1.0}));
  EXPECT_THROW(sample_times(std::vector<double>{0.0}, 1.0), Error);
}

TEST(Reference, SaysWhereTheSolutionBlowsUp) {
  const Problem undamped = klein_gordon_case(0.0, -1.0);  // at t ≈ 12.7
  EXPECT_NO_THROW(make_reference(undamped, sample_times(std::vector<double>{0.125}, 12.0)));
  EXPECT_THROW(make_reference(undamped, sample_times(std::vector<double>{0.125}, 14.0)), Error);
}

// 1024 copies of one period of 16 points, each of which must do what a single one does.
TEST(Reference, OfFiniteDifferencesTakesThousandsOfPoints) {
  constexpr Index period = 16;
  constexpr Index copies = 1024;
  const auto problem_of = [](Index points) {
    return klein_gordon(
        {.grid = {.points = {points}, .length = {0.1 * static_cast<double>(points)}}, .gamma = constant_rate(0.1)});
  };
  Problem one = problem_of(period);
  Problem many = problem_of(copies * period);
  for (Index field = 0; field < 2; ++field)
    for (Index copy = 0; copy < copies; ++copy)
      many.initial.segment((field * copies + copy) * period, period) = one.initial.segment(field * period, period);
  const std::vector<double> times = {0.0, 0.03125};
  const Reference expected = make_reference(one, times);
  const Reference found = make_reference(many, times);
  double difference = 0;
  for (std::size_t i = 0; i < found.state(1).size(); ++i) {
    const std::size_t field = i / (copies * period);
    difference = std::max(difference, std::abs(found.state(1)[i] - expected.state(1)[field * period + i % period]));
  }
  EXPECT_LT(difference, 1e-13);
  EXPECT_GT(std::abs(expected.state(1)[0] - expected.state(0)[0]), 1e-4);
}

TEST(Reference, OfSpectralDerivativesIsRefusedWhereItsFullMatricesWouldNotFit) {
  const Problem problem =
      klein_gordon({.grid = {.points = {8192}, .length = {819.2}, .discretisation = Discretisation::spectral}});
  EXPECT_THROW(make_reference(problem, {0.0, 0.01}), Error);
}

TEST(Reference, ThatOfThePaperAgreesWithTheIndependentOne) {
  const std::vector<double> times = sample_times(std::vector<double>{1.0 / 64}, 1.0 / 16);
  const Reference paper = make_reference(gkdv_case(0.5, 0.001, 0.4), times, {.kind = ReferenceKind::seavf});
  EXPECT_GT(paper.error, 0);
  EXPECT_LT(paper.error, 1e-12);  // distance from Fehlberg 7(8)
}

// ---- Convergence

TEST(Converge, FindsTheOrdersOfKnownMethods) {
  const Convergence study = converge(klein_gordon_case(), {"seisav", "savf"}, {1.0 / 64, 1.0 / 16, 1.0 / 32},
                                     {.t_end = 5, .timing = {.repeats = 3, .seconds = 0.001}});
  ASSERT_EQ(study.rows.size(), 6U);
  double smallest = 1;
  for (const StudyRow& row : study.rows) {
    EXPECT_TRUE(row.failure.empty()) << row.failure;
    EXPECT_EQ(row.order.has_value(), row.h < 1.0 / 16);
    EXPECT_NEAR(row.order.value_or(2.0), 2.0, 0.05) << converge_table(study);
    EXPECT_TRUE(row.energy_law_held) << row.method;
    EXPECT_GT(row.cpu_seconds, 0);
    smallest = std::min(smallest, row.error);
  }
  EXPECT_LE(study.reference_error, 0.01 * smallest);
}

TEST(Converge, GivesNoOrderWhereErrorsAreThoseOfTheReference) {
  const Convergence study =
      converge(test::duffing_case(), {"egc8"}, {0.5, 0.25, 0.125, 1.0 / 32, 1.0 / 64}, {.t_end = 1, .timed = false});
  ASSERT_EQ(study.rows.size(), 5U);
  ASSERT_TRUE(study.rows[2].order) << "from errors far above round-off";
  EXPECT_GT(*study.rows[2].order, 6);
  EXPECT_FALSE(study.rows.back().order) << "error " << study.rows.back().error;
  EXPECT_NE(converge_table(study).find("–"), std::string::npos);
}

TEST(Converge, WritesTheDocumentOfTheInterface) {
  const Convergence study = converge(klein_gordon_case(), {"seilm"}, {0.125, 0.0625}, {.t_end = 1, .timed = false});
  const nlohmann::json document = nlohmann::json::parse(converge_json(study));
  EXPECT_EQ(document.at("problem"), "klein_gordon");
  EXPECT_TRUE(document.at("reference").is_string());
  ASSERT_EQ(document.at("rows").size(), 2U);
  EXPECT_TRUE(document.at("rows")[0].at("order").is_null());
  EXPECT_NEAR(document.at("rows")[1].at("order").get<double>(), 2.0, 0.3);
  for (const char* key : {"method", "h", "error", "energy_error", "max_energy_increase", "max_modified_increase",
                          "scalar_iterations", "unresolved", "cpu_seconds"}) {
    EXPECT_TRUE(document.at("rows")[0].contains(key)) << key;
  }
}

TEST(Converge, RefusesAMethodThatDoesNotApply) {
  EXPECT_THROW(converge(gkdv_case(0.5, 0.001, 0.4), {"seisav", "sav"}, {0.125}, {.t_end = 1}), Error);
}

TEST(Converge, RecordsARunThatFailsAndGoesOn) {
  // C leaves V(z₀) + C = 1e-5, and as printed the scheme has no guard: V(ẑ) + C falls below zero.
  ConvergeOptions options{.t_end = 2, .timed = true, .timing = {.repeats = 1, .seconds = 0}};
  options.method_options = {.C = 0.11158, .auxiliary = AuxiliaryMode::frozen, .scalar_solver = ScalarSolver::robust};
  Problem problem = klein_gordon_case();
  problem.initial.tail(20).array() += 0.2;  // outwards, so that V = −¼Σu⁴ falls
  const Convergence study = converge(problem, {"ssav", "savf"}, {0.125, 0.0625}, options);
  ASSERT_EQ(study.rows.size(), 4U);
  EXPECT_FALSE(study.rows[0].failure.empty());
  EXPECT_EQ(study.rows[0].cpu_seconds, 0);
  EXPECT_TRUE(study.rows[3].failure.empty()) << study.rows[3].failure;
  EXPECT_TRUE(study.rows[3].order.has_value());
}

TEST(Multiplier, IsRecoveredFromTheStates) {
  const double h = 1.0 / 32;
  const double eta = 1.37;
  Simulation simulation(gkdv_case(0.5, 1.0, 1.0), {.method = "seilm"});
  const System& system = simulation.system();
  MultiplierTrace trace(system, h);
  State state = simulation.state();
  trace.observe(state, {});
  const auto propagator = system.linear->propagator(PropagatorKind::exponential, h);
  Vector gradient = state.z, z_mid = state.z, increment = state.z, q = state.z;
  system.damping->flow(0, h / 2, state.z);
  system.potential->gradient(state.z, gradient);
  propagator->predict(state.z, gradient, z_mid);
  system.potential->gradient(z_mid, gradient);
  propagator->increment(state.z, increment);
  propagator->force(gradient, q);
  state.z += increment + eta * q;
  system.damping->flow(h / 2, h / 2, state.z);
  state.t = h;
  state.n = 1;
  trace.observe(state, {});
  ASSERT_EQ(trace.eta().size(), 1U);
  EXPECT_NEAR(trace.eta()[0], eta, 1e-10);
}

// ---- Findings, each both ways

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

// ---- Verdicts on made-up evidence, each both ways

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

// ---- The paper, quick

TEST(PaperStudySlow, QuickRunHasAllPanelsVerdictsAndFiles) {
  const PaperResults results = run_paper({.quick = true});
  EXPECT_TRUE(results.quick);
  ASSERT_EQ(results.examples.size(), 5U);
  std::size_t panels = results.side_studies.size();
  for (const ExampleResult& example : results.examples) {
    EXPECT_EQ(example.methods.size(), example.key.starts_with("gkdv") ? 6U : 8U);
    EXPECT_EQ(example.rows.size(), example.methods.size() * example.step_sizes.size());
    EXPECT_EQ(example.energy.size(), example.methods.size() + 1);
    EXPECT_EQ(example.energy.back().name, "reference");
    EXPECT_EQ(example.energy_errors.size(), example.methods.size());
    panels += 4;  // orders, efficiency, energy, energy error
    for (const StudyRow& row : example.rows) {
      EXPECT_TRUE(row.failure.empty()) << row.method << ": " << row.failure;
      EXPECT_GT(row.cpu_seconds, 0);
      EXPECT_LE(example.reference_error, 0.01 * row.error) << example.key << ' ' << row.method;
    }
  }
  EXPECT_GE(panels, 14U);
  for (const SideStudy& study : results.side_studies) {
    EXPECT_FALSE(study.curves.empty()) << study.key;
    EXPECT_FALSE(study.explanation.empty()) << study.key;
  }

  EXPECT_GE(results.verdicts.size(), 40U);
  std::set<Outcome> outcomes;
  for (const Verdict& verdict : results.verdicts) {
    EXPECT_FALSE(verdict.measured.empty()) << verdict.claim;
    EXPECT_FALSE(verdict.source.empty()) << verdict.claim;
    EXPECT_EQ(verdict.measured.find("not measured"), std::string::npos) << verdict.claim;
    outcomes.insert(verdict.outcome);
  }
  EXPECT_TRUE(outcomes.contains(Outcome::holds));

  const std::filesystem::path directory = std::filesystem::path(testing::TempDir()) / "seiche_paper_study";
  std::filesystem::remove_all(directory);
  write_results(results, directory);
  for (const char* file :
       {"data/klein_gordon_errors.csv", "data/gkdv_mu01_energy_errors.csv", "data/gkdv_sigma1.csv", "verdicts.csv"}) {
    std::ifstream in(directory / file);
    std::string header, first;
    EXPECT_TRUE(std::getline(in, header) && std::getline(in, first)) << file;
  }
  EXPECT_EQ(nlohmann::json::parse(paper_json(results)).at("verdicts").size(), results.verdicts.size());
  std::filesystem::remove_all(directory);
}

TEST(PaperStudy, StopsWhenAsked) {
  std::atomic<bool> stop = true;
  const PaperResults nothing = run_paper({.quick = true, .stop = &stop});
  EXPECT_TRUE(nothing.examples.empty());
  EXPECT_TRUE(nothing.verdicts.empty());

  stop = false;
  const auto stop_at_the_second = [&](double done, std::string_view) { stop = done > 0.1; };
  const PaperResults one = run_paper({.quick = true, .progress = stop_at_the_second, .stop = &stop});
  EXPECT_EQ(one.examples.size(), 1U);
  EXPECT_TRUE(one.verdicts.empty());
}

}  // namespace
}  // namespace seiche
