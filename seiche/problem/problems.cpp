#include <seiche/core/base/error.hpp>
#include <seiche/core/base/listed.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/beta_fpu.hpp>
#include <seiche/problem/burgers.hpp>
#include <seiche/problem/chain.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/gradient_flow/pattern_formation.hpp>
#include <seiche/problem/gradient_flow/phase_separation.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/network.hpp>
#include <seiche/problem/nls.hpp>
#include <seiche/problem/oscillator.hpp>
#include <seiche/problem/problems.hpp>
#include <seiche/problem/rigid_body.hpp>
#include <seiche/problem/sine_gordon.hpp>
#include <seiche/problem/sparse.hpp>
#include <seiche/problem/truss.hpp>
#include <seiche/problem/variable_wave.hpp>

namespace seiche {

std::span<const ProblemEntry> problems() {
  static const std::vector<ProblemEntry> list = {
      klein_gordon_entry(),  alpha_fpu_entry(),       gkdv_entry(),
      sine_gordon_entry(),   oscillator_entry(),      nls_entry(),
      beta_fpu_entry(),      chain_entry(),           variable_wave_entry(),
      truss_entry(),         network_entry(),         sparse_entry(),
      burgers_entry(),       rigid_body_entry(),      allen_cahn_entry(),
      cahn_hilliard_entry(), swift_hohenberg_entry(), phase_field_crystal_entry(),
  };
  return list;
}

std::vector<std::string> problem_names() { return names_of(problems()); }

const ProblemEntry& find_problem(std::string_view name) {
  if (const ProblemEntry* entry = find_row(problems(), name)) return *entry;
  throw unknown_name("problem", name, problem_names());
}

}  // namespace seiche
