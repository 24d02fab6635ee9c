// Steps of one's own: a simulation that Python moves.
#include "bind.hpp"

#include <pybind11/stl.h>
#include <seiche/simulation/simulation.hpp>

#include <memory>
#include <string>
#include <utility>

namespace seiche::python {
namespace {

class HeldSimulation {
 public:
  HeldSimulation(const HeldProblem& problem, const RunSpec& spec, const std::optional<Array>& z0, double t, int threads)
      : problem_(problem) {
    Problem started = *problem.problem;
    if (z0) started.initial = vector_from(*z0);
    SimulationOptions options = simulation_options(spec);
    options.backend_options.threads = threads;
    simulation_ = without_gil([&] { return std::make_unique<Simulation>(started, options); });
    simulation_->state().t = t;
  }

  // Returns why a step failed, "" where none did: the state is then that before it. Throws Error at Ctrl-C.
  std::string step(double h, std::int64_t count) {
    SignalCheck is_stopped;
    return without_gil([&]() -> std::string {
      for (std::int64_t k = 0; k < count; ++k) {
        if (is_stopped()) throw Error("interrupted");  // becomes a KeyboardInterrupt
        const StepReport report = simulation_->step(h);
        if (!report.solved()) return report.message;
        replaced_ += report.replaced.count;
      }
      return "";
    });
  }

  void set_state(const Array& y, double t) {
    State& state = simulation_->state();
    State fresh{.z = state.z, .t = t, .stream = state.stream + (std::uint64_t{1} << 32U)};  // other noise
    simulation_->system().space->from_physical(vector_from(y), fresh.z);
    state = std::move(fresh);
    simulation_->stepper().begin(state);
  }

  const Simulation& simulation() const { return *simulation_; }
  std::int64_t replaced() const { return replaced_; }

 private:
  HeldProblem problem_;  // its Python functions
  std::unique_ptr<Simulation> simulation_;
  std::int64_t replaced_ = 0;
};

}  // namespace

void bind_simulations(py::module_& module) {
  py::class_<HeldSimulation>(module, "Simulation")
      .def(py::init<const HeldProblem&, const RunSpec&, const std::optional<Array>&, double, int>())
      .def("step", &HeldSimulation::step)
      .def("set_state", &HeldSimulation::set_state)
      .def_property_readonly("t", [](const HeldSimulation& s) { return s.simulation().state().t; })
      .def_property_readonly("steps", [](const HeldSimulation& s) { return s.simulation().state().n; })
      .def_property_readonly("y", [](const HeldSimulation& s) { return array_of(s.simulation().physical()); })
      .def_property_readonly("H", [](const HeldSimulation& s) { return s.simulation().energy().H; })
      .def_property_readonly("modified", [](const HeldSimulation& s) { return s.simulation().energy().modified; })
      .def_property_readonly("method",
                             [](const HeldSimulation& s) { return std::string(s.simulation().method().name); })
      .def_property_readonly("backend",
                             [](const HeldSimulation& s) { return std::string(s.simulation().backend().name); })
      .def_property_readonly("replaced", &HeldSimulation::replaced);
}

}  // namespace seiche::python
