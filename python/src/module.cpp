// The compiled part of the Python package `seiche`. Shapes, defaults and documentation are in the Python files around
// it.
#include "bind.hpp"

#include <pybind11/stl.h>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/version.hpp>

namespace seiche::python {

py::array view(const double* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
               const py::object& owner) {
  for (py::ssize_t& stride : strides) stride *= static_cast<py::ssize_t>(sizeof(double));
  py::array array = strides.empty()
                        ? py::array(py::dtype::of<double>(), std::move(shape), data, owner)
                        : py::array(py::dtype::of<double>(), std::move(shape), std::move(strides), data, owner);
  return array;
}

py::dict parts_of(const Error& error) {
  const ErrorParts& parts = error.parts();
  py::dict named;
  named["place"] = parts.place;
  named["sentence"] = one_line(parts.sentence);
  named["key"] = parts.key;
  named["kind"] = parts.kind;
  named["name"] = parts.name;
  named["nearest"] = parts.nearest;
  named["allowed"] = parts.allowed;
  return named;
}

}  // namespace seiche::python

PYBIND11_MODULE(_core, module) {
  namespace py = pybind11;
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const seiche::Error& error) {
      py::object refusal = py::reinterpret_borrow<py::object>(PyExc_ValueError)(seiche::one_line(error.what()));
      refusal.attr("parts") = seiche::python::parts_of(error);
      PyErr_SetObject(PyExc_ValueError, refusal.ptr());
    }
  });
  py::module_::import("atexit").attr("register")(py::cpp_function(&seiche::python::InterpreterEnd::stop_runs));
  module.attr("__version__") = seiche::version_number;
  seiche::python::bind_problems(module);
  seiche::python::bind_solve(module);
  seiche::python::bind_ensembles(module);
  seiche::python::bind_runs(module);
  seiche::python::bind_studies(module);
  seiche::python::bind_simulations(module);
  seiche::python::bind_lists(module);
}
