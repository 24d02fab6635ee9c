// What there is, as dictionaries with the keys of `seiche list --json`.
#include "bind.hpp"

#include <pybind11/stl.h>
#include <seiche/figure/style.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/output/citation.hpp>
#include <seiche/study/lists.hpp>

#include <map>
#include <string>
#include <tuple>

namespace seiche::python {
namespace {

py::object parsed(const std::string& json) { return py::module_::import("json").attr("loads")(json); }

using Style = std::tuple<std::string, std::string, bool, std::string>;  // colour, marker, filled, dash

std::map<std::string, Style> method_styles() {
  std::map<std::string, Style> styles;
  for (const std::string& name : method_names()) {
    if (!find_method_style(name)) continue;  // "auto" draws as the method that it chose
    const LineStyle line = method_line(name);
    styles[name] = {line.colour, std::string(name_of(line.marker)), line.filled, std::string(name_of(line.dash))};
  }
  return styles;
}

}  // namespace

void bind_lists(py::module_& module) {
  module.attr("__citation__") = citation();
  module.def(
      "methods", [] { return parsed(methods_json()); },
      "Every method: name, closure, propagator, composition, order, the energy that never grows, projection, reference.");
  module.def(
      "problems", [] { return parsed(problems_json()); },
      "Every problem: name, equation, reference, fields, initial data, and parameters with their defaults.");
  module.def(
      "backends", [] { return parsed(backends_json()); }, "Every backend: name and summary.");
  module.def("method_styles", &method_styles, "Of each method its colour, marker, whether that is filled, and dash.");
}

}  // namespace seiche::python
