// What the verdicts rest on beside the data of the figures.
#pragma once

#include <paper/results.hpp>

#include <string>
#include <vector>

namespace seiche {

struct ExampleEvidence {
  std::string key;
  double initial_energy = 0.0;
  double max_reference_increase = 0.0;  // max H(t_{k+1}) − H(t_k) of the reference
  double reference_energy_error = 0.0;
  double initial_potential = 0.0;          // V(z₀)
  double share_of_tiny_potential = 0.0;    // of the run: |V(z(t))| < 1e-15, where the paper's tolerance tests nothing
  double seisav_modified_gap = 0.0;        // max |H̃ − H| at the step size of the curves
  std::vector<std::string> refused;        // methods that do not apply
  std::vector<StudyRow> others;            // schemes beside the paper's eight, not timed; see `studied_beside`
  double seavf_reference_distance = -1.0;  // of the paper's reference from ours, over a short time; < 0: not measured
  double seavf_reference_end = 0.0;        // that time
};

// Runs of one scheme at step sizes from small to very large, each judged by its energy law.
struct LawCheck {
  std::string scheme;
  int runs = 0;
  int held = 0;                // reached the end, and the energy never rose beyond round-off
  int failed = 0;              // ended early with a message, no unlawful step accepted
  double largest_rise = 0.0;   // of the energy of the law, relative to |H(z₀)|
  double largest_drift = 0.0;  // max |E(zⁿ) − E(z₀)| / |E(z₀)|: for systems that should conserve it
  long long steps = 0;
  long long unresolved = 0;  // scalar equations whose root was not found
};

struct Evidence {
  std::vector<ExampleEvidence> examples;
  std::vector<LawCheck> seisav_laws, seilm_laws;  // all examples together, one entry per variant of the scheme
  std::vector<LawCheck> conserved;                // D = 0, S skew
  std::vector<LawCheck> dissipated;               // D = 0, sym(S) ⪯ 0
  // sym(MD) ⪰ 0, but not ECLD: gKdV with σ = 1 near a constant state.
  double without_ecld_exact_rise = 0.0;  // max of H(z(t)) − H(z₀) of the reference, relative to |H(z₀)|
  std::vector<StudyRow> without_ecld;    // seilm and seisav there, repaired and as printed
};

}  // namespace seiche
