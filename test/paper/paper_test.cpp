// The studies of the paper, end to end.
#include <paper/multiplier_trace.hpp>
#include <paper/paper.hpp>
#include <paper/verdicts.hpp>
#include <seiche/study/converge.hpp>
#include <test/support/cases.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <set>

namespace seiche {
namespace TEST_FILE {

using test::gkdv_case;

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
  const auto stop_at_the_second = [&](double done, std::string_view) { stop = done > 0.45; };  // of the times
  const PaperResults one = run_paper({.quick = true, .progress = stop_at_the_second, .stop = &stop});
  EXPECT_EQ(one.examples.size(), 1U);
  EXPECT_TRUE(one.verdicts.empty());
}

}  // namespace TEST_FILE
}  // namespace seiche
