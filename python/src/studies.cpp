// Certificates, spectra and convergence, as the JSON documents that the program prints.
#include "bind.hpp"

#include <pybind11/stl.h>
#include <seiche/study/certificate.hpp>
#include <seiche/study/converge.hpp>
#include <seiche/study/spectrum.hpp>

#include <atomic>
#include <future>

namespace seiche::python {
namespace {

std::string check(const HeldProblem& held, const RunSpec& spec) {
  return without_gil([&] {
    const Simulation simulation(*held.problem, simulation_options(spec));  // refuses what `solve` refuses
    return certificate_json(certify(*held.problem, {.method = std::string(simulation.method().name),
                                                    .method_options = simulation.method_options(),
                                                    .t_end = spec.t_end,
                                                    .at_start = &simulation}));
  });
}

std::string spectrum_of(const HeldProblem& held, const RunSpec& spec) {
  if (spec.h == 0) throw Error("a tolerance without h, and spectrum looks at one step: give h, such as \"1/64\"");
  return without_gil([&] { return spectrum_json(spectrum(*held.problem, simulation_options(spec), spec.h)); });
}

// However the wait ends, before the thread is waited for.
struct StopsAtEnd {
  std::atomic<bool>& stop;
  ~StopsAtEnd() { stop = true; }
};

// On a thread of its own, while this one looks for Ctrl-C.
std::string converge_of(const HeldProblem& held, const std::vector<std::string>& methods,
                        const std::vector<double>& step_sizes, const RunSpec& spec, bool timed) {
  std::atomic<bool> stop = false;
  const ConvergeOptions options{.t_end = spec.t_end,
                                .backend = spec.backend,
                                .backend_options = simulation_options(spec).backend_options,
                                .method_options = spec.method_options,
                                .reference = {.stop = &stop},
                                .timed = timed,
                                .timing = {.stop = &stop},
                                .stop = &stop};
  return without_gil([&] {
    auto study = std::async(std::launch::async, [&] { return converge(*held.problem, methods, step_sizes, options); });
    const StopsAtEnd stops{stop};
    SignalCheck signals;
    while (study.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready)
      if (signals()) throw Error("interrupted");
    return converge_json(study.get());
  });
}

}  // namespace

void bind_studies(py::module_& module) {
  module.def("check", &check);
  module.def("spectrum", &spectrum_of);
  module.def("converge", &converge_of);
}

}  // namespace seiche::python
