// References, and the orders that are found with them.
#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/study/converge.hpp>
#include <test/support/cases.hpp>
#include <test/support/error_of.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace seiche {
namespace TEST_FILE {

using test::gkdv_case;
using test::klein_gordon_case;

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

TEST(Reference, AReferenceThatWouldNeverEndIsRefused) {
  Problem problem = test::duffing_case(1e9);
  for (const ReferenceKind kind : {ReferenceKind::fehlberg78, ReferenceKind::seavf}) {
    const std::string message = test::error_of([&] { make_reference(problem, {0.0, 5e8, 1e9}, {.kind = kind}); });
    EXPECT_NE(message.find("would take"), std::string::npos) << message;
    EXPECT_NE(message.find("choose an earlier end"), std::string::npos) << message;
  }
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

TEST(Reference, ThePapersReferenceAgreesWithTheIndependentOne) {
  const std::vector<double> times = sample_times(std::vector<double>{1.0 / 64}, 1.0 / 16);
  const Reference paper = make_reference(gkdv_case(0.5, 0.001, 0.4), times, {.kind = ReferenceKind::seavf});
  EXPECT_GT(paper.error, 0);
  EXPECT_LT(paper.error, 1e-12);  // distance from Fehlberg 7(8)
}

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

}  // namespace TEST_FILE
}  // namespace seiche
