// The list of backends. One row is one backend, and holds all that is said of it.
#pragma once

#include <seiche/core/system.hpp>

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

struct BackendEntry {
  std::string_view name;
  std::string_view summary;
  System (*system)(const Problem& problem, const BackendOptions& options);
  bool has_modes = false;               // one small block per mode
  bool exponentials_by_krylov = false;  // or by factors, and not by tables: each costs many gradients
  bool takes_one_thread = false;        // of a program, and no other beside it
  // Bytes that a run on it keeps beside what its method does, with the factors of so many step sizes; null: nothing
  // worth counting.
  double (*bytes)(const Problem& problem, double factored) = nullptr;
};

std::span<const BackendEntry> backends();
// By libraries that are loaded when they are asked for: theirs may be missing, which `system` then says by an Error.
std::span<const BackendEntry> loaded_backends();
std::vector<std::string> backend_names();                 // of all
const BackendEntry& find_backend(std::string_view name);  // throws Error with the nearest name

// What `auto` stands for: a stored table of sizes, never a timing. by_kicks: for a method that asks for no exponential,
// so that differences on a grid are best left as they are.
const BackendEntry& automatic_backend(const Problem& problem, bool by_kicks = false);

// Name and version of each library the backends stand on.
std::map<std::string, std::string> backend_library_versions();

// What FFTW has learnt by measuring plans, as text: a run that starts from the same text plans the same way.
std::string planning_wisdom();
void use_planning_wisdom(const std::string& wisdom);  // text that is no wisdom is ignored

}  // namespace seiche
