#include "callbacks.hpp"

#include <algorithm>
#include <atomic>
#include <thread>
#include <utility>

namespace seiche::python {
namespace {

thread_local bool interrupted = false;
thread_local int scopes = 0;
thread_local int interruptions = 0;
thread_local bool step_may_end = false;

std::atomic<bool> interpreter_ends = false;
std::atomic<int> runs = 0;

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
Interruption::LetsStepEnd::LetsStepEnd() : before_(std::exchange(step_may_end, true)) {}
Interruption::LetsStepEnd::~LetsStepEnd() { step_may_end = before_; }
bool Interruption::lets_step_end() { return step_may_end; }
bool Interruption::seen() { return interrupted; }
void Interruption::note() {
  interrupted = true;
  ++interruptions;
}
int Interruption::count() { return interruptions; }

InterpreterEnd::Run::Run() { ++runs; }
InterpreterEnd::Run::~Run() { --runs; }
bool InterpreterEnd::is_near() { return interpreter_ends; }

void InterpreterEnd::stop_runs() {
  interpreter_ends = true;
  const py::gil_scoped_release released;
  constexpr auto patience = std::chrono::seconds(60);  // for one long step
  const auto give_up = std::chrono::steady_clock::now() + patience;
  while (runs > 0 && std::chrono::steady_clock::now() < give_up)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

Array array_of(std::span<const double> values) { return Array(std::ssize(values), values.data()); }

namespace {

py::type_error wrong_answer(const std::string& what, const std::string& wanted, const py::object& answer) {
  return py::type_error(fmt::format("{} must return {}, but it returned {}", what, wanted,
                                    py::repr(py::type::of(answer)).cast<std::string>()));
}

bool has_kind(const py::object& result, const char* kind) {  // of NumPy's, scalars too
  return py::hasattr(result, "dtype") && result.attr("dtype").attr("kind").cast<std::string>() == kind;
}

}  // namespace

bool is_false(const py::object& answer) {
  const bool is_truth =
      PyBool_Check(answer.ptr()) != 0 || (has_kind(answer, "b") && answer.attr("size").cast<py::ssize_t>() == 1);
  return is_truth && !py::bool_(answer);
}

double number_from(const py::object& result, const std::string& what) {
  if (PyComplex_Check(result.ptr()) != 0 || has_kind(result, "c"))
    throw py::value_error(fmt::format("{} returned a complex number; it must return a real one", what));
  const double value = PyFloat_AsDouble(result.ptr());
  if (value == -1.0 && PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    throw wrong_answer(what, "a number", result);
  }
  return value;
}

void copy_from(const py::object& result, std::span<double> out, const std::string& what) {
  if (py::isinstance<py::array>(result) && py::reinterpret_borrow<py::array>(result).dtype().kind() == 'c')
    throw py::value_error(fmt::format("{} returned complex numbers; it must return real ones", what));
  const Array values = Array::ensure(result);
  if (!values) {
    PyErr_Clear();
    throw wrong_answer(what, "an array of numbers", result);
  }
  if (values.size() != std::ssize(out))
    throw py::value_error(fmt::format("{} returned {} numbers, but {} are needed", what, values.size(), out.size()));
  std::copy_n(values.data(), out.size(), out.begin());
}

Vector vector_from(const Array& values) { return Eigen::Map<const Vector>(values.data(), values.size()); }

Progress::Progress(const py::object& function, double t_end) : t_end_(t_end) {
  if (!function.is_none()) function_.emplace(function);
}

void Progress::operator()(double t, std::int64_t steps) {
  if (!function_ || std::chrono::steady_clock::now() < next_) return;
  between_steps([&] { function_->get()(t, t_end_, steps); });
  next_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(100);
}

bool SignalCheck::operator()() {
  if (InterpreterEnd::is_near()) return interrupted = true;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return interrupted;
  next_ = now + std::chrono::milliseconds(50);
  const py::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() == 0) return interrupted;
  if (PyErr_ExceptionMatches(PyExc_KeyboardInterrupt) == 0) throw py::error_already_set();
  PyErr_Clear();
  Interruption::note();
  return true;
}

bool SignalCheck::is_new() {
  (*this)();
  return std::exchange(seen_, interruptions) != interruptions || InterpreterEnd::is_near();
}

}  // namespace seiche::python
