// Many members of one small problem.
#include "bind.hpp"

#include <pybind11/stl.h>
#include <seiche/ensemble/ensemble.hpp>
#include <seiche/ensemble/members.hpp>
#include <seiche/law/law.hpp>

#include <cmath>
#include <limits>

namespace seiche::python {
namespace {

struct HeldEnsemble {
  EnsembleResult result;
  std::vector<EnsembleRecord> records;
  std::vector<std::string> parameters;
  std::vector<std::vector<double>> values;  // of every member
  Index size = 0;
};

void run(HeldEnsemble& held, const std::vector<EnsembleMember>& members, const RunSpec& spec, int threads,
         const py::object& progress) {
  if (spec.tolerance) throw Error("an ensemble takes steps of one size: give h, and no tolerance");
  std::atomic<bool> stop = false;
  SignalCheck signals;
  Progress tell(progress, spec.t_end);
  const EnsembleOptions options{.simulation = simulation_options(spec),
                                .h = spec.h,
                                .t_start = spec.t_start,
                                .t_end = spec.t_end,
                                .energy_every = spec.energy_every,
                                .threads = threads,
                                .promise = [&](const Simulation& s) { return promise_energy_law(s, spec.t_end); },
                                .objection = negative_rate,
                                .on_record = [&](const EnsembleRecord& record) { held.records.push_back(record); },
                                .on_pause =
                                    [&] {
                                      if (signals()) stop = true;
                                      if (held.records.empty()) return;
                                      const double t = held.records.back().t;
                                      tell(t, std::llround((t - spec.t_start) / spec.h));
                                    },
                                .stop = &stop};
  held.size = members.front().problem->size();
  held.result = without_gil([&] { return run_ensemble(members, options); });
}

HeldEnsemble of_case(const RunSpec& spec, int threads, const py::object& progress) {
  Members members = make_members(spec);
  HeldEnsemble held;
  held.parameters = std::move(members.parameters);
  held.values = std::move(members.values);
  run(held, members.list, spec, threads, progress);
  return held;
}

HeldEnsemble of_problems(const std::vector<HeldProblem>& problems, const std::vector<Array>& initial,
                         const RunSpec& spec, int threads, const py::object& progress) {
  std::vector<EnsembleMember> members;
  for (std::size_t i = 0; i < initial.size(); ++i) {
    const HeldProblem& held = problems[problems.size() == 1 ? 0 : i];
    if (held.has_callbacks) threads = 1;
    members.push_back({held.problem, vector_from(initial[i])});
    if (members.back().initial.size() != held.problem->size())
      throw Error("z0 of member {} has {} entries, but the state of {} has {}", i, members.back().initial.size(),
                  held.problem->name, held.problem->size());
  }
  if (members.empty()) throw Error("an ensemble needs a member at least");
  HeldEnsemble held;
  run(held, members, spec, threads, progress);
  return held;
}

template <class Get>
py::array_t<double> of_records(const HeldEnsemble& held, const Get& get) {
  py::array_t<double> values(std::ssize(held.records));
  for (std::size_t i = 0; i < held.records.size(); ++i)
    values.mutable_at(static_cast<py::ssize_t>(i)) = get(held.records[i]);
  return values;
}

py::dict statistics_of(const HeldEnsemble& held, Statistics EnsembleRecord::*energy) {
  struct Part {
    const char* name;
    double Statistics::*value;
  };
  py::dict dict;
  for (const Part& part :
       {Part{"mean", &Statistics::mean}, Part{"std", &Statistics::standard_deviation},
        Part{"min", &Statistics::minimum}, Part{"q05", &Statistics::low}, Part{"median", &Statistics::median},
        Part{"q95", &Statistics::high}, Part{"max", &Statistics::maximum}})
    dict[part.name] = of_records(held, [&](const EnsembleRecord& r) { return r.*energy.*part.value; });
  return dict;
}

template <class Get>
py::list of_members(const HeldEnsemble& held, const Get& get) {
  py::list list;
  for (const MemberResult& member : held.result.members) list.append(get(member));
  return list;
}

py::array_t<double> finals(const HeldEnsemble& held) {  // (members, size); NaN for one that could not start
  py::array_t<double> values({std::ssize(held.result.members), held.size});
  for (std::size_t i = 0; i < held.result.members.size(); ++i) {
    double* row = values.mutable_data(static_cast<py::ssize_t>(i), 0);
    const Vector& z = held.result.members[i].final;
    for (Index j = 0; j < held.size; ++j) row[j] = z.size() > 0 ? z[j] : std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

}  // namespace

void bind_ensembles(py::module_& module) {
  py::class_<HeldEnsemble>(module, "Ensemble")
      .def_property_readonly("t",
                             [](const HeldEnsemble& e) { return of_records(e, [](const auto& r) { return r.t; }); })
      .def_property_readonly("running",
                             [](const HeldEnsemble& e) {
                               return of_records(e, [](const auto& r) { return static_cast<double>(r.running); });
                             })
      .def_property_readonly("H", [](const HeldEnsemble& e) { return statistics_of(e, &EnsembleRecord::H); })
      .def_property_readonly("modified",
                             [](const HeldEnsemble& e) { return statistics_of(e, &EnsembleRecord::modified); })
      .def_property_readonly("y", &finals)
      .def_property_readonly("status",
                             [](const HeldEnsemble& e) {
                               return of_members(e, [](const auto& m) { return to_string(m.report.status); });
                             })
      .def_property_readonly("message",
                             [](const HeldEnsemble& e) {
                               return of_members(e, [](const auto& m) { return m.report.message; });
                             })
      .def_property_readonly("remarks",
                             [](const HeldEnsemble& e) {
                               return of_members(e, [](const auto& m) { return m.report.remarks(); });
                             })
      .def_property_readonly("law",
                             [](const HeldEnsemble& e) {
                               return of_members(e, [](const auto& m) { return to_string(m.report.law); });
                             })
      .def_property_readonly("energy",
                             [](const HeldEnsemble& e) {
                               return of_members(e, [](const auto& m) {
                                 return m.final.size() > 0 ? m.report.energy.final
                                                           : std::numeric_limits<double>::quiet_NaN();
                               });
                             })
      .def_property_readonly("parameters",
                             [](const HeldEnsemble& e) {
                               py::dict dict;
                               for (std::size_t i = 0; i < e.parameters.size(); ++i) {
                                 py::array_t<double> values(std::ssize(e.values));
                                 for (std::size_t m = 0; m < e.values.size(); ++m)
                                   values.mutable_at(static_cast<py::ssize_t>(m)) = e.values[m][i];
                                 dict[py::str(e.parameters[i])] = values;
                               }
                               return dict;
                             })
      .def_property_readonly("side_by_side", [](const HeldEnsemble& e) { return e.result.side_by_side; })
      .def_property_readonly("wall_seconds", [](const HeldEnsemble& e) { return e.result.wall_seconds; });
  module.def("ensemble_of_case", &of_case);
  module.def("ensemble_of_problems", &of_problems);
}

}  // namespace seiche::python
