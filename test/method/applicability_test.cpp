// Which methods apply to which problem, in writing: elsewhere a method that refuses a problem is left out, and would
// vanish without a word.
#include <test/support/cases.hpp>

#include <seiche/method/methods.hpp>

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace seiche::test {
namespace TEST_FILE {

using Names = std::set<std::string>;

struct Refusals {
  Names compositions;  // all methods of these refuse
  Names problems;
};

// Problems that stand nowhere here are taken by all methods.
const std::vector<Refusals> refusals = {
    // Damping that does not multiply all momenta by one constant number: no double commutator that closes.
    {{"chin"},
     {"paper_FPU_2.1", "paper_FPU_2.2", "chain_fixed", "chain_free", "FPUT_beta", "truss", "written_Henon_Heiles",
      "written_Toda"}},
    // One field, which has no momentum.
    {{"chin", "nystrom"}, {"Allen_Cahn", "Cahn_Hilliard_2d", "Swift_Hohenberg", "phase_field_crystal_2d"}},
    // Dashpots between neighbours on a ring: S + Sᵀ ⪯ 0 cannot hold what they do to the mean.
    {{"chin", "whole"}, {"chain_ring"}},
    // Fields without momenta, friction and rates that depend on the place or change in time: neither Dz = D∇H with a
    // constant D, nor a damped linear flow beside kicks.
    {{"chin", "nystrom", "whole"},
     {"paper_gKdV",
      "gKdV_fd4",
      "gKdV_spectral",
      "gKdV_dealiased",
      "NLS_focusing",
      "NLS_2d_mixed",
      "KG_field_rate",
      "KG_field_rate_2d",
      "chain_field_rate",
      "NLS_field_rate",
      "KG_drag",
      "KG_cubic_friction",
      "KG_saturating_friction",
      "chain_drag",
      "truss_isotropic_drag",
      "KG_friction_by_position",
      "Duffing_formula_friction",
      "van_der_Pol",
      "KG_forced",
      "gKdV_forced",
      "written_Kawahara",
      "NLS_written_in_a_trap",
      "gKdV_sigma_1",
      "KG_without_V",
      "KG_varying_damping",
      "FPU_varying_damping",
      "gKdV_varying_damping",
      "coupled_damping",
      "coupled_varying_damping"}},
    // S(z).
    {{"chin", "nystrom", "strang", "strang_exact", "whole"},
     {"Burgers", "KdV_quadratic_fd4", "rigid_body", "Cahn_Hilliard_mobility_fd2", "Cahn_Hilliard_mobility_spectral",
      "Allen_Cahn_mobility"}},
};

Names refusing(const std::string& problem) {
  for (const Refusals& row : refusals)
    if (row.problems.contains(problem)) return row.compositions;
  return {};
}

TEST(Applicability, OfEveryMethodToEveryProblemIsAsWritten) {
  std::size_t met = 0;
  for (const auto& [name, problem] : all_cases()) {
    const Names written = refusing(name);
    met += written.empty() ? 0 : 1;
    for (const MethodEntry& method : methods())
      EXPECT_EQ(applies(method.name, problem), !written.contains(std::string(method.kind.composition)))
          << name << " " << method.name;
  }
  std::size_t rows = 0;
  for (const Refusals& row : refusals) rows += row.problems.size();
  EXPECT_EQ(met, rows) << "a problem of the table is no case any more";
}

}  // namespace TEST_FILE
}  // namespace seiche::test
