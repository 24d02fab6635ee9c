#include "callbacks.hpp"

#include <algorithm>

namespace seiche::python {
namespace {

thread_local bool interrupted = false;
thread_local int scopes = 0;

}  // namespace

Callable::Callable(py::object function)
    : function_(new py::object(std::move(function)), [](py::object* held) {
        const py::gil_scoped_acquire gil;
        delete held;
      }) {}

Interruption::Scope::Scope() {
  if (scopes++ == 0) interrupted = false;
}
Interruption::Scope::~Scope() { --scopes; }
bool Interruption::seen() { return interrupted; }
void Interruption::note() { interrupted = true; }

Array array_of(std::span<const double> values) { return Array(std::ssize(values), values.data()); }

double number_from(const py::object& result, const std::string& what) {
  const double value = PyFloat_AsDouble(result.ptr());
  if (value == -1.0 && PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw py::type_error(fmt::format("{} must return a number, but it returned {}", what,
                                     py::repr(py::type::of(result)).cast<std::string>()));
  }
  return value;
}

void copy_from(const py::object& result, std::span<double> out, const std::string& what) {
  if (py::isinstance<py::array>(result) && py::reinterpret_borrow<py::array>(result).dtype().kind() == 'c')
    throw py::value_error(fmt::format("{} returned complex numbers; it must return real ones", what));
  const Array values = Array::ensure(result);
  if (!values) {
    PyErr_Clear();
    throw py::type_error(fmt::format("{} must return an array of numbers, but it returned {}", what,
                                     py::repr(py::type::of(result)).cast<std::string>()));
  }
  if (values.size() != std::ssize(out))
    throw py::value_error(fmt::format("{} returned {} numbers, but {} are needed", what, values.size(), out.size()));
  std::copy_n(values.data(), out.size(), out.begin());
}

Vector vector_from(const Array& values) { return Eigen::Map<const Vector>(values.data(), values.size()); }

bool SignalCheck::operator()() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return interrupted;
  next_ = now + std::chrono::milliseconds(50);
  const py::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() == 0) return interrupted;
  if (PyErr_ExceptionMatches(PyExc_KeyboardInterrupt) == 0) throw py::error_already_set();
  PyErr_Clear();
  interrupted = true;
  return true;
}

}  // namespace seiche::python
