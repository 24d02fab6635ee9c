// What there is, as dictionaries with the keys of `seiche list --json`.
#include "bind.hpp"

#include <pybind11/stl.h>
#include <seiche/backend/backends.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/problem/problems.hpp>

namespace seiche::python {
namespace {

py::list list_methods() {
  using namespace pybind11::literals;
  py::list list;
  for (const MethodEntry& m : methods())
    list.append(py::dict("name"_a = m.name, "closure"_a = to_string(m.closure),
                         "propagator"_a = to_string(m.propagator), "composition"_a = to_string(m.composition),
                         "order"_a = m.order, "law"_a = m.law, "reference"_a = m.reference));
  return list;
}

py::list list_problems() {
  using namespace pybind11::literals;
  py::list list;
  for (const ProblemEntry& p : problems()) {
    py::list parameters;
    for (const Parameter& parameter : p.parameters)
      parameters.append(
          py::dict("name"_a = parameter.name, "default"_a = parameter.default_value, "meaning"_a = parameter.meaning));
    list.append(py::dict("name"_a = p.name, "equation"_a = p.equation, "reference"_a = p.reference,
                         "fields"_a = p.fields, "initial"_a = p.presets, "parameters"_a = parameters));
  }
  return list;
}

py::list list_backends() {
  using namespace pybind11::literals;
  py::list list;
  for (const BackendEntry& b : backends()) list.append(py::dict("name"_a = b.name, "summary"_a = b.summary));
  return list;
}

}  // namespace

void bind_lists(py::module_& module) {
  module.def("methods", &list_methods,
             "Every method: name, closure, propagator, composition, order, the energy that never grows, reference.");
  module.def("problems", &list_problems,
             "Every problem: name, equation, reference, fields, initial data, and parameters with their defaults.");
  module.def("backends", &list_backends, "Every backend: name and summary.");
}

}  // namespace seiche::python
