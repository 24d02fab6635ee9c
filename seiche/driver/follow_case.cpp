#include <seiche/config/case/case_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/driver/case_folder.hpp>
#include <seiche/driver/case_run.hpp>
#include <seiche/driver/follow_case.hpp>
#include <seiche/driver/joint_checkpoints.hpp>
#include <seiche/driver/last_words.hpp>
#include <seiche/record/saved_run.hpp>

#include <filesystem>
#include <optional>
#include <span>

namespace seiche {
namespace {

// Due where energy.csv has a row, since energies are a work of all processes.
class EnergyTimes final : public Observer {
 public:
  explicit EnergyTimes(Schedule schedule) : schedule_(schedule) {}
  bool is_due(const State& state, bool last) const override { return schedule_.is_due(state.n, last); }
  void observe(const State&, const EnergyReading&) override {}
  void finish(const RunReport&) override {}

 private:
  Schedule schedule_;
};

}  // namespace

CaseResult follow_case(const RunCaseOptions& options) {
  const Ranks& ranks = *options.ranks;
  ranks.on_first([] {});  // looks at times and plans
  const std::filesystem::path folder = ranks.from_first("");
  const std::string checkpoint = ranks.from_first("");
  const std::string text = ranks.from_first("");
  RunSpec spec;
  std::optional<Checkpoint> from;
  ranks.together([&] {
    spec = parse_case(text, "the case", {}, folder);
    if (!checkpoint.empty()) from = read_checkpoint(folder / checkpoint, true);
  });

  const Problem problem = problem_here(spec, options);
  if (!from) settle_snapshots(spec, problem);
  PreparedRun run(problem, run_plan(spec, options));
  ranks.on_first([] {});  // the record of the run is made
  const std::atomic<bool>* const stop = begin_run(options);
  ranks.on_first([] {});  // and its files
  if (spec.ledger) run.simulation().stepper().keep_ledger();

  EnergyTimes energies({.every_steps = spec.energy_every});
  const SolutionFile::Mark* mark = from && from->run.solution ? &*from->run.solution : nullptr;
  SolutionFile solution(problem, *run.simulation().system().space, snapshot_times(spec), mark, ranks);
  AtTheEnd last_state([&](const RunReport&) { join_values(run.simulation(), [](std::span<const double>) {}); });
  std::vector<Observer*> observers = {&energies, &solution, &last_state};
  observers.insert(observers.end(), options.observers.begin(), options.observers.end());
  JointCheckpoints checkpoints(ranks, nullptr, *stop, options.save);
  const RunReport report =
      run.integrate(never_stops(), observers, {.checkpoints = &checkpoints, .from = from ? &from->rest : nullptr});
  return {.report = report,
          .message = report.message,
          .certificate = run.certificate_after(report),
          .feeds = {},
          .summary = {},
          .xdmf_every = 1};
}

}  // namespace seiche
