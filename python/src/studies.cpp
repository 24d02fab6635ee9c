// Certificates, spectra and convergence, as the JSON documents that the program prints.
#include "bind.hpp"
#include "interruptible.hpp"

#include <pybind11/stl.h>
#include <seiche/simulation/certificate.hpp>
#include <seiche/study/converge.hpp>
#include <seiche/study/spectrum.hpp>

namespace seiche::python {
namespace {

std::string check(const HeldProblem& held, const RunSpec& spec) {
  return interruptible([&](const std::atomic<bool>* stop) {
    const Simulation simulation(*held.problem, simulation_options(spec));  // refuses what `solve` refuses
    return certificate_json(certify(*held.problem, {.method = std::string(simulation.method().name),
                                                    .method_options = simulation.method_options(),
                                                    .noise = spec.noise,
                                                    .t_start = spec.t_start,
                                                    .t_end = spec.t_end,
                                                    .at_start = &simulation,
                                                    .stop = stop}));
  });
}

std::string spectrum_of(const HeldProblem& held, const RunSpec& spec) {
  refuse_noise(spec, "spectrum");
  if (spec.h == 0) throw Error("a tolerance without h, and spectrum looks at one step: give h, such as \"1/64\"");
  return interruptible([&](const std::atomic<bool>* stop) {
    return spectrum_json(spectrum(*held.problem, simulation_options(spec), spec.h, stop));
  });
}

std::string converge_of(const HeldProblem& held, const std::vector<std::string>& methods,
                        const std::vector<double>& step_sizes, const RunSpec& spec, bool timed) {
  refuse_noise(spec, "converge");
  if (spec.t_start != 0)
    throw Error("the case has time.start = {}, and converge compares runs from t = 0: leave it out", spec.t_start);
  return interruptible([&](const std::atomic<bool>* stop) {
    const ConvergeOptions options{.t_end = spec.t_end,
                                  .backend = spec.backend,
                                  .backend_options = simulation_options(spec).backend_options,
                                  .method_options = spec.method_options,
                                  .reference = {.stop = stop},
                                  .timed = timed,
                                  .timing = {.stop = stop},
                                  .stop = stop};
    return converge_json(converge(*held.problem, methods, step_sizes, options));
  });
}

}  // namespace

void bind_studies(py::module_& module) {
  module.def("check", &check);
  module.def("spectrum", &spectrum_of);
  module.def("converge", &converge_of);
}

}  // namespace seiche::python
