// What the parts of the module share.
#pragma once

#include "callbacks.hpp"

#include <seiche/config/case/run_spec.hpp>

#include <memory>

namespace seiche::python {

// A problem as Python holds it.
struct HeldProblem {
  std::shared_ptr<const Problem> problem;
  bool has_callbacks = false;  // V by Python functions: then one thread steps
};

void bind_problems(py::module_& module);
void bind_solve(py::module_& module);
void bind_ensembles(py::module_& module);
void bind_runs(py::module_& module);
void bind_studies(py::module_& module);
void bind_simulations(py::module_& module);
void bind_lists(py::module_& module);

// Numbers that `owner` keeps alive, without a copy; strides in numbers, none for C order.
py::array view(const double* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
               const py::object& owner);

}  // namespace seiche::python
