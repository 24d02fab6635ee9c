// Problems: from a case, or by parts.
#include "bind.hpp"

#include <pybind11/stl.h>
#include <seiche/config/case/case_file.hpp>
#include <seiche/config/custom/field_potential.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/output/solution_layout.hpp>
#include <seiche/potential/own_potential.hpp>
#include <seiche/problem/problems.hpp>
#include <seiche/problem/sparse.hpp>

#include <map>
#include <optional>
#include <string>

namespace seiche::python {
namespace {

// A matrix in compressed columns, as scipy.sparse.csc_matrix has it.
struct Columns {
  Index rows, columns;
  Array values;
  py::array_t<int, py::array::c_style | py::array::forcecast> row_of, start_of;
};

SparseMatrix matrix_from(const py::tuple& parts) {
  const Columns c{parts[0].cast<Index>(), parts[1].cast<Index>(), parts[2].cast<Array>(),
                  parts[3].cast<decltype(Columns::row_of)>(), parts[4].cast<decltype(Columns::start_of)>()};
  const Eigen::Map<const SparseMatrix> map(c.rows, c.columns, c.values.size(), c.start_of.data(), c.row_of.data(),
                                           c.values.data());
  SparseMatrix matrix = map;
  matrix.makeCompressed();
  return matrix;
}

RatePointer rate_from(const py::object& gamma) {
  if (gamma.is_none()) return nullptr;
  if (!py::isinstance<py::str>(gamma)) return constant_rate(number_from(gamma, "gamma"));
  const auto text = gamma.cast<std::string>();
  try {
    return formula_rate(compile_formula(text, {"t"}));
  } catch (const Error& error) {
    throw Error("gamma: {}", error.what());
  }
}

OwnPotential potential_from(const py::object& value, const py::object& gradient, bool grows_outward) {
  const Callable V(value);
  const Callable dV(gradient);
  return {.value =
              [V](std::span<const double> u) {
                return with_gil([&] { return number_from(V.get()(array_of(u)), "V"); });
              },
          .gradient =
              [dV](std::span<const double> u, std::span<double> out) {
                with_gil([&] { return copy_from(dV.get()(array_of(u)), out, "gradient"), 0; });
              },
          .grows_outward = grows_outward};
}

HeldProblem by_parts(Index fields, const py::tuple& M, const std::optional<py::tuple>& S,
                     const std::optional<py::tuple>& D, const py::object& gamma, const py::object& V,
                     const py::object& gradient, bool grows_outward, const std::optional<Array>& z0) {
  SparseSystem system{.fields = fields, .matrices = {}, .gamma = rate_from(gamma)};
  system.matrices.M = matrix_from(M);
  if (S) system.matrices.S = matrix_from(*S);
  if (D) system.matrices.D = matrix_from(*D);
  Problem problem = sparse_problem(std::move(system));
  problem.name = "the problem";
  problem.initial.setZero();
  if (z0) {
    problem.initial = vector_from(*z0);
    if (problem.initial.size() != problem.size())
      throw Error("z0 has {} entries, but M is {} × {}", problem.initial.size(), problem.size(), problem.size());
  }
  if (py::isinstance<py::str>(V)) {
    if (!gradient.is_none()) throw Error("V is a formula, whose gradient is known: leave gradient out");
    problem.potential = point_potential("V", V.cast<std::string>(), {"u"}, grows_outward);
    return {std::make_shared<const Problem>(std::move(problem))};
  }
  if (V.is_none() != gradient.is_none())
    throw Error("V and gradient come together: a function V(u) → number, and gradient(u) → array");
  if (!V.is_none()) {
    problem.potential = own_potential(potential_from(V, gradient, grows_outward));
    const auto u = static_cast<std::size_t>(problem.grid.unknowns());
    const std::string complaint = without_gil([&] {
      return problem.potential->complaint({problem.initial.data(), u});
    });
    if (Interruption::seen()) {  // in a function that was only being tried
      PyErr_SetNone(PyExc_KeyboardInterrupt);
      throw py::error_already_set();
    }
    if (!complaint.empty()) throw Error(complaint);
  }
  return {std::make_shared<const Problem>(std::move(problem)), !V.is_none()};
}

py::list axes_of(const Grid& grid) {
  py::list axes;
  for (const GridAxis& axis : grid.axes) {
    const bool is_cut = grid.here.count > 1 && axes.empty();  // axis 0, of which a process holds some planes
    const FieldPart part = grid.field();
    const Index first = is_cut ? part.first / part.plane() : 0;
    py::array_t<double> x(is_cut ? part.units.planes : axis.unknowns());
    for (Index i = 0; i < x.size(); ++i) x.mutable_at(i) = axis.x(first + i);
    axes.append(x);
  }
  return axes;
}

// Names and meanings, as solution.h5 has them.
py::dict layout_of(const Problem& problem) {
  using namespace pybind11::literals;
  const SolutionLayout layout = solution_layout(problem);
  std::vector<std::string> meanings;
  for (const ProblemEntry& entry : problems())
    if (entry.name == problem.name && entry.fields == problem.fields) meanings = entry.meanings;
  py::list fields, axes;
  for (std::size_t f = 0; f < layout.fields.size(); ++f)
    fields.append(py::make_tuple(layout.fields[f], f < meanings.size() ? meanings[f] : "field " + layout.fields[f]));
  for (const SolutionAxis& axis : layout.axes) axes.append(py::make_tuple(axis.name, axis.meaning));
  return py::dict("fields"_a = fields, "axes"_a = axes);
}

// Every key of [problem] with one value, and the numbers that formulas name, as a case file writes them; "1/3" and
// "pi/4" as their numbers.
std::map<std::string, std::string> numbers_of(const RunSpec& spec) {
  std::map<std::string, std::string> texts(spec.parameter_texts.begin(), spec.parameter_texts.end());
  for (auto& [name, text] : texts) {
    if (is_toml_number(text)) continue;
    try {
      text = toml_real((*compile_formula(text, {}, formula_constants(spec)))({}));
    } catch (const Error&) {  // a name, or a formula in t
    }
  }
  if (spec.custom)
    for (const auto& [name, value] : spec.custom->parameters) texts[name] = toml_real(value);
  return texts;
}

}  // namespace

void bind_problems(py::module_& module) {
  py::class_<HeldProblem>(module, "Problem")
      .def_property_readonly("name", [](const HeldProblem& p) { return p.problem->name; })
      .def_property_readonly("fields", [](const HeldProblem& p) { return p.problem->fields; })
      .def_property_readonly("size", [](const HeldProblem& p) { return p.problem->size(); })
      .def_property_readonly("axes", [](const HeldProblem& p) { return axes_of(p.problem->grid); })
      .def_property_readonly("layout", [](const HeldProblem& p) { return layout_of(*p.problem); })
      .def("part",
           [](const HeldProblem& p, int rank, int count) {
             return HeldProblem{std::make_shared<const Problem>(part_of(*p.problem, {rank, count})), p.has_callbacks};
           })
      .def_property_readonly("z0", [](const HeldProblem& p) { return array_of(p.problem->initial); })
      .def_property_readonly("notes", [](const HeldProblem& p) { return p.problem->notes; });

  py::class_<RunSpec>(module, "Case")
      .def_readonly("problem", &RunSpec::problem)
      .def_readonly("method", &RunSpec::method)
      .def_readonly("h", &RunSpec::h)
      .def_readonly("tolerance", &RunSpec::tolerance)
      .def_readonly("h_is_default", &RunSpec::h_is_default)
      .def_readonly("h_max", &RunSpec::h_max)
      .def_readonly("backend", &RunSpec::backend)
      .def_readonly("t_start", &RunSpec::t_start)
      .def_readonly("t_end", &RunSpec::t_end)
      .def_readonly("ledger", &RunSpec::ledger)
      .def_readonly("output_directory", &RunSpec::output_directory)
      .def_readonly("notes", &RunSpec::notes)
      .def("gives", [](const RunSpec& spec, const std::string& key) { return spec.places.contains(key); })
      .def_property_readonly("parameters", &numbers_of)
      .def_property_readonly("is_ensemble", [](const RunSpec& spec) { return spec.ensemble.has_value(); })
      .def("text", &write_case);

  module.def("parse_case",
             [](const std::string& text, const std::string& name, const std::vector<std::string>& overrides,
                const std::string& folder) { return parse_case(text, name, overrides, folder); });
  module.def("case_text", [](const std::string& file) { return py::bytes(case_text(file)); });
  module.def(
      "make_problem",
      [](const RunSpec& spec, int rank, int count) {
        return HeldProblem{std::make_shared<const Problem>(make_problem(spec, {rank, count}))};
      },
      py::arg("case"), py::arg("rank") = 0, py::arg("count") = 1);
  module.def("problem_by_parts", &by_parts);
}

}  // namespace seiche::python
