// An ensemble that goes on from what was saved of it ends with the same bits.
#include <test/support/cases.hpp>
#include <test/support/error_of.hpp>
#include <test/support/members.hpp>

#include <seiche/ensemble/ensemble.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

// Keeps all that is saved, whenever the run asks.
class Keeper : public Checkpoints {
 public:
  std::vector<std::string> saved;
  std::vector<std::int64_t> steps;
  std::vector<double> times;
  std::vector<std::size_t> records_before;
  const std::vector<EnsembleRecord>* records = nullptr;

  std::size_t most = 1000;

  void save(std::int64_t n, double t, FunctionRef<void(Archive&)> run) override {
    if (saved.size() == most) throw Error("the disk is full");
    std::string bytes;
    Archive archive([&bytes](std::string_view piece) { bytes += piece; });
    run(archive);
    saved.push_back(std::move(bytes));
    steps.push_back(n);
    times.push_back(t);
    records_before.push_back(records->size());
  }

 private:
  Wish look(std::int64_t) override { return Wish::save; }
};

struct AnEnsemble {
  std::string name;
  std::vector<EnsembleMember> members;
  EnsembleOptions options;
};

std::vector<EnsembleMember> larger_and_larger(const Problem& problem, std::size_t count) {
  const auto shared = std::make_shared<const Problem>(problem);
  std::vector<EnsembleMember> members;
  for (std::size_t m = 0; m < count; ++m)
    members.push_back({shared, (1 + 0.1 * static_cast<double>(m)) * problem.initial});
  return members;
}

std::vector<AnEnsemble> ensembles() {
  const Problem wave = klein_gordon_case(0.1, -1.0);
  std::vector<AnEnsemble> all;
  // Side by side, and one after the other; of twenty some never start, and some fail on their way.
  for (const std::string method : {"seisav", "seavf", "savf", "egc4", "seilm"})
    all.push_back({method,
                   larger_and_larger(klein_gordon_case(), 20),
                   {.simulation = {.method = method}, .h = 1.0 / 16, .t_end = 4.01, .energy_every = 3}});
  all.push_back({"failing",
                 larger_and_larger(wave, 20),
                 {.simulation = {.method = "seisav", .method_options = {.C = 1.0, .auxiliary = AuxiliaryMode::frozen}},
                  .h = 0.1,
                  .t_end = 10.0}});
  all.push_back({"by gradient",
                 larger_and_larger(klein_gordon_case(), 5),
                 {.simulation = {.method = "seisav"}, .h = 1.0 / 16, .t_end = 4.0}});
  all.back().options.simulation.method_options.predictor = Predictor::gradient;
  all.push_back({"without a propagator",
                 one_without_a_propagator(),
                 {.simulation = {.method = "sav", .backend = "sparse"}, .h = 0.5, .t_end = 8.0}});
  return all;
}

EnsembleResult run(const AnEnsemble& ensemble, Resumption resumption, int threads,
                   std::vector<EnsembleRecord>& records) {
  EnsembleOptions options = ensemble.options;
  options.resumption = resumption;
  options.threads = threads;
  options.promise = [](const Simulation&) { return LawPromise{true, "for the test"}; };
  options.on_record = [&records](const EnsembleRecord& record) { records.push_back(record); };
  return run_ensemble(ensemble.members, options);
}

void expect_same(const EnsembleResult& one, const EnsembleResult& other, const std::string& where) {
  ASSERT_EQ(one.members.size(), other.members.size()) << where;
  for (std::size_t m = 0; m < one.members.size(); ++m) {
    const RunReport &a = one.members[m].report, &b = other.members[m].report;
    EXPECT_EQ(a.message, b.message) << where << " member " << m;
    EXPECT_EQ(a.status, b.status) << where;
    EXPECT_EQ(a.law, b.law) << where;
    EXPECT_EQ(a.steps, b.steps) << where;
    EXPECT_EQ(a.t, b.t) << where;
    EXPECT_EQ(a.energy.final, b.energy.final) << where;
    EXPECT_EQ(a.energy.max_increase, b.energy.max_increase) << where;
    EXPECT_EQ(a.scalar_iterations, b.scalar_iterations) << where;
    EXPECT_EQ(a.fallbacks, b.fallbacks) << where;
    EXPECT_EQ(a.replaced.count, b.replaced.count) << where;
    const Vector &y = one.members[m].final, &z = other.members[m].final;
    ASSERT_EQ(y.size(), z.size()) << where;
    EXPECT_TRUE(std::equal(y.begin(), y.end(), z.begin())) << where << " member " << m;
  }
}

TEST(EnsembleResume, EndsWithTheBitsOfOneThatWasNeverStopped) {
  for (const AnEnsemble& ensemble : ensembles()) {
    std::vector<EnsembleRecord> records;
    Keeper keeper;
    keeper.records = &records;
    const EnsembleResult whole = run(ensemble, {.checkpoints = &keeper}, 1, records);
    ASSERT_GT(keeper.saved.size(), 4U) << ensemble.name;
    for (std::size_t k = 0; k < keeper.saved.size(); ++k) {
      const std::string where = ensemble.name + " from " + std::to_string(k);
      EXPECT_EQ(keeper.times[k], static_cast<double>(keeper.steps[k]) * ensemble.options.h) << where;
      Archive from(keeper.saved[k]);
      std::vector<EnsembleRecord> rest;
      const EnsembleResult result = run(ensemble, {.from = &from}, 2, rest);
      EXPECT_TRUE(from.is_at_end()) << where;
      expect_same(whole, result, where);
      ASSERT_EQ(keeper.records_before[k] + rest.size(), records.size()) << where;
      for (std::size_t r = 0; r < rest.size(); ++r) {
        const EnsembleRecord& row = records[keeper.records_before[k] + r];
        EXPECT_EQ(rest[r].t, row.t) << where;
        EXPECT_EQ(rest[r].running, row.running) << where;
        EXPECT_EQ(rest[r].H.mean, row.H.mean) << where;
        EXPECT_EQ(rest[r].modified.median, row.modified.median) << where;
      }
    }
  }
}

// Its members are those of the last batch.
TEST(EnsembleResume, EndsWhereItCannotBeSaved) {
  const AnEnsemble ensemble = ensembles().front();
  std::vector<EnsembleRecord> records;
  Keeper keeper;
  keeper.records = &records;
  keeper.most = 3;
  const EnsembleResult ended = run(ensemble, {.checkpoints = &keeper}, 1, records);
  EXPECT_EQ(ended.failure, "the disk is full");
  for (const MemberResult& member : ended.members) {
    EXPECT_EQ(member.report.status, RunReport::Status::interrupted);
    EXPECT_GE(member.report.t, keeper.times.back());
    EXPECT_EQ(member.final.size(), ensemble.members.front().problem->size());
  }
}

TEST(EnsembleResume, RefusesWhatWasSavedOfOtherMembers) {
  const std::vector<AnEnsemble> all = ensembles();
  std::vector<EnsembleRecord> records;
  Keeper keeper;
  keeper.records = &records;
  run(all.front(), {.checkpoints = &keeper}, 1, records);
  AnEnsemble fewer = all.front();
  fewer.members.pop_back();
  Archive from(keeper.saved.back());
  EXPECT_NE(error_of([&] { run(fewer, {.from = &from}, 1, records); }), "");
}

}  // namespace TEST_FILE
}  // namespace seiche::test
