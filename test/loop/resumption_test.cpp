// A run goes on from a checkpoint to the same bits, whatever it is.
#include <test/support/cases.hpp>
#include <test/support/repetitions.hpp>

#include <seiche/loop/adaptive.hpp>
#include <seiche/simulation/simulation.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

class Energies : public Observer {
 public:
  bool is_due(const State&, bool) const override { return true; }
  void observe(const State& state, const EnergyReading& energy) override {
    while (next_time() <= state.t) ++shown;
    rows.insert(rows.end(), {state.t, energy.H, energy.modified, energy.ledger.sum()});
    stop = rows.size() > most;
  }
  double next_time() const override { return 0.1 * static_cast<double>(1 + shown); }
  void finish(const RunReport&) override {}
  std::vector<double> rows;
  std::int64_t shown = 0;     // multiples of 0.1
  std::size_t most = 10'000;  // numbers in rows: no run here is as long, unless its checkpoint says so
  std::atomic<bool> stop = false;
};

// One checkpoint, after n steps, and on.
class AfterSteps : public Checkpoints {
 public:
  explicit AfterSteps(std::int64_t n) : n_(n) {}
  void save(std::int64_t, double, FunctionRef<void(Archive&)> run) override {
    bytes.emplace();
    Archive archive([this](std::string_view piece) { *bytes += piece; });
    run(archive);
    shown = energies->shown;
  }
  std::optional<std::string> bytes;
  const Energies* energies = nullptr;
  std::int64_t shown = 0;

 private:
  Wish look(std::int64_t n) override {
    look_again_at(n + 1);
    return n >= n_ && !bytes ? Wish::save : Wish::none;
  }
  std::int64_t n_;
};

struct Kind {
  std::string method, backend;
  std::optional<double> tolerance;
  bool ledger = false;
  int threads = 1;
  std::size_t most_numbers = 10'000;  // in rows
};

struct Outcome {
  Vector z;
  RunReport report;
  std::vector<double> rows;
};

// A whole run, with a keeper; or one from a checkpoint, with what its observer had shown by then.
Outcome run(const Problem& problem, const Kind& kind, AfterSteps* keeper, Archive* from = nullptr,
            std::int64_t shown = 0, const std::string& objection = "") {
  Simulation simulation(problem, {.method = kind.method,
                                  .backend = kind.backend,
                                  .backend_options = {.threads = kind.threads},
                                  .variable_steps = kind.tolerance.has_value(),
                                  .tolerance = kind.tolerance.value_or(0.0)});
  if (kind.ledger) simulation.stepper().keep_ledger();
  Energies energies;
  energies.shown = shown;
  energies.most = kind.most_numbers;
  if (keeper != nullptr) keeper->energies = &energies;
  Observer* const observers[] = {&energies};
  AdaptiveStepper* const adaptive = kind.tolerance ? &simulation.adaptive_stepper() : nullptr;
  Outcome outcome;
  outcome.report = integrate_either(simulation.system(), simulation.stepper(), adaptive, simulation.state(),
                                    {.tolerance = kind.tolerance.value_or(0.0),
                                     .t_end = 0.35,
                                     .first_h = kind.tolerance ? 0.0 : 1.0 / 64,
                                     .law = promise_energy_law(simulation, 0.35),
                                     .objection = [&] { return objection; },
                                     .stop = &energies.stop,
                                     .resumption = {.checkpoints = keeper, .from = from}},
                                    observers);
  outcome.z = simulation.state().z;
  outcome.rows = energies.rows;
  return outcome;
}

// The rows of a run that goes on are the last ones of the whole run, bit for bit, and so is all else.
void expect_same_run(const Problem& problem, const Kind& kind, std::int64_t n, const std::string& name,
                     int threads_behind = 1) {
  AfterSteps keeper(n);
  const Outcome whole = run(problem, kind, &keeper);
  ASSERT_TRUE(keeper.bytes) << name << ": " << whole.report.message;
  Archive archive(*keeper.bytes);
  Kind behind_checkpoint = kind;
  behind_checkpoint.threads = threads_behind;
  const Outcome rest = run(problem, behind_checkpoint, nullptr, &archive, keeper.shown);
  EXPECT_TRUE(archive.is_at_end()) << name;
  EXPECT_EQ(rest.z, whole.z) << name;
  ASSERT_LT(rest.rows.size(), whole.rows.size()) << name;
  const auto behind = whole.rows.end() - static_cast<std::ptrdiff_t>(rest.rows.size());
  EXPECT_EQ(rest.rows, std::vector<double>(behind, whole.rows.end())) << name;
  EXPECT_EQ(rest.report.message, whole.report.message) << name;
  EXPECT_EQ(rest.report.steps, whole.report.steps) << name;
  EXPECT_EQ(rest.report.energy.initial, whole.report.energy.initial) << name;
  EXPECT_EQ(rest.report.energy.max_increase, whole.report.energy.max_increase) << name;
  EXPECT_EQ(rest.report.modified.max_increase, whole.report.modified.max_increase) << name;
  EXPECT_EQ(rest.report.scalar_iterations, whole.report.scalar_iterations) << name;
  EXPECT_EQ(rest.report.replaced.count, whole.report.replaced.count) << name;
  EXPECT_EQ(rest.report.law, whole.report.law) << name;
  EXPECT_EQ(rest.report.potential_counts.gradients, whole.report.potential_counts.gradients) << name;
}

class ResumptionOf : public testing::TestWithParam<std::string> {};

// Each problem on one of its backends, in turn, so that every backend meets every kind of problem.
TEST_P(ResumptionOf, GoesOnToTheSameBitsOnEveryBackend) {
  std::size_t turn = 0;
  std::set<std::string> met;
  for (const auto& [name, problem] : all_cases()) {
    if (!applies(GetParam(), problem)) continue;
    const std::vector<BackendEntry> backends = quick_backends_for(problem);
    const std::string backend(backends[turn++ % backends.size()].name);
    met.insert(backend);
    const auto n = static_cast<std::int64_t>(turn * 7 % 19);  // after the first steps, in the middle, near the end
    const Kind kind{.method = GetParam(), .backend = backend, .tolerance = {}, .ledger = n % 5 == 0};
    expect_same_run(problem, kind, n, fmt::format("{} {} after step {}", name, backend, n));
  }
  EXPECT_EQ(met.size(), 3U);
}

TEST_P(ResumptionOf, GoesOnToTheSameBitsWithVariableSteps) {
  std::int64_t n = 0;
  for (const auto& [name, problem] : sanitized ? golden_cases() : all_cases()) {
    if (!applies(GetParam(), problem)) continue;
    n = (n + 1) % 3;
    const Kind kind{.method = GetParam(), .backend = "auto", .tolerance = 1e-3};
    expect_same_run(problem, kind, n, name + " after step " + std::to_string(n));
  }
}

// As a failed run goes back to the last record.
TEST_P(ResumptionOf, GoesOnFromARecordWithoutWhatCameBeforeAndAfterIt) {
  constexpr double h = 1.0 / 256;
  for (const auto& [name, problem] : golden_cases()) {
    if (!applies(GetParam(), problem)) continue;
    Simulation simulation(problem, {.method = GetParam()});
    State& state = simulation.state();
    const auto take = [&](int steps) {
      for (int i = 0; i < steps; ++i) EXPECT_TRUE(simulation.stepper().step(state, h).solved()) << state.t;
    };
    State record;
    take(4);
    const State before = state;
    record.start_from(state);
    EXPECT_EQ(record.z, state.z) << name;
    EXPECT_EQ(state.history, before.history) << name;
    EXPECT_EQ(state.history_h, before.history_h) << name;
    EXPECT_EQ(state.midpoints.gradients, before.midpoints.gradients) << name;
    EXPECT_EQ(state.midpoints.known, before.midpoints.known) << name;
    EXPECT_TRUE(record.history.empty() && record.midpoints.gradients.empty()) << name;
    take(4);
    const Vector without_return = state.z;
    state.start_from(record);
    EXPECT_EQ(state.z, record.z) << name;
    EXPECT_EQ(state.n, 4) << name;
    EXPECT_EQ(state.t, before.t) << name;
    EXPECT_EQ(state.history.size(), before.history.size()) << name;
    EXPECT_EQ(state.midpoints.gradients.size(), before.midpoints.gradients.size()) << name;
    EXPECT_TRUE(state.history_h == 0 && state.midpoints.known == 0) << name;
    take(4);
    EXPECT_LE((state.z - without_return).lpNorm<Eigen::Infinity>(), 1e-4 * without_return.lpNorm<Eigen::Infinity>())
        << name;
  }
}

// Every method on every backend, fixed steps and a tolerance, one thread and two, after five numbers of steps.
class ResumptionOfSlow : public testing::TestWithParam<std::string> {};

TEST_P(ResumptionOfSlow, GoesOnToTheSameBitsFromAnywhereOnAnyNumberOfThreads) {
  int resumed = 0;
  for (const auto& [name, problem] : {golden_cases().front(), grid_cases().front()}) {
    if (!applies(GetParam(), problem)) continue;
    for (const BackendEntry& backend : quick_backends_for(problem)) {
      for (const std::optional<double> tolerance : {std::optional<double>(), std::optional(1e-3)}) {
        for (const int threads : {1, 2}) {
          for (const std::int64_t n :
               tolerance ? std::vector<std::int64_t>{0, 1, 2} : std::vector<std::int64_t>{0, 1, 2, 7, 19}) {
            const Kind kind{.method = GetParam(),
                            .backend = std::string(backend.name),
                            .tolerance = tolerance,
                            .threads = threads};
            expect_same_run(problem, kind, n, fmt::format("{} {} after step {}", name, backend.name, n), 3 - threads);
            ++resumed;
          }
        }
      }
    }
  }
  RecordProperty("resumed", resumed);
  EXPECT_GE(resumed, 60);
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, ResumptionOfSlow, testing::ValuesIn(method_names()),
                         [](const auto& of) { return of.param; });

INSTANTIATE_TEST_SUITE_P(EveryMethod, ResumptionOf, testing::ValuesIn(method_names()),
                         [](const auto& of) { return of.param; });

// The rate is negative before the checkpoint alone: the promise of the run that goes on is withdrawn all the same.
TEST(Resumption, KeepsWhatARunHasMetBefore) {
  const Problem problem = klein_gordon_case();
  const Kind kind{.method = "seisav", .backend = "dense", .tolerance = {}};
  AfterSteps keeper(3);
  run(problem, kind, &keeper, nullptr, 0, "the rate is negative at t = 0.01");
  Archive archive(*keeper.bytes);
  const Outcome rest = run(problem, kind, nullptr, &archive);
  EXPECT_EQ(rest.report.law, LawVerdict::not_promised);
  EXPECT_EQ(rest.report.law_reason, "the rate is negative at t = 0.01");
}

TEST(Resumption, RefusesBytesThatAreNoCheckpoint) {
  const Problem problem = klein_gordon_case();
  const Kind fixed{.method = "seisav", .backend = "dense", .tolerance = {}};
  AfterSteps keeper(3);
  run(problem, fixed, &keeper);
  const std::string bytes = *keeper.bytes;
  for (const std::size_t length : {std::size_t{0}, std::size_t{7}, bytes.size() / 2, bytes.size() - 1}) {
    Archive archive(bytes.substr(0, length));
    const Outcome outcome = run(problem, fixed, nullptr, &archive);
    EXPECT_EQ(outcome.report.status, RunReport::Status::failed) << length;
    EXPECT_NE(outcome.report.message.find("damaged"), std::string::npos) << outcome.report.message;
  }
  Archive of_other_steps(bytes);
  const Outcome outcome =
      run(problem, {.method = "seisav", .backend = "dense", .tolerance = 1e-3}, nullptr, &of_other_steps);
  EXPECT_EQ(outcome.report.status, RunReport::Status::failed);
}

// Whole and with a checksum that fits, but not what a run writes: by hand, or of another problem.
TEST(Resumption, RefusesACheckpointOfAnotherProblem) {
  for (const std::string method : {"seisav", "egc4"}) {
    const Kind kind{.method = method, .backend = "dense", .tolerance = {}};
    AfterSteps keeper(3);
    run(klein_gordon_case(), kind, &keeper);
    Archive archive(*keeper.bytes);
    const Outcome outcome = run(duffing_case(), kind, nullptr, &archive);
    EXPECT_EQ(outcome.report.status, RunReport::Status::failed);
    EXPECT_NE(outcome.report.message.find("damaged"), std::string::npos) << outcome.report.message;
  }
}

// −1 and NaN, wherever a number, a size or a truth may stand.
TEST(Resumption, SurvivesAnyEightBytesOfACheckpoint) {
  const Problem problem = duffing_case();
  for (Kind kind : {Kind{.method = "seisav", .backend = "dense", .tolerance = {}},
                    Kind{.method = "egc4", .backend = "dense", .tolerance = {}, .ledger = true},
                    Kind{.method = "egc4", .backend = "dense", .tolerance = 1e-6}}) {
    kind.most_numbers = 800;
    AfterSteps keeper(3);
    run(problem, kind, &keeper);
    ASSERT_TRUE(keeper.bytes);
    int refused = 0;
    for (std::size_t at = 0; at + 8 <= keeper.bytes->size(); at += 5) {
      std::string bytes = *keeper.bytes;
      bytes.replace(at, 8, 8, '\xff');
      Archive archive(bytes);
      const Outcome outcome = run(problem, kind, nullptr, &archive, keeper.shown);
      refused += outcome.report.status == RunReport::Status::failed ? 1 : 0;
    }
    EXPECT_GT(refused, 20) << kind.method;
  }
}

}  // namespace TEST_FILE
}  // namespace seiche::test
