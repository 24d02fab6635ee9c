// A case run to its folder, as the program does it.
#include "bind.hpp"
#include "interruptible.hpp"

#include <pybind11/stl.h>
#include <seiche/driver/going_on.hpp>
#include <seiche/driver/run_ensemble_case.hpp>
#include <seiche/figure/drawing.hpp>
#include <seiche/figure/ensemble_pictures.hpp>
#include <seiche/figure/run_pictures.hpp>
#include <seiche/figure/run_report.hpp>
#include <seiche/output/file/folder_lock.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/record/run_folder.hpp>
#include <seiche/study/run_view.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seiche::python {
namespace {

struct CaseRun {
  std::string summary;
  std::vector<std::string> notes,
      remarks;  // notes from before the run, and warnings after it
};

CaseRun with_result(CaseRun done, CaseResult result) {
  done.summary = std::move(result.summary);
  for (std::string& remark : result.report.remarks()) done.remarks.push_back(std::move(remark));
  return done;
}

CaseRun with_result(CaseRun done, EnsembleCaseResult result) {
  done.summary = std::move(result.summary);
  if (result.outcome.is_remarkable()) done.remarks.push_back(result.outcome.message);
  return done;
}

CaseRun run_to(const std::string& folder, RunSpec spec, RunCaseOptions options) {
  CaseRun done;
  settle_method(spec);
  options.warn = [&](const std::string& note) { done.remarks.push_back(note); };
  if (spec.ensemble) {
    EnsembleCaseResult result = run_ensemble_case(std::move(spec), folder, options);
    return with_result(std::move(done), std::move(result));
  }
  return with_result(std::move(done), run_case(std::move(spec), folder, options));
}

// Where a run is, for the thread beside it. Of an ensemble, where its last record is.
class Whereabouts final : public Observer {
 public:
  bool is_due(const State& state, bool) const override {
    note(state);
    return false;
  }
  void observe(const State&, const EnergyReading&) override {}
  void pass(const State& state) override { note(state); }
  void finish(const RunReport&) override {}
  double t() const { return t_; }
  std::int64_t steps() const { return steps_; }

 private:
  void note(const State& state) const {
    t_.store(state.t, std::memory_order_relaxed);
    steps_.store(state.n, std::memory_order_relaxed);
  }
  mutable std::atomic<double> t_ = std::numeric_limits<double>::quiet_NaN();  // before the first step
  mutable std::atomic<std::int64_t> steps_ = 0;
};

// On a thread of its own, while this one looks for Ctrl-C: the run ends after its step, with its files whole. A second
// one behind the last step leaves out what can be had later.
CaseRun interruptible_run(RunCaseOptions options, double t_end, const py::object& progress,
                          const std::function<CaseRun(const RunCaseOptions&)>& run) {
  std::atomic<bool> stop = false, has_ended = false, leave = false;
  std::atomic<double> end = t_end;
  options.ends_at = [&](double resumed_end) { end = resumed_end; };
  Whereabouts where;
  std::optional<Progress> tell;
  if (!progress.is_none()) options.observers.push_back(&where);
  std::vector<std::string> notes;
  options.begins = [&] { return &stop; };
  options.introduce = [&](const std::string&, const std::vector<std::string>& said) { notes = said; };
  options.ends = [&] {
    has_ended = true;
    return &leave;
  };
  CaseRun result = beside_signals(
      stop, [&] { return run(options); },
      [&] {
        if (stop.exchange(true) && has_ended) leave = true;
      },
      [&] {
        if (progress.is_none() || std::isnan(where.t())) return;
        if (!tell) tell.emplace(progress, end);
        (*tell)(where.t(), where.steps());
      });
  result.notes = std::move(notes);
  return result;
}

CaseRun run(const RunSpec& spec, const std::string& folder, int threads, bool restart, double max_hours,
            const py::object& progress) {
  return interruptible_run({.threads = threads, .restart = restart, .max_hours = max_hours}, spec.t_end, progress,
                           [&](const RunCaseOptions& options) { return run_to(folder, spec, options); });
}

CaseRun resume(const std::string& folder, std::optional<double> t_end, int threads, double max_hours,
               const py::object& progress) {
  return interruptible_run({.threads = threads, .max_hours = max_hours}, 0, progress, [&](RunCaseOptions options) {
    CaseRun done;
    options.warn = [&](const std::string& note) { done.remarks.push_back(note); };
    GoingOn from = going_on(folder, t_end, options);
    if (from.spec.ensemble) return with_result(std::move(done), resume_ensemble_case(std::move(from), options));
    return with_result(std::move(done), resume_case(std::move(from), options));
  });
}

// The solution of a run that has ended, or of one that has not: a file for as long as this lives.
struct Look {
  std::string solution, how_far;  // "" of a run that has ended
  std::shared_ptr<const void> temporary;
};

Look look(const std::string& folder) {
  return without_gil([&] {
    const RunView view = view_of_run(folder);
    SolutionReader readable(view.run.solution);  // or h5py would end Python by damage
    return Look{view.run.solution, view.run.has_ended ? "" : view.run.status, view.run.temporary};
  });
}

// What `seiche plot` does, with the programs beside this module.
void report(const std::string& folder, const std::vector<std::string>& formats, bool film, const std::string& programs,
            const std::string& interpreter) {
  interruptible([&](const std::atomic<bool>*) {
    draw_with(programs, interpreter);
    if (holds_ensemble(folder)) {
      EnsemblePictures pictures = ensemble_pictures(folder);
      const FolderLock lock = lock_for_pictures(folder, pictures.is_running);
      draw_ensemble(pictures, folder, {.formats = formats});
      return 0;
    }
    const auto [run, history] = view_of_run(folder);
    const FolderLock lock = lock_for_pictures(run.directory, run.is_running);
    require_own_report(run.directory);
    require_own_figures(run.directory);
    write_run_report(run, history, draw_run(run, history, {.formats = formats, .film = film}));
    return 0;
  });
}

}  // namespace

void bind_runs(py::module_& module) {
  py::class_<CaseRun>(module, "CaseRun")
      .def_readonly("summary", &CaseRun::summary)
      .def_readonly("notes", &CaseRun::notes)
      .def_readonly("remarks", &CaseRun::remarks);
  py::class_<Look>(module, "Look")
      .def_readonly("solution", &Look::solution)
      .def_readonly("how_far", &Look::how_far)
      .def("release", [](Look& look) { look.temporary.reset(); });
  module.def("look", &look);
  module.def("run", &run);
  module.def("resume", &resume);
  module.def("report", &report);
}

}  // namespace seiche::python
