// What there is, as dictionaries with the keys of `seiche list --json`.
#include "bind.hpp"

#include <pybind11/stl.h>
#include <seiche/study/lists.hpp>

namespace seiche::python {
namespace {

py::object parsed(const std::string& json) { return py::module_::import("json").attr("loads")(json); }

}  // namespace

void bind_lists(py::module_& module) {
  module.def(
      "methods", [] { return parsed(methods_json()); },
      "Every method: name, closure, propagator, composition, order, the energy that never grows, projection, reference.");
  module.def(
      "problems", [] { return parsed(problems_json()); },
      "Every problem: name, equation, reference, fields, initial data, and parameters with their defaults.");
  module.def(
      "backends", [] { return parsed(backends_json()); }, "Every backend: name and summary.");
}

}  // namespace seiche::python
