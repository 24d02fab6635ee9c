// The claims that are not about one example: the theorems as experiments, solvers, tolerances, the reference.
#pragma once

#include <paper/evidence.hpp>
#include <paper/findings.hpp>
#include <paper/results.hpp>

#include <vector>

namespace seiche {

Finding law_of_seisav(const Evidence& evidence);
Finding law_of_seilm(const Evidence& evidence);
Finding laws_without_damping(const std::vector<LawCheck>& checks, bool conserved);
Finding exact_energy_decays(const Evidence& evidence);
Finding only_where_a_gradient_form_exists(const Evidence& evidence);
Finding paper_reference_suffices(const PaperResults& results, const Evidence& evidence);
Finding absolute_tolerance_is_enough(const Evidence& evidence);
Finding efficient_at_any_tolerance(const PaperResults& results);
Finding competitive(const PaperResults& results);  // SEISAV is ahead of earlier methods everywhere
Finding needs_no_iteration(const PaperResults& results);
Finding multiplier_is_cheap(const PaperResults& results, const Evidence& evidence);
// Example 3 with μ = 0.1: the printed SEILM against the repaired one, and what is due to Newton's iteration alone.
Finding printed_multiplier_is_fragile(const ExampleResult& example, const ExampleEvidence& evidence);
Finding newton_is_the_cause(const ExampleResult& example, const ExampleEvidence& evidence);

}  // namespace seiche
