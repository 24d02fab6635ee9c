// The numerical damping: the decay and the frequency that one step of a method gives each mode of the linear part,
// against those of the equation.
#pragma once

#include <seiche/simulation/simulation.hpp>
#include <seiche/study/spectrum_output.hpp>

#include <atomic>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

// One mode: a pair of conjugate eigenvalues, or a single one. With λ of L = SM − D and ρ of the step z ↦ Rz of length
// h,
//   exact     decay −Re λ,        frequency |Im λ|
//   numerical decay −ln|ρ| / h,   frequency arg ρ / h, of the branch next to the exact one
struct SpectrumRow {
  std::string mode;  // "3", "(3, -1)" by the wave numbers of the grid, or by frequency where there is no grid of modes
  double exact_decay = 0.0, numerical_decay = 0.0;          // 1/time; infinite where ρ = 0
  double exact_frequency = 0.0, numerical_frequency = 0.0;  // radians per time, ≥ 0 but for a step that turns back
  bool aliased = false;    // exact frequency above π/h: one step tells the numerical one only modulo 2π/h
  double round_off = 0.0;  // of a decay or a frequency, in 1/time
  bool resolved = true;    // false: of the mode a step leaves no more than round-off, and its rates are not known

  double damping_error() const { return numerical_decay - exact_decay; }
  bool damping_differs() const;               // by more than round-off
  std::optional<double> phase_error() const;  // relative; nothing where the exact frequency is 0
};

struct Spectrum {
  std::string problem, method, backend;
  double h = 0.0;
  bool rates_at_start = false;    // γ varies in time, and was taken at t = 0
  bool has_potential = false;     // V was left out
  bool has_drives = false;        // and so were friction beyond linear, forces, or what of S changes with z
  bool is_homogeneous = true;     // R(2z) = 2Rz
  bool is_linear = true;          // and R(y + z) = Ry + Rz: else each mode was stepped alone
  std::vector<SpectrumRow> rows;  // in the order of the modes
};

// Systems without a grid of modes (matrices, γ(x)) need the eigenvectors of a full matrix, and take up to this many
// unknowns; steps that are not linear go one mode at a time.
inline constexpr Index spectrum_matrix_limit = 2048;
inline constexpr Index spectrum_single_mode_limit = 16384;

// Throws Error where the method does not apply to `problem`, and above these limits; std::runtime_error where a step
// fails. `stop` ends it with an Error, between two modes or steps; the eigenvectors of a full matrix are found without
// a look at it.
Spectrum spectrum(const Problem& problem, const SimulationOptions& options, double h,
                  const std::atomic<bool>* stop = nullptr);

// What the rows come to.
struct SpectrumVerdict {
  const SpectrumRow* most_spurious = nullptr;   // decays most beyond the exact rate; null: none beyond round-off
  const SpectrumRow* most_missing = nullptr;    // the same below it
  const SpectrumRow* worst_relative = nullptr;  // of the modes with exact damping: the largest |error| / exact rate
  const SpectrumRow* worst_phase = nullptr;
  double relative = 0.0;   // that of worst_relative
  double round_off = 0.0;  // the largest, of the rates
  std::size_t aliased = 0, unresolved = 0;
  // True if every mode is known to decay as in the equation.
  bool is_physical() const { return most_spurious == nullptr && most_missing == nullptr && unresolved == 0; }
};
SpectrumVerdict judge(const Spectrum& spectrum);  // points into `spectrum`

}  // namespace seiche
