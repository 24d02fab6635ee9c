// Ensembles: every member runs as it would alone, whatever its neighbours do.
#include <test/support/cases.hpp>
#include <test/support/error_of.hpp>
#include <test/support/members.hpp>
#include <test/support/worst.hpp>
#include <test/support/written_problem.hpp>

#include <seiche/core/base/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/ensemble/ensemble.hpp>
#include <seiche/ensemble/panel_block.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/loop/integrate.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/variable_wave.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace seiche::test {
namespace TEST_FILE {

using testing::ContainsRegex;
using testing::HasSubstr;

std::vector<EnsembleMember> scaled_members(const Problem& problem, std::size_t count) {
  const auto shared = std::make_shared<const Problem>(problem);
  std::vector<EnsembleMember> members;
  for (std::size_t m = 0; m < count; ++m)
    members.push_back({shared, (1 - 0.07 * static_cast<double>(m)) * problem.initial});
  return members;
}

std::unique_ptr<Simulation> alone(const EnsembleMember& member, const SimulationOptions& options) {
  Problem problem = *member.problem;
  problem.initial = member.initial;
  return std::make_unique<Simulation>(problem, options);
}

struct Compared {
  double difference = 0.0;  // of states and energies, relative to 1 + |z|
  std::int64_t fallbacks = 0;
  bool same_counts = true;
};

Compared compare(std::span<const EnsembleMember> members, const SimulationOptions& options, double h, int steps) {
  const std::unique_ptr<MemberBlock> block = make_block(members, options);
  std::vector<std::int64_t> fallbacks(members.size(), 0);
  std::vector<std::unique_ptr<Simulation>> ordinary;
  for (const EnsembleMember& member : members) ordinary.push_back(alone(member, options));
  for (int n = 1; n <= steps; ++n) {
    block->step(n, (n - 1) * h, h, n * h);
    for (std::size_t m = 0; m < members.size(); ++m) {
      State& s = ordinary[m]->state();
      s.t = (n - 1) * h;
      const StepReport report = ordinary[m]->step(h);
      EXPECT_TRUE(report.solved()) << report.message;
      fallbacks[m] += report.fallbacks;
    }
  }
  Compared compared;
  std::array<EnergyReading, panel_members> readings;
  block->read(readings);
  for (std::size_t m = 0; m < members.size(); ++m) {
    const auto member = static_cast<Index>(m);
    EXPECT_TRUE(block->status(member).running) << block->status(member).message;
    const Vector z = ordinary[m]->physical();
    const EnergyReading energy = ordinary[m]->energy();
    const double scale = 1 + largest(z);
    for (const double difference :
         {largest(block->physical(member) - z) / scale, std::abs(readings[m].H - energy.H) / (1 + std::abs(energy.H)),
          std::abs(readings[m].modified - energy.modified) / (1 + std::abs(energy.H)),
          std::abs(readings[m].round_off - energy.round_off) / (1 + std::abs(energy.H))})
      compared.difference = worse(compared.difference, difference);
    compared.same_counts = compared.same_counts && fallbacks[m] == block->status(member).fallbacks;
    compared.fallbacks += fallbacks[m];
  }
  return compared;
}

TEST(Ensemble, EveryMemberRunsAsItWouldAloneByEveryMethodOnEveryProblem) {
  for (const auto& [name, problem] : all_cases()) {
    const std::vector<EnsembleMember> members = scaled_members(problem, 3);
    for (const MethodEntry& method : methods()) {
      if (!applies(method.name, problem)) continue;
      const Compared compared = compare(members, {.method = std::string(method.name)}, 1.0 / 64, 24);
      EXPECT_LE(compared.difference, 1e-12) << name << " " << method.name;
      EXPECT_TRUE(compared.same_counts) << name << " " << method.name;
    }
  }
}

bool side_by_side(const Problem& problem, const std::string& method) {
  const std::vector<EnsembleMember> members = scaled_members(problem, 2);
  return dynamic_cast<const PanelBlock*>(make_block(members, {.method = method}).get()) != nullptr;
}

TEST(Ensemble, TheSavAndAvfFamiliesStepSideBySide) {
  for (const Problem& problem : {klein_gordon_case(), fpu_dissipative_case(), gkdv_case(), duffing_case()}) {
    for (const MethodEntry& method : methods()) {
      if (!applies(method.name, problem)) continue;
      const bool written = method.kind.members != MembersTogether::none;
      EXPECT_EQ(side_by_side(problem, std::string(method.name)), written) << problem.name << " " << method.name;
    }
  }
  EXPECT_FALSE(side_by_side(klein_gordon({.grid = {.points = {200}, .length = {20.0}}}), "seisav"));
}

std::vector<EnsembleMember> waves_of_many_kinds(std::size_t count, double alpha) {
  std::vector<EnsembleMember> members;
  for (std::size_t m = 0; m < count; ++m) {
    const auto i = static_cast<double>(m);
    auto problem = std::make_shared<const Problem>(klein_gordon({.kappa = 0.04 + 0.003 * i,
                                                                 .omega_squared = 0.2 + 0.01 * i,
                                                                 .alpha = alpha * (1 + 0.05 * i),
                                                                 .gamma = constant_rate(0.1 + 0.01 * i)}));
    members.push_back({problem, problem->initial});
  }
  return members;
}

TEST(Ensemble, MembersMayDifferInEveryParameter) {
  for (const char* method : {"seisav", "ssav", "eisav", "sav", "seavf", "avf"})
    EXPECT_LE(compare(waves_of_many_kinds(16, 1.0), {.method = method}, 1.0 / 64, 100).difference, 1e-12) << method;
}

// Amplitudes at which V falls far below zero: the guard lifts C, in the same steps.
TEST(Ensemble, TheGuardOfCActsMemberByMember) {
  std::vector<EnsembleMember> members = scaled_members(klein_gordon_case(0.1, -1.0), 8);
  for (std::size_t m = 0; m < members.size(); ++m) members[m].initial *= 2 + 0.5 * static_cast<double>(m);
  const Compared compared = compare(members, {.method = "seisav"}, 1.0 / 64, 72);
  EXPECT_LE(compared.difference, 1e-12);
  EXPECT_TRUE(compared.same_counts);
  EXPECT_GT(compared.fallbacks, 0);
}

// Steps so long that the fixed point does not contract in some members: the ordinary stepper takes those.
TEST(Ensemble, MembersThatDoNotContractFallBackToTheOrdinaryStepper) {
  std::vector<EnsembleMember> members = scaled_members(klein_gordon_case(0.1, 1.0), 6);
  for (std::size_t m = 0; m < members.size(); ++m) members[m].initial *= 1 + 3 * static_cast<double>(m);
  const Compared compared = compare(members, {.method = "seavf"}, 0.5, 6);
  EXPECT_LE(compared.difference, 1e-9);  // Newton's iteration ends within its tolerance, not at one number
  EXPECT_TRUE(compared.same_counts);
  EXPECT_GT(compared.fallbacks, 0);
}

EnsembleResult run(std::span<const EnsembleMember> members, const std::string& method, double h, double t_end,
                   int threads = 1, std::vector<EnsembleRecord>* records = nullptr) {
  EnsembleOptions options{
      .simulation = {.method = method}, .h = h, .t_end = t_end, .energy_every = 5, .threads = threads};
  options.promise = [](const Simulation&) { return LawPromise{true, "asked for"}; };
  if (records != nullptr) options.on_record = [records](const EnsembleRecord& r) { records->push_back(r); };
  return run_ensemble(members, options);
}

// A given C and a frozen r: focusing waves that are too large cannot start, or fall below −C on their way.
TEST(Ensemble, AMemberThatFailsStopsWithTheMessageOfItsOwnRunAndTheOthersGoOn) {
  const SimulationOptions options{.method = "seisav", .method_options = {.C = 1.0, .auxiliary = AuxiliaryMode::frozen}};
  std::vector<EnsembleMember> members = scaled_members(klein_gordon_case(0.1, -1.0), 20);
  for (std::size_t m = 0; m < members.size(); ++m)
    members[m].initial = (1 + 0.1 * static_cast<double>(m)) * members[0].problem->initial;
  std::vector<EnsembleRecord> records;
  const EnsembleResult result =
      run_ensemble(members, {.simulation = options, .h = 0.1, .t_end = 10.0, .on_record = [&](const EnsembleRecord& r) {
                               records.push_back(r);
                             }});
  int not_started = 0;
  int stopped = 0;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const RunReport& report = result.members[m].report;
    std::unique_ptr<Simulation> ordinary;
    try {
      ordinary = alone(members[m], options);
    } catch (const Error& error) {
      EXPECT_EQ(report.status, RunReport::Status::failed);
      EXPECT_EQ(report.message, error.what());
      EXPECT_EQ(result.members[m].final.size(), 0);
      EXPECT_EQ(report.law, LawVerdict::not_promised);
      ++not_started;
      continue;
    }
    const RunReport expected =
        integrate(ordinary->system(), ordinary->stepper(), ordinary->state(), {.h = 0.1, .t_end = 10.0});
    EXPECT_EQ(report.status, expected.status) << m;
    EXPECT_EQ(report.steps, expected.steps) << m;
    EXPECT_LE((result.members[m].final - ordinary->physical()).norm(), 1e-11 * (1 + ordinary->physical().norm())) << m;
    if (report.status != RunReport::Status::failed) continue;
    EXPECT_EQ(expected.message.substr(0, report.message.size()), report.message);
    ++stopped;
  }
  EXPECT_GT(not_started, 0);
  EXPECT_GT(stopped, 0);
  EXPECT_LT(not_started + stopped, 20);
  EXPECT_EQ(records.front().running, 20 - not_started);
  EXPECT_EQ(records.back().running, 20 - not_started - stopped);
}

TEST(Ensemble, AMemberThatFailsSaysWhereVIsNotDefined) {
  const Problem problem = make_problem(read(R"toml(fields = ["q", "p"]
H = "p^2/2 + q^2/2 - 0.3*log(1 + q)"
initial = { q = "0.5", p = "-6" })toml"));
  for (const std::string method : {"seisav", "seavf"}) {  // side by side, and one after the other
    std::vector<EnsembleMember> members = scaled_members(problem, 3);
    members[1].initial[1] = 0.1;
    const EnsembleResult result = run_ensemble(members, {.simulation = {.method = method}, .h = 1.0, .t_end = 5});
    EXPECT_EQ(result.members[1].report.status, RunReport::Status::success) << result.members[1].report.message;
    for (const std::size_t m : {0U, 2U})
      EXPECT_THAT(result.members[m].report.message,
                  ContainsRegex("; V is not a finite number at q = -[1-9]"))  // ahead of the state, or where it is
          << method;
  }
}

// Lanczos iteration is no fixed matrix: what it makes of z depends on z and on the force beside it.
TEST(Ensemble, MembersByLanczosRunAsTheyWouldAloneAtAnyDimension) {
  const Problem p = variable_wave({.grid = {.points = {30}, .length = {2.0}, .boundary = {Boundary::dirichlet}},
                                   .mass = 0.5,
                                   .alpha = 1.0,
                                   .gamma = constant_rate(0.1)});
  for (const int dimension : {0, 2, 4}) {
    const SimulationOptions options{.method = "seisav",
                                    .backend = "sparse",
                                    .backend_options = {.sparse = {.exponential = ExponentialKind::lanczos,
                                                                   .lanczos_dimension = dimension}}};
    EXPECT_LE(compare(scaled_members(p, 3), options, 0.1, 5).difference, 1e-12) << dimension;
  }
}

TEST(Ensemble, AMemberWithoutAPropagatorLeavesTheOthersRunning) {
  const std::vector<EnsembleMember> members = one_without_a_propagator();
  const SimulationOptions options{.method = "sav", .backend = "sparse"};
  const EnsembleResult result = run_ensemble(members, {.simulation = options, .h = 0.5, .t_end = 2.0});
  for (const std::size_t m : {0U, 2U}) {
    EXPECT_EQ(result.members[m].report.status, RunReport::Status::success) << result.members[m].report.message;
    const std::unique_ptr<Simulation> ordinary = alone(members[m], options);
    for (int n = 0; n < 4; ++n) ASSERT_TRUE(ordinary->step(0.5).solved());
    EXPECT_LE(largest(result.members[m].final - ordinary->physical()), 1e-13);
  }
  EXPECT_EQ(result.members[1].report.status, RunReport::Status::failed);
  EXPECT_NE(result.members[1].report.message.find("cannot be factorised"), std::string::npos)
      << result.members[1].report.message;
  EXPECT_EQ(result.members[1].report.steps, 0);
}

TEST(Ensemble, StartsAtTheTimeAskedForAsEachMemberAlone) {
  Problem problem = klein_gordon_case();
  problem.damping.rate = formula_rate(compile_formula("0.5 + 0.4*sin(3*t)", {"t"}));
  const std::vector<EnsembleMember> members = scaled_members(problem, 3);
  const SimulationOptions simulation{.method = "seisav"};
  const EnsembleResult result =
      run_ensemble(members, {.simulation = simulation, .h = 0.125, .t_start = 1.0, .t_end = 2.0});
  for (std::size_t m = 0; m < members.size(); ++m) {
    const std::unique_ptr<Simulation> one = alone(members[m], simulation);
    one->state().t = 1.0;
    integrate(one->system(), one->stepper(), one->state(), {.h = 0.125, .t_end = 2.0});
    EXPECT_EQ(result.members[m].report.t, 2.0);
    EXPECT_EQ(result.members[m].report.steps, 8);
    EXPECT_LT(largest(result.members[m].final - one->physical()), 1e-13) << m;
  }
}

TEST(Ensemble, RefusesToRunWhereNoMemberCanStart) {
  std::vector<EnsembleMember> members = scaled_members(klein_gordon_case(), 2);
  EnsembleOptions options{.simulation = {.method = "seisav", .method_options = {.C = -1.0}}, .h = 0.1, .t_end = 1.0};
  EXPECT_THROW(run_ensemble(members, options), Error);
  options.simulation = {.method = "seisv"};
  EXPECT_THROW(run_ensemble(members, options), Error);
  EXPECT_THROW(run_ensemble({}, {.h = 0.1, .t_end = 1.0}), Error);
}

TEST(Ensemble, MembersOfDifferentSizesAreRefusedWithBoth) {
  std::vector<EnsembleMember> members = scaled_members(klein_gordon_case(), 2);
  const Problem small = duffing_case();
  const auto other = std::make_shared<const Problem>(small);
  const std::string two = std::to_string(small.size()), many = std::to_string(members[0].problem->size());
  members.push_back({other, other->initial});
  const EnsembleOptions options{.simulation = {.method = "seisav"}, .h = 0.1, .t_end = 1.0};
  EXPECT_THAT(test::error_of([&] { run_ensemble(members, options); }),
              HasSubstr("member 3 has " + two + " unknowns and member 1 has " + many));
  members[2] = {members[0].problem, other->initial};
  EXPECT_THAT(test::error_of([&] { run_ensemble(members, options); }),
              HasSubstr("the initial state of member 3 has " + two));
}

TEST(Ensemble, StopsBetweenRecordsThatLieFarApartAndRecordsWhere) {
  const std::vector<EnsembleMember> members = scaled_members(klein_gordon_case(), 20);
  std::vector<EnsembleRecord> records;
  std::atomic<bool> stop = false;
  int pauses = 0;
  const EnsembleResult result =
      run_ensemble(members, {.simulation = {.method = "seisav"},
                             .h = 1.0 / 64,
                             .t_end = 1e8,
                             .energy_every = 1000000000,
                             .on_record = [&](const EnsembleRecord& record) { records.push_back(record); },
                             .on_pause = [&] { stop = ++pauses == 3; },
                             .stop = &stop});
  ASSERT_EQ(records.size(), 2U) << "the first and the last state";
  for (const MemberResult& member : result.members) {
    EXPECT_EQ(member.report.status, RunReport::Status::interrupted);
    EXPECT_EQ(member.report.t, records[1].t);
    EXPECT_GT(member.report.t, 0);
  }
  ASSERT_TRUE(stop);
  EXPECT_THAT(test::error_of([&] {
                run_ensemble(members, {.simulation = {.method = "seisav"}, .h = 0.1, .t_end = 1.0, .stop = &stop});
              }),
              HasSubstr("stopped before"));
}

TEST(Ensemble, EndsWithTheErrorOfARecordThatFails) {
  const std::vector<EnsembleMember> members = scaled_members(klein_gordon_case(), 3);
  int records = 0;
  const EnsembleResult result =
      run_ensemble(members, {.simulation = {.method = "seisav"}, .h = 0.1, .t_end = 1.0, .on_record = [&](const auto&) {
                               if (++records == 4) throw Error("the disk is full");
                             }});
  EXPECT_EQ(result.failure, "the disk is full");
  EXPECT_EQ(records, 4);
  for (const MemberResult& member : result.members) EXPECT_GT(member.final.size(), 0);
}

bool are_same(const Statistics& a, const Statistics& b) {
  return a.mean == b.mean && a.standard_deviation == b.standard_deviation && a.minimum == b.minimum && a.low == b.low &&
         a.median == b.median && a.high == b.high && a.maximum == b.maximum;
}

TEST(Ensemble, ResultsDoNotDependOnTheNumberOfThreads) {
  const std::vector<EnsembleMember> members = waves_of_many_kinds(70, 1.0);
  for (const char* method : {"seisav", "seavf", "seilm"}) {
    std::vector<EnsembleRecord> one, three;
    const EnsembleResult a = run(members, method, 1.0 / 32, 1.0, 1, &one);
    const EnsembleResult b = run(members, method, 1.0 / 32, 1.0, 3, &three);
    for (std::size_t m = 0; m < members.size(); ++m) EXPECT_EQ(a.members[m].final, b.members[m].final) << method << m;
    ASSERT_EQ(one.size(), three.size());
    for (std::size_t r = 0; r < one.size(); ++r) {
      EXPECT_TRUE(are_same(one[r].H, three[r].H)) << method << r;
      EXPECT_TRUE(are_same(one[r].modified, three[r].modified)) << method << r;
    }
  }
}

TEST(Ensemble, RecordsTheEnergiesOfItsMembersAndJudgesTheirLaws) {
  const std::vector<EnsembleMember> members = waves_of_many_kinds(18, 1.0);
  std::vector<EnsembleRecord> records;
  const EnsembleResult result = run(members, "seisav", 0.15, 1.0, 1, &records);  // 0.15 does not divide 1
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[1].t, 0.75);
  EXPECT_EQ(records[2].t, 1.0);
  std::vector<double> last;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const std::unique_ptr<Simulation> ordinary = alone(members[m], {.method = "seisav"});
    const RunReport expected =
        integrate(ordinary->system(), ordinary->stepper(), ordinary->state(), {.h = 0.15, .t_end = 1.0});
    EXPECT_LE(largest(result.members[m].final - ordinary->physical()), 1e-13);
    EXPECT_EQ(result.members[m].report.steps, expected.steps);
    EXPECT_EQ(result.members[m].report.t, 1.0);
    EXPECT_EQ(result.members[m].report.law, LawVerdict::holds);
    EXPECT_NEAR(result.members[m].report.energy.final, ordinary->energy().H, 1e-13);
    EXPECT_LT(result.members[m].report.modified.max_increase, 0);
    last.push_back(ordinary->energy().H);
  }
  const double mean = std::accumulate(last.begin(), last.end(), 0.0) / 18;
  EXPECT_NEAR(records[2].H.mean, mean, 1e-13);
  EXPECT_NEAR(records[2].H.minimum, *std::min_element(last.begin(), last.end()), 1e-13);
  EXPECT_NEAR(records[2].H.maximum, *std::max_element(last.begin(), last.end()), 1e-13);
}

}  // namespace TEST_FILE
}  // namespace seiche::test
