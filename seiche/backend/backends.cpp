#include <seiche/backend/backends.hpp>
#include <seiche/backend/dense/dense.hpp>
#include <seiche/backend/modal/modal.hpp>
#include <seiche/backend/reference/reference.hpp>
#include <seiche/backend/sparse/sparse.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/listed.hpp>
#include <seiche/core/base/loaded_library.hpp>

#include <fftw3.h>

#include <array>
#include <cstdlib>

namespace seiche {
namespace {

constexpr std::array list = {
    BackendEntry{.name = "dense",
                 .summary = "full matrices in physical coordinates: the fastest for a few unknowns",
                 .system = dense_system},
    BackendEntry{.name = "modal",
                 .summary = "Fourier or sine coefficients, one small block per mode: exact and fast on grids",
                 .system = modal_system,
                 .has_modes = true,
                 .bytes = modal_bytes},
    BackendEntry{.name = "sparse",
                 .summary = "sparse matrices: coefficients that change from point to point, and graphs",
                 .system = sparse_system,
                 .exponentials_by_krylov = true,
                 .bytes = sparse_bytes},
    BackendEntry{.name = "reference",
                 .summary = "full matrices, one product after the other: what the others are compared with, and slow",
                 .system = reference_system},
};

System petsc_system_of(const Problem& problem, const BackendOptions& options) {
  using Make = System*(const Problem&, const BackendOptions&);
  static Make* const make = reinterpret_cast<Make*>(
      function_of_library("libseiche_ts.so", "seiche_petsc_version", "seiche_petsc_system", {"../.."}));
  if (make == nullptr)
    throw Error(
        "the backend \"petsc\" is not here: this copy of Seiche was built without PETSc (scripts/install-deps --petsc); use "
        "\"sparse\"");
  const std::unique_ptr<System> system(make(problem, options));
  return std::move(*system);
}

constexpr std::array loaded_list = {
    BackendEntry{.name = "petsc",
                 .summary = "the same by PETSc's matrices and solvers, on any number of processes",
                 .system = petsc_system_of,
                 .exponentials_by_krylov = true,
                 .takes_one_thread = true,
                 .bytes = sparse_bytes},
};

}  // namespace

std::span<const BackendEntry> backends() { return list; }
std::span<const BackendEntry> loaded_backends() { return loaded_list; }

std::vector<std::string> backend_names() {
  std::vector<std::string> names = names_of(backends());
  for (const BackendEntry& entry : loaded_backends()) names.emplace_back(entry.name);
  return names;
}

const BackendEntry& find_backend(std::string_view name) {
  for (const std::span<const BackendEntry> rows : {backends(), loaded_backends()})
    if (const BackendEntry* entry = find_row(rows, name)) return *entry;
  std::vector<std::string> allowed = backend_names();
  allowed.emplace_back("auto");
  throw unknown_name("backend", name, allowed);
}

const BackendEntry& automatic_backend(const Problem& problem, bool by_kicks) {
  const Index dense_up_to = problem.matrices ? 48 : 24;  // unknowns; docs/performance.md has the measurement
  if (by_kicks && has_grid_kicks(problem)) return find_backend("sparse");
  if (problem.size() <= dense_up_to) return find_backend("dense");
  if (!problem.matrices && problem.grid.unknowns() == 1) return find_backend("dense");  // there are no modes
  return find_backend(problem.matrices ? "sparse" : "modal");
}

std::map<std::string, std::string> backend_library_versions() {
  return {{"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"fftw", fftw_version}};
}

std::string planning_wisdom() {
  const std::unique_ptr<char, decltype(&std::free)> text(fftw_export_wisdom_to_string(), &std::free);
  return text ? text.get() : "";
}

void use_planning_wisdom(const std::string& wisdom) { fftw_import_wisdom_from_string(wisdom.c_str()); }

}  // namespace seiche
