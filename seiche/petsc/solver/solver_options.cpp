#include <seiche/petsc/solver/petsc_call.hpp>
#include <seiche/petsc/solver/solver_options.hpp>

#include <fmt/format.h>

#include <map>

namespace seiche {

// Objects inside a solver look for their options among those of the program alone, where each text has a prefix.
SolverOptions SolverOptions::of_text(const std::string& text) {
  if (const auto first = text.find_first_not_of(" \t\n"); first == std::string::npos || text[first] != '-')
    throw Error("backend.solver = \"{}\" must be a list of options of PETSc, such as \"-ksp_type gmres -pc_type ilu\"",
                text);
  static std::map<std::string, std::string> prefixes;
  const auto [place, is_new] = prefixes.emplace(text, fmt::format("seiche_case_{}_", prefixes.size() + 1));
  SolverOptions options(place->second);
  options.is_of_text_ = true;
  if (!is_new) return options;
  require(PetscOptionsPrefixPush(nullptr, options.prefix_.c_str()));
  const PetscErrorCode code = PetscOptionsInsertString(nullptr, text.c_str());
  require(PetscOptionsPrefixPop(nullptr));
  if (code != 0) prefixes.erase(place);
  require(code);
  return options;
}

void SolverOptions::give_to(KSP ksp, const std::string& further_prefix) const {
  require(KSPSetOptionsPrefix(ksp, (prefix_ + further_prefix).c_str()));
}

bool SolverOptions::has(const char* name) const {
  PetscBool has = PETSC_FALSE;
  require(PetscOptionsHasName(nullptr, prefix_.c_str(), name, &has));
  return has == PETSC_TRUE;
}

bool SolverOptions::is_true(const char* name) const {
  PetscBool is = PETSC_FALSE;
  require(PetscOptionsGetBool(nullptr, prefix_.c_str(), name, &is, nullptr));
  return is == PETSC_TRUE;
}

std::string SolverOptions::written(const char* name) const {
  return fmt::format("-{}{}", is_of_text_ ? "" : prefix_, name + 1);
}

void SolverOptions::require_known(const std::string& later) const {
  if (!is_of_text_) return;
  PetscInt count = 0;
  char** names = nullptr;
  char** values = nullptr;
  require(PetscOptionsLeftGet(nullptr, &count, &names, &values));
  std::string unknown;
  for (PetscInt i = 0; i < count && unknown.empty(); ++i)
    if (const std::string name = names[i];
        name.starts_with(prefix_) && (later.empty() || !name.starts_with(prefix_ + later)))
      unknown = name.substr(prefix_.size());
  require(PetscOptionsLeftRestore(nullptr, &count, &names, &values));
  if (!unknown.empty()) throw Error("no linear solver here looks for the option -{} of backend.solver", unknown);
}

}  // namespace seiche
