#include <seiche/core/base/error.hpp>
#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/base/memory_limit.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/simulation/prepared_run.hpp>
#include <seiche/simulation/solution_recorder.hpp>
#include <seiche/simulation/solve.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

namespace seiche {
namespace {

void validate(const Problem& problem, const SolveOptions& o) {
  if (std::isnan(o.t_end)) throw Error("give t_end, the time at which the run is to end");
  if (!std::isfinite(o.t_start) || !std::isfinite(o.t_end) || o.t_end < o.t_start)
    throw Error("t_end = {} must not lie before t_start = {}, and both must be finite", o.t_end, o.t_start);
  if (!o.tolerance && !(o.h > 0)) throw Error("give a step size h > 0 or a tolerance; h is {}", o.h);
  if (o.record_every < 1) throw Error("record_every = {} must be ≥ 1", o.record_every);
  if (o.z0 && o.z0->size() != problem.size())
    throw Error("z0 has {} entries, but the state of {} has {}: {} fields of {}", o.z0->size(), problem.name,
                problem.size(), problem.field_count(), problem.grid.unknowns());
  if (o.z0 && !std::all_of(o.z0->begin(), o.z0->end(), [](double x) { return std::isfinite(x); }))
    throw Error("z0 holds a number that is not finite");
  for (std::size_t i = 0; i < o.events.size(); ++i)
    if (!o.events[i].g) throw Error("event {} has no function", i + 1);
  if (o.ledger && o.t_eval)
    throw Error(
        "the ledger is kept at the ends of steps, and t_eval asks for times inside them: leave out one of the two");
  if (o.ledger && o.tolerance && !o.events.empty())
    throw Error(
        "an event inside a step of variable size leaves the ledger with a step too many: give h instead of a tolerance");
  if (o.noise.is_on() && (!o.events.empty() || o.dense_output || o.t_eval))
    throw Error("with noise a solution is known at the ends of steps alone: leave out events, t_eval and dense_output");
  if (!o.t_eval) return;
  if (!std::is_sorted(o.t_eval->begin(), o.t_eval->end())) throw Error("the times of t_eval must ascend");
  for (const double t : *o.t_eval)
    if (!(t >= o.t_start && t <= o.t_end))
      throw Error("t_eval holds {}, which is outside the run from {} to {}", t, o.t_start, o.t_end);
}

// Of what is recorded; not known with variable steps.
void require_memory(const Problem& problem, const SolveOptions& o) {
  const double steps = o.tolerance ? 0.0 : (o.t_end - o.t_start) / o.h;
  const double recorded =
      o.t_eval ? static_cast<double>(o.t_eval->size()) : steps / static_cast<double>(o.record_every);
  const double bytes =
      (recorded + (o.dense_output ? steps : 0.0)) * static_cast<double>(problem.size() * sizeof(double));
  if (bytes > memory_limit())
    throw Error(
        "the solution would take {:.3g} bytes, but only {:.3g} are available; give t_eval, or a larger record_every{}",
        bytes, memory_limit(), o.dense_output ? ", and no dense_output" : "");
}

RunPlan plan(const SolveOptions& o) {
  return {.simulation = {.method = o.method,
                         .backend = o.backend,
                         .method_options = o.method_options,
                         .backend_options = o.backend_options,
                         .noise = o.noise},
          .h = o.h,
          .tolerance = o.tolerance,
          .h_max = o.h_max,
          .t_start = o.t_start,
          .t_end = o.t_end};
}

Problem with_initial(Problem problem, const std::optional<Vector>& z0) {
  if (z0) problem.initial = *z0;
  return problem;
}

// The events of the options in the coordinates of the state, with their records.
std::vector<Event> physical_events(const SolveOptions& options, const Space& space, Solution& solution) {
  std::vector<Event> events;
  for (std::size_t i = 0; i < options.events.size(); ++i) {
    const SolveEvent& event = options.events[i];
    Solution::Events& record = solution.events[i];
    events.push_back({.g = [&event, &space](double t, const Vector& z) { return event.g(t, space.physical(z)); },
                      .action =
                          [&event, &space, &record, &solution](State& state) {
                            Vector values = space.physical(state.z);
                            record.t.push_back(state.t);
                            record.z.insert(record.z.end(), values.begin(), values.end());
                            if (event.action) {
                              event.action(state.t, values);
                              if (values.size() != space.physical_size())
                                throw Error("the action of an event left {} entries in z, which has {}", values.size(),
                                            space.physical_size());
                              space.from_physical(values, state.z);
                            }
                            const bool ends = event.ends_at > 0 && std::ssize(record.t) >= event.ends_at;
                            solution.ended_by_event |= ends;
                            return !ends;
                          },
                      .direction = event.direction});
  }
  return events;
}

RememberingStepper::Keeps kept(const SolveOptions& options) {
  using Keeps = RememberingStepper::Keeps;
  return options.dense_output ? Keeps::all : options.t_eval ? Keeps::last : Keeps::none;
}

// A checkpoint of the time loop, behind what was recorded so far.
class WithSolution final : public Checkpoints {
 public:
  WithSolution(Checkpoints* keeper, FunctionRef<void(Archive&)> recorded) : keeper_(keeper), recorded_(recorded) {}
  void save(std::int64_t n, double t, FunctionRef<void(Archive&)> run) override {
    keeper_->save(n, t, [&](Archive& a) {
      recorded_(a);
      run(a);
    });
  }

 private:
  Wish look(std::int64_t n) override { return keeper_->wish(n); }

  Checkpoints* keeper_;
  FunctionRef<void(Archive&)> recorded_;
};

class Run {
 public:
  Run(const Problem& problem, const SolveOptions& options)
      : options_(options),
        problem_(with_initial(problem, options.z0)),
        run_(problem_, plan(options)),
        steps_(run_.simulation().stepper(), run_.adaptive(), kept(options)),
        replay_(run_.simulation().stepper(), run_.adaptive()) {
    const Simulation& simulation = run_.simulation();
    solution_.size = problem_.size();
    solution_.events.resize(options.events.size());
    solution_.method = simulation.method().name;
    solution_.backend = simulation.backend().name;
    solution_.method_reason = simulation.reason();
    solution_.notes = run_.notes();
    if (options.ledger) run_.simulation().stepper().keep_ledger();
  }

  Solution solve() {
    integrate_all();
    solution_.ended_by_event &= solution_.success();
    if (solution_.ended_by_event)
      solution_.report.message =
          fmt::format("an event ended the run at t = {:.9g}; {}", solution_.report.t, solution_.report.message);
    for (const std::string& note : solution_.notes) solution_.report.say(note);
    if (options_.dense_output)
      solution_.sol =
          std::make_shared<DenseOutput>(run_.shared_simulation(), options_.tolerance.has_value(),
                                        steps_.release(run_.simulation().state().t), run_.simulation().state());
    return std::move(solution_);
  }

 private:
  void integrate_all() {
    Simulation& simulation = run_.simulation();
    SolutionRecorder recorder(options_, simulation, steps_, replay_, stop_, solution_);
    const std::vector<Observer*> observers = {&recorder};
    const std::vector<Event> events = physical_events(options_, *simulation.system().space, solution_);
    const auto archive = [&](Archive& a) {
      a.section("solution");
      require_same_options(a);
      recorder.archive(a);
      steps_.archive(a, simulation.state());
    };
    if (options_.resumption.checkpoints != nullptr || options_.resumption.from != nullptr)
      equation_ = fingerprint_of_equation();
    WithSolution checkpoints(options_.resumption.checkpoints, archive);
    if (options_.resumption.from != nullptr) archive(*options_.resumption.from);
    solution_.report =
        run_.integrate(steps_, run_.adaptive() != nullptr ? &steps_ : nullptr, stop_, observers, events,
                       {.checkpoints = options_.resumption.checkpoints != nullptr ? &checkpoints : nullptr,
                        .from = options_.resumption.from});
    const State& last = simulation.state();
    if (!solution_.success() && last.t == solution_.report.t) recorder.record_end(last, steps_.energy(last));
    solution_.certificate = run_.certificate_after(solution_.report);
  }

  // But for t_end and what observers and actions do.
  void require_same_options(Archive& a) const {
    const SolveOptions& o = options_;
    const std::string size =
        o.tolerance ? fmt::format("tolerance = {}, h_max = {}", *o.tolerance, o.h_max) : fmt::format("h = {}", o.h);
    std::string events;
    for (const SolveEvent& event : o.events)
      events += fmt::format(", an event {} {}", static_cast<int>(event.direction), event.ends_at);
    same(a, fmt::format("{} by {}", problem_.name, solution_.method), "solves");
    same(a, fmt::format("{}, from t = {}, on the backend {}", size, o.t_start, solution_.backend), "steps with");
    same(a,
         fmt::format("every {} steps{}, {} dense output, {} ledger", o.record_every, events,
                     o.dense_output ? "with" : "without", o.ledger ? "with" : "without"),
         "records");
    same_numbers(a, fingerprint(problem_.initial), "z0");
    const std::vector<double> times = o.t_eval.value_or(std::vector<double>{std::nan("")});
    same_numbers(a, fingerprint(times), "t_eval");
    same_numbers(a, equation_, "equation (M, S, D, V or a parameter)");
  }
  static void same(Archive& a, const std::string& here, const char* verb) {
    std::string there = here;
    a(there);
    if (there != here)
      throw Error("the checkpoint is of another call: that one {0} {1}, and this one {0} {2}", verb, shortened(there),
                  here);
  }
  static void same_numbers(Archive& a, std::uint64_t here, const char* name) {
    std::uint64_t there = here;
    a(there);
    if (there != here) throw Error("the checkpoint is of another call: its {} has other numbers", name);
  }

  // Of the bits of numbers, by FNV-1a over eight bytes at a time.
  static constexpr std::uint64_t of_nothing = 0xcbf29ce484222325U;
  static std::uint64_t fingerprint(std::span<const double> numbers, std::uint64_t before = of_nothing) {
    for (const double number : numbers) before = (before ^ std::bit_cast<std::uint64_t>(number)) * 0x100000001b3U;
    return before;
  }
  static std::uint64_t fingerprint(const Vector& z, std::uint64_t before = of_nothing) {
    return fingerprint(std::span(z.data(), static_cast<std::size_t>(z.size())), before);
  }
  // H, and ż at two places and times: what is solved, whether by formulas, matrices or functions.
  std::uint64_t fingerprint_of_equation() {
    const Simulation& simulation = run_.simulation();
    const double H = steps_.energy(simulation.state()).H;
    std::uint64_t print = fingerprint(std::span(&H, 1));
    Vector z = simulation.state().z, rate(z.size());
    for (const double t : {options_.t_start, options_.t_start + 0.375}) {
      simulation.system().right_hand_side(t, z, rate);
      print = fingerprint(rate, print);
      for (Index i = 0; i < z.size(); ++i) z[i] += 1e-3 * static_cast<double>(1 + i % 5);
    }
    return print;
  }

  const SolveOptions& options_;
  Problem problem_;
  PreparedRun run_;
  RememberingStepper steps_;
  StepReplay replay_;
  std::atomic<bool> stop_ = false;
  std::uint64_t equation_ = 0;  // its fingerprint
  Solution solution_;
};

}  // namespace

Solution solve(const Problem& problem, const SolveOptions& options) {
  validate(problem, options);
  require_memory(problem, options);
  return Run(problem, options).solve();
}

}  // namespace seiche
