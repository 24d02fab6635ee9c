#include <seiche/ensemble/pack.hpp>
#include <seiche/ensemble/row_loops.hpp>

#include <cstdint>

namespace seiche {
namespace {

// f(row, pack) over all rows and the packs of each.
template <class F>
[[gnu::always_inline]] inline void for_packs(Index rows, const F& f) {
  for (Index j = 0; j < rows; ++j) {
#pragma GCC unroll 8
    for (int q = 0; q < packs; ++q) f(j * packs + q, q);
  }
}

[[gnu::always_inline]] inline void keep_larger(const Pack& x, Pack& largest) {
  const Pack size = x < 0 ? -x : x;
  largest = size > largest ? size : largest;
}

[[gnu::always_inline]] inline void put(const Pack (&row)[packs], PanelValues& values) {
  for (int q = 0; q < packs; ++q) packs_of(values.data())[q] = row[q];
}

}  // namespace

SEICHE_MULTIVERSION void scale_rows(const double* in, const PanelValues& factors, Index rows, double* out) {
  const Pack* c = packs_of(factors.data());
  for_packs(
      rows, [&](Index i, int q) __attribute__((always_inline)) { packs_of(out)[i] = c[q] * packs_of(in)[i]; });
}

SEICHE_MULTIVERSION void damp_and_measure(const double* in, RowFactors factors, const double* diagonal, Index rows,
                                          double* out, PanelValues& sum) {
  Pack total[packs] = {};
  for (Index j = 0; j < rows; ++j) {
    const Pack* c = packs_of(factors[j]);
    const Pack* d = packs_of(diagonal + j * panel_members);
    const Pack* from = packs_of(in + j * panel_members);
    Pack* to = packs_of(out + j * panel_members);
#pragma GCC unroll 8
    for (int q = 0; q < packs; ++q) {
      const Pack z = c[q] * from[q];
      total[q] += d[q] * z * z;
      to[q] = z;
    }
  }
  put(total, sum);
}

SEICHE_MULTIVERSION void measure(const double* in, const double* diagonal, Index rows, PanelValues& sum) {
  Pack total[packs] = {};
  for_packs(
      rows, [&](Index i, int q) __attribute__((always_inline)) {
        total[q] += packs_of(diagonal)[i] * packs_of(in)[i] * packs_of(in)[i];
      });
  put(total, sum);
}

SEICHE_MULTIVERSION void extrapolate_rows(const double* a, const double* b, const double* c, double weight,
                                          double ratio, Index rows, double* out, PanelValues& second_difference) {
  Pack total[packs] = {};
  for_packs(
      rows, [&](Index i, int q) __attribute__((always_inline)) {
        const Pack last = packs_of(b)[i], change = packs_of(a)[i] - last;
        const Pack second = change - ratio * (last - packs_of(c)[i]);
        packs_of(out)[i] = packs_of(a)[i] + weight * change;
        total[q] += second * second;
      });
  put(total, second_difference);
}

SEICHE_MULTIVERSION void sum_squared_distances(const double* a, const double* b, Index rows, PanelValues& sum) {
  Pack total[packs] = {};
  for_packs(
      rows, [&](Index i, int q) __attribute__((always_inline)) {
        const Pack apart = packs_of(a)[i] - packs_of(b)[i];
        total[q] += apart * apart;
      });
  put(total, sum);
}

SEICHE_MULTIVERSION void damp_rows(RowFactors factors, Index rows, double* values) {
  for (Index j = 0; j < rows; ++j) {
    const Pack* c = packs_of(factors[j]);
    Pack* to = packs_of(values + j * panel_members);
#pragma GCC unroll 8
    for (int q = 0; q < packs; ++q) to[q] *= c[q];
  }
}

SEICHE_MULTIVERSION void find_not_finite(const double* in, Index rows, PanelValues& flags) {
  Pack total[packs] = {};
  for_packs(
      rows, [&](Index i, int q) __attribute__((always_inline)) { total[q] += 0.0 * packs_of(in)[i]; });
  put(total, flags);
}

SEICHE_MULTIVERSION void add_and_compare(const double* a, const double* b, const double* other, Index rows, double* sum,
                                         PanelValues& distance, PanelValues& size, PanelValues& added) {
  Pack distances[packs] = {}, sizes[packs] = {}, of_b[packs] = {};
  for_packs(
      rows, [&](Index i, int q) __attribute__((always_inline)) {
        const Pack adds = packs_of(b)[i], here = packs_of(a)[i] + adds;
        keep_larger(here - packs_of(other)[i], distances[q]);
        keep_larger(here, sizes[q]);
        keep_larger(adds, of_b[q]);
        packs_of(sum)[i] = here;
      });
  put(distances, distance);
  put(sizes, size);
  put(of_b, added);
}

SEICHE_MULTIVERSION void copy_members(const double* in, const PanelValues& mask, Index rows, double* out) {
  const Pack* chosen = packs_of(mask.data());
  for_packs(
      rows, [&](Index i, int q) __attribute__((always_inline)) {
        packs_of(out)[i] = chosen[q] != 0 ? packs_of(in)[i] : packs_of(out)[i];
      });
}

}  // namespace seiche
