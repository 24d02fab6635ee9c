// Python functions where C++ calls: the GIL is taken for the call, and Ctrl-C inside one ends the run as outside.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/vector.hpp>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace seiche::python {

namespace py = pybind11;

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

// May be copied and destroyed by threads that do not hold the GIL.
class Callable {
 public:
  explicit Callable(py::object function);
  const py::object& get() const { return *function_; }

 private:
  std::shared_ptr<py::object> function_;
};

// Whether Ctrl-C interrupted the run on this thread. The outermost scope begins without an interruption. A run inside a
// callback of another one leaves what it has seen, so that both end.
class Interruption {
 public:
  class Scope {
   public:
    Scope();
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
  };
  // While one lives, a function that Ctrl-C interrupts is called once more, so that the step ends well, and the run
  // behind it.
  class LetsStepEnd {
   public:
    LetsStepEnd();
    ~LetsStepEnd();
    LetsStepEnd(const LetsStepEnd&) = delete;
    LetsStepEnd& operator=(const LetsStepEnd&) = delete;

   private:
    bool before_;
  };
  static bool lets_step_end();
  static bool seen();
  static void note();
  static int count();  // of this thread, ever
};

// The end of the interpreter: a thread that asks for the GIL then never comes back, and takes the program with it. So
// runs on other threads end first.
class InterpreterEnd {
 public:
  // One run, as long as it lives; held with the GIL.
  class Run {
   public:
    Run();
    ~Run();
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;
  };
  static bool is_near();
  static void stop_runs();  // asks them to end, and waits; with the GIL held
};

// call(): with the GIL held. A KeyboardInterrupt is noted, and becomes an Error, which ends the run; the first of a run
// that lets its step end does not, where the call may be repeated, since it changes nothing.
template <bool may_be_repeated = true, class Call>
auto with_gil(const Call& call) {
  const py::gil_scoped_acquire gil;
  for (;;) {
    try {
      return call();
    } catch (py::error_already_set& error) {
      if (!error.matches(PyExc_KeyboardInterrupt)) throw;
      const bool is_first = !Interruption::seen();
      Interruption::note();
      if (!may_be_repeated || !is_first || !Interruption::lets_step_end()) break;
    }
  }
  throw Error("interrupted inside a Python function");
}

// call(): with the GIL held, after a step is done. Ctrl-C inside it is noted, and the run ends with this step.
template <class Call>
void between_steps(const Call& call) {
  const py::gil_scoped_acquire gil;
  try {
    call();
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_KeyboardInterrupt)) throw;
    Interruption::note();
  }
}

// call(): with the GIL released. Where a function that it called was interrupted and it had no way to end well, the
// KeyboardInterrupt is raised after all.
template <class Call>
auto without_gil(const Call& call) {
  const Interruption::Scope scope;
  const InterpreterEnd::Run run;
  try {
    const py::gil_scoped_release released;
    return call();
  } catch (const Error&) {
    if (!Interruption::seen()) throw;
  }
  PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw py::error_already_set();
}

// A copy: what a function keeps stays as it was.
Array array_of(std::span<const double> values);
inline Array array_of(const Vector& values) {
  return array_of(std::span<const double>(values.data(), static_cast<std::size_t>(values.size())));
}
bool is_false(const py::object& answer);  // False, Python's or NumPy's; anything else says nothing
double number_from(const py::object& result, const std::string& what);
// Throws a ValueError where `result` has not `out.size()` numbers.
void copy_from(const py::object& result, std::span<double> out, const std::string& what);
Vector vector_from(const Array& values);  // of any shape

// Tells a Python function how far a run is, ten times a second at most. Made of None it tells nothing.
class Progress {
 public:
  Progress(const py::object& function, double t_end);
  void operator()(double t, std::int64_t steps);

 private:
  std::optional<Callable> function_;
  double t_end_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
};

// Looks for Ctrl-C twenty times a second at most. What another signal handler raises comes out of it.
class SignalCheck {
 public:
  bool operator()();
  bool is_new();  // Ctrl-C since the last call, or the end of the interpreter

 private:
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
  int seen_ = Interruption::count();
};

}  // namespace seiche::python
