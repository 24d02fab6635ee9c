// Where the linear solvers of a system find their options.
#pragma once

#include <petscksp.h>

#include <string>
#include <utility>

namespace seiche {

// Options of the program that begin with a prefix, or those that a case states for itself.
class SolverOptions {
 public:
  explicit SolverOptions(std::string prefix = "seiche_") : prefix_(std::move(prefix)) {}
  // "-ksp_type gmres -pc_type jacobi". Throws Error where it is no list of options.
  static SolverOptions of_text(const std::string& text);

  // So that its options are looked for here, behind the prefix.
  void give_to(KSP ksp, const std::string& further_prefix = "") const;
  bool has(const char* name) const;             // "-ksp_type"
  bool is_true(const char* name) const;         // given without a value, or as true
  std::string written(const char* name) const;  // as a user writes it: "-seiche_ksp_type"
  // Throws Error where the text has an option that no solver has looked for, other than those that begin with `later`.
  // A solver looks when it is set up.
  void require_known(const std::string& later = "") const;

 private:
  std::string prefix_;
  bool is_of_text_ = false;
};

}  // namespace seiche
