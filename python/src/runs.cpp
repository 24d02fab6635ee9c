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
  std::vector<std::string> remarks;  // what nobody should miss
};

CaseRun run_to(const std::string& folder, const RunSpec& spec, RunCaseOptions options) {
  CaseRun done;
  options.warn = [&](const std::string& note) { done.remarks.push_back(note); };
  if (spec.ensemble) {
    done.summary = run_ensemble_case(spec, folder, options).summary;
    return done;
  }
  CaseResult result = run_case(spec, folder, options);
  done.summary = std::move(result.summary);
  for (std::string& remark : result.report.remarks()) done.remarks.push_back(std::move(remark));
  return done;
}

// On a thread of its own, while this one looks for Ctrl-C: the run ends after its step, with its files whole.
CaseRun run(RunSpec spec, const std::string& folder, int threads, bool restart) {
  settle_method(spec);
  std::atomic<bool> stop = false;
  return without_gil([&] {
    auto done = std::async(std::launch::async, [&] {
      return run_to(folder, spec,
                    {.threads = threads, .restart = restart, .begins = [&](const std::vector<std::string>&) {
                       return &stop;
                     }});
    });
    const StopsAtEnd stops{stop};
    SignalCheck signals;
    while (done.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready)
      if (signals()) stop = true;
    return done.get();
  });
}

}  // namespace

void bind_runs(py::module_& module) {
  py::class_<CaseRun>(module, "CaseRun")
      .def_readonly("summary", &CaseRun::summary)
      .def_readonly("remarks", &CaseRun::remarks);
  module.def("run", &run);
}

}  // namespace seiche::python
