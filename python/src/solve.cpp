// One run, with the GIL released while it steps.
#include "bind.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <seiche/config/case/case_file.hpp>
#include <seiche/driver/checkpoint_keeper.hpp>
#include <seiche/driver/processes.hpp>
#include <seiche/output/file/folder_lock.hpp>
#include <seiche/output/summary.hpp>
#include <seiche/record/checkpoint_file.hpp>
#include <seiche/record/run_folder.hpp>
#include <seiche/simulation/solve.hpp>
#include <seiche/study/versions.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace seiche::python {
namespace {

struct HeldSolution {
  std::shared_ptr<const Solution> solution;
  RunIdentity identity;
  std::vector<std::string> remarks = {};    // on checkpoints
  std::shared_ptr<const Ranks> ranks = {};  // which `solution` may refer to
};

py::object alive(const std::shared_ptr<const Solution>& solution) {
  return py::capsule(new std::shared_ptr<const Solution>(solution),
                     [](void* held) { delete static_cast<std::shared_ptr<const Solution>*>(held); });
}

py::array series(const HeldSolution& held, const std::vector<double>& values) {
  return view(values.data(), {std::ssize(values)}, {}, alive(held.solution));
}

py::array states(const HeldSolution& held) {  // (size, times)
  const Solution& s = *held.solution;
  return view(s.z.data(), {s.size, std::ssize(s.t)}, {1, s.size}, alive(held.solution));
}

SolveEvent event_from(const py::tuple& parts) {
  const Callable g(parts[0].cast<py::object>());
  const int direction = parts[1].cast<int>();
  SolveEvent event{.g =
                       [g](double t, const Vector& z) {
                         return with_gil([&] { return number_from(g.get()(t, array_of(z)), "an event function"); });
                       },
                   .direction = direction > 0   ? Event::Direction::rising
                                : direction < 0 ? Event::Direction::falling
                                                : Event::Direction::any,
                   .ends_at = parts[2].cast<std::int64_t>()};
  if (!parts[3].is_none())
    event.action = [action = Callable(parts[3].cast<py::object>())](double t, Vector& z) {
      with_gil<false>([&] {
        const py::object changed = action.get()(t, array_of(z));
        if (!changed.is_none())
          copy_from(changed, {z.data(), static_cast<std::size_t>(z.size())}, "the action of an event");
        return 0;
      });
    };
  return event;
}

std::function<bool(const SolveStep&)> observer_from(const py::object& function) {
  return [observer = Callable(function)](const SolveStep& step) {
    bool goes_on = true;
    between_steps([&] { goes_on = !is_false(observer.get()(step.t, array_of(step.z), step.energy.H)); });
    return goes_on && !Interruption::seen();
  };
}

// The case of a call, whose end may be another when it goes on; "" of a problem that no case states.
std::string text_of_call(RunSpec spec) {
  spec.t_end = spec.t_start + 1;
  try {
    return write_case(spec);
  } catch (const Error&) {
    return "";
  }
}

// The checkpoints of a call in a folder: it goes on from the newest, and removes them at its end.
class KeptCall {
 public:
  KeptCall(const std::string& folder, const RunSpec& spec, double t_end)
      : folder_(made(folder)), lock_(folder_), text_(text_of_call(spec)) {
    if (!checkpoints_in(folder).empty()) {
      newest_ = newest_checkpoint(folder_, remarks_);
      const SavedRun& saved = newest_->run;
      if (saved.kind != RunKind::solve) require_no_checkpoint(folder);
      if (saved.t > t_end)
        throw Error("t_span ends at {:.9g}, and the checkpoint in {} is at t = {:.9g}", t_end, folder, saved.t);
      if (saved.case_text != text_)
        throw Error("{} holds a checkpoint of another call of seiche.solve, whose problem, method or options differ",
                    folder);
      notes_ = notes_on_versions(saved, versions_in_use());
      notes_.insert(notes_.begin(), fmt::format("went on from {} in {}, t = {:.9g} (step {})", newest_->name, folder,
                                                saved.t, saved.steps));
      promote_checkpoint(folder_, newest_->name);
    }
    keeper_.emplace(folder_,
                    CheckpointKeeper::Options{.now = [this](std::int64_t n, double t) { return now(n, t); },
                                              .warn = [this](const std::string& note) { remarks_.push_back(note); },
                                              .way = "the same call"},
                    newest_ ? &newest_->run : nullptr);
  }

  Resumption resumption() { return {.checkpoints = &*keeper_, .from = newest_ ? &newest_->rest : nullptr}; }
  const std::vector<std::string>& remarks() const { return remarks_; }
  // What there is to say of it.
  void end(Solution& solution) {
    const RunReport& report = solution.report;
    if (solution.success() || report.step_failed) {
      remove_checkpoints(folder_);
    } else {
      solution.report.message += keeper_->way_on(report.t);
    }
    solution.notes.insert(solution.notes.end(), notes_.begin(), notes_.end());
  }

 private:
  static const std::string& made(const std::string& folder) {
    make_directory(folder);
    return folder;
  }
  SavedRun now(std::int64_t n, double t) const {
    SavedRun saved;
    saved.kind = RunKind::solve;
    saved.versions = lines_of(versions_in_use());
    saved.case_text = text_;
    saved.t = t;
    saved.steps = n;
    return saved;
  }

  Folder folder_;
  FolderLock lock_;
  std::string text_;
  std::vector<std::string> notes_, remarks_;
  std::optional<Checkpoint> newest_;
  std::optional<CheckpointKeeper> keeper_;
};

// True where it is so on one of several processes.
bool any(const Ranks* ranks, bool here) {
  double is_so = here ? 1 : 0;
  if (ranks != nullptr) ranks->max({&is_so, 1});
  return is_so != 0;
}

HeldSolution solve(const HeldProblem& problem, const RunSpec& spec, double t_start, double t_end,
                   const std::optional<Array>& z0, const std::optional<Array>& t_eval, const py::list& events,
                   bool dense_output, const py::object& observer, std::int64_t record_every, bool ledger, int threads,
                   const std::optional<std::string>& checkpoint, const py::object& progress,
                   std::optional<int> communicator) {
  HeldSolution held;
  if (communicator) held.ranks = ranks_of_communicator(*communicator, {"../..", SEICHE_MODULES_FROM_PYTHON});
  const Ranks* const ranks = held.ranks.get();
  SimulationOptions simulation = simulation_options(spec);
  simulation.backend_options.threads = threads;
  simulation.backend_options.ranks = ranks;
  SolveOptions options{.method = spec.method,
                       .method_options = spec.method_options,
                       .backend = spec.backend,
                       .backend_options = simulation.backend_options,
                       .noise = spec.noise,
                       .h = spec.h,
                       .tolerance = spec.tolerance,
                       .h_max = spec.h_max,
                       .t_start = t_start,
                       .t_end = t_end,
                       .record_every = record_every,
                       .dense_output = dense_output,
                       .ledger = ledger,
                       .is_stopped = [signals = SignalCheck{}, tell = Progress(progress, t_end),
                                      ranks](double t, std::int64_t steps) mutable {
                         tell(t, steps);
                         return any(ranks, signals());
                       }};
  if (z0) options.z0 = vector_from(*z0);
  if (t_eval) options.t_eval.emplace(t_eval->data(), t_eval->data() + t_eval->size());
  for (const py::handle& event : events) options.events.push_back(event_from(event.cast<py::tuple>()));
  if (!observer.is_none())
    options.observer = [ranks, shows = observer_from(observer)](const SolveStep& step) {
      return !any(ranks, !shows(step));
    };

  const Interruption::LetsStepEnd lets_step_end;
  auto solution = without_gil([&] {
    std::optional<KeptCall> kept;
    if (checkpoint) options.resumption = kept.emplace(*checkpoint, spec, t_end).resumption();
    auto found = std::make_shared<Solution>(solve(*problem.problem, options));
    if (Interruption::seen()) found->report.status = RunReport::Status::interrupted;
    if (kept) kept->end(*found);
    if (kept) held.remarks = kept->remarks();
    return found;
  });
  const double h = spec.tolerance ? std::numeric_limits<double>::quiet_NaN() : spec.h;
  RunIdentity identity{.problem = problem.problem->name,
                       .method = solution->method,
                       .backend = solution->backend,
                       .h = h,
                       .tolerance = spec.tolerance,
                       .threads = threads};
  held.solution = std::move(solution);
  held.identity = std::move(identity);
  return held;
}

py::array_t<double> at(const HeldSolution& held, const Array& times) {  // (times, size)
  const DenseOutput& sol = *held.solution->sol;
  py::array_t<double> values({static_cast<py::ssize_t>(times.size()), static_cast<py::ssize_t>(sol.size())});
  const std::span<const double> t(times.data(), static_cast<std::size_t>(times.size()));
  const std::span<double> out(values.mutable_data(), static_cast<std::size_t>(values.size()));
  // A step is taken for every time: in blocks, between which Ctrl-C is heard.
  constexpr std::size_t block = 256;
  const auto size = static_cast<std::size_t>(sol.size());
  SignalCheck is_stopped;
  without_gil([&] {
    for (std::size_t first = 0; first < t.size(); first += block) {
      if (is_stopped()) throw Error("interrupted");  // becomes a KeyboardInterrupt
      const std::size_t count = std::min(block, t.size() - first);
      sol.evaluate(t.subspan(first, count), out.subspan(first * size, count * size));
    }
    return 0;
  });
  return values;
}

py::dict ledger_of(const HeldSolution& held) {
  py::dict parts;
  const std::vector<StepLedger>& rows = held.solution->ledger;
  for (const LedgerPart& part : ledger_parts()) {
    py::array_t<double> values(std::ssize(rows));
    for (std::size_t i = 0; i < rows.size(); ++i) values.mutable_at(static_cast<py::ssize_t>(i)) = rows[i].*part.value;
    parts[py::str(std::string(part.name))] = values;
  }
  return parts;
}

std::string report_json(const HeldSolution& held) {
  RunIdentity identity = held.identity;
  identity.certificate = certificate_json(held.solution->certificate);
  identity.versions = versions_in_use();
  return summary_json(identity, held.solution->report);
}

}  // namespace

void bind_solve(py::module_& module) {
  py::class_<HeldSolution>(module, "Solution")
      .def_property_readonly("size", [](const HeldSolution& s) { return s.solution->size; })
      .def_property_readonly("t", [](const HeldSolution& s) { return series(s, s.solution->t); })
      .def_property_readonly("y", &states)
      .def_property_readonly("H", [](const HeldSolution& s) { return series(s, s.solution->H); })
      .def_property_readonly("modified",
                             [](const HeldSolution& s) -> py::object {
                               if (s.solution->modified.empty()) return py::none();
                               return series(s, s.solution->modified);
                             })
      .def_property_readonly("t_events",
                             [](const HeldSolution& s) {
                               py::list list;
                               for (const Solution::Events& e : s.solution->events) list.append(series(s, e.t));
                               return list;
                             })
      .def_property_readonly(
          "y_events",
          [](const HeldSolution& s) {
            py::list list;
            for (const Solution::Events& e : s.solution->events)
              list.append(view(e.z.data(), {std::ssize(e.t), s.solution->size}, {}, alive(s.solution)));
            return list;
          })
      .def_property_readonly("ledger", &ledger_of)
      .def_property_readonly("status", [](const HeldSolution& s) { return to_string(s.solution->report.status); })
      .def_property_readonly("message", [](const HeldSolution& s) { return s.solution->report.message; })
      .def_property_readonly("remarks",
                             [](const HeldSolution& s) {
                               std::vector<std::string> all = s.solution->report.remarks();
                               all.insert(all.end(), s.remarks.begin(), s.remarks.end());
                               return all;
                             })
      .def_property_readonly("ended_by_event", [](const HeldSolution& s) { return s.solution->ended_by_event; })
      .def_property_readonly("nfev",
                             [](const HeldSolution& s) { return s.solution->report.potential_counts.gradients; })
      .def_property_readonly("steps", [](const HeldSolution& s) { return s.solution->report.steps; })
      .def_property_readonly("law", [](const HeldSolution& s) { return to_string(s.solution->report.law); })
      .def_property_readonly("law_reason", [](const HeldSolution& s) { return s.solution->report.law_reason; })
      .def_property_readonly("method", [](const HeldSolution& s) { return s.solution->method; })
      .def_property_readonly("method_reason", [](const HeldSolution& s) { return s.solution->method_reason; })
      .def_property_readonly("notes", [](const HeldSolution& s) { return s.solution->notes; })
      .def_property_readonly("backend", [](const HeldSolution& s) { return s.solution->backend; })
      .def_property_readonly("has_sol", [](const HeldSolution& s) { return s.solution->sol != nullptr; })
      .def_property_readonly("sol_span",
                             [](const HeldSolution& s) {
                               return std::make_pair(s.solution->sol->t_start(), s.solution->sol->t_end());
                             })
      .def("at", &at)
      .def("report_json", &report_json)
      .def("certificate_json", [](const HeldSolution& s) { return certificate_json(s.solution->certificate); });
  module.def("solve", &solve);
}

}  // namespace seiche::python
