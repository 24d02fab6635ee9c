// Diagonal Padé approximation of the exponential: r(x) = N(x)/D(x) with D(x) = N(−x), both of degree q.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/system.hpp>

#include <complex>
#include <vector>

namespace seiche {

// Zeros of D: those with Im p > 0, which stand for their conjugates too, and for odd q one real zero, last. All have
// Re p > 0, so |r| = 1 on the imaginary axis and < 1 to its left. q = 1: p = 2, which is Crank–Nicolson.
std::vector<std::complex<double>> pade_poles(int q);

struct PadePlan {
  int degree;  // q
  int steps;   // equal parts of h
};
// The fewest solves with which |r − exp| stays below `tolerance` on |x| ≤ radius, from the leading term of the error,
// (q!)² / ((2q)! (2q+1)!) |x|^{2q+1} per step.
PadePlan plan_pade(double radius, double tolerance);
// That of propagators: to round-off, or of the degree that the options ask for.
PadePlan plan_exponential(double radius, const SparseOptions& options);

}  // namespace seiche
