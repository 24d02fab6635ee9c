// A case run to its folder, as the program does it.
#include "bind.hpp"
#include "interruptible.hpp"

#include <pybind11/stl.h>
#include <seiche/driver/run_case.hpp>
#include <seiche/driver/run_ensemble_case.hpp>

#include <string>
#include <utility>
#include <vector>

namespace seiche::python {
namespace {

struct CaseRun {
  std::string summary;
  std::vector<std::string> notes,
      remarks;  // what there was to say before the run, and what nobody should miss after it
};

CaseRun run_to(const std::string& folder, RunSpec spec, RunCaseOptions options) {
  CaseRun done;
  settle_method(spec);
  options.warn = [&](const std::string& note) { done.remarks.push_back(note); };
  if (spec.ensemble) {
    EnsembleCaseResult result = run_ensemble_case(std::move(spec), folder, options);
    done.summary = std::move(result.summary);
    if (result.outcome.is_remarkable()) done.remarks.push_back(result.outcome.message);
    return done;
  }
  CaseResult result = run_case(std::move(spec), folder, options);
  done.summary = std::move(result.summary);
  for (std::string& remark : result.report.remarks()) done.remarks.push_back(std::move(remark));
  return done;
}

// On a thread of its own, while this one looks for Ctrl-C: the run ends after its step, with its files whole. Where the
// last step is taken, what can be had later is left out.
CaseRun run(const RunSpec& spec, const std::string& folder, int threads, bool restart) {
  std::atomic<bool> stop = false, has_ended = false, leave = false;
  std::vector<std::string> notes;
  const RunCaseOptions options{.threads = threads,
                               .restart = restart,
                               .begins =
                                   [&](const std::vector<std::string>& said) {
                                     notes = said;
                                     return &stop;
                                   },
                               .ends =
                                   [&] {
                                     has_ended = true;
                                     return &leave;
                                   }};
  CaseRun result = beside_signals(
      stop, [&] { return run_to(folder, spec, options); }, [&] { (has_ended ? leave : stop) = true; });
  result.notes = std::move(notes);
  return result;
}

}  // namespace

void bind_runs(py::module_& module) {
  py::class_<CaseRun>(module, "CaseRun")
      .def_readonly("summary", &CaseRun::summary)
      .def_readonly("notes", &CaseRun::notes)
      .def_readonly("remarks", &CaseRun::remarks);
  module.def("run", &run);
}

}  // namespace seiche::python
