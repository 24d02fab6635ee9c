// What is done to whole panels element by element. Pointers to the first row.
#pragma once

#include <seiche/core/simd/panel.hpp>

namespace seiche {

// One factor for every member of every row, in `factors`: that of its field.
using RowFactors = const double* const*;

// out = factor · in, and Σ d · out² with one row of `diagonal` for each.
void damp_and_measure(const double* in, RowFactors factors, const double* diagonal, Index rows, double* out,
                      PanelValues& sum);
// Σ d · in²
void measure(const double* in, const double* diagonal, Index rows, PanelValues& sum);
void damp_rows(RowFactors factors, Index rows, double* values);
// out = a + weight·(a − b), and the squared length of a − b − ratio·(b − c)
void extrapolate_rows(const double* a, const double* b, const double* c, double weight, double ratio, Index rows,
                      double* out, PanelValues& second_difference);
void sum_squared_distances(const double* a, const double* b, Index rows, PanelValues& sum);
void scale_rows(const double* in, const PanelValues& factors, Index rows, double* out);  // out may be in
// Each member: 0 if all its numbers are finite, else NaN.
void find_not_finite(const double* in, Index rows, PanelValues& flags);
// sum = a + b, and the max norms of sum − other, sum and b, but for NaN
void add_and_compare(const double* a, const double* b, const double* other, Index rows, double* sum,
                     PanelValues& distance, PanelValues& size, PanelValues& added);
// Members with mask ≠ 0 of `in` go to `out`.
void copy_members(const double* in, const PanelValues& mask, Index rows, double* out);

}  // namespace seiche
