// How the planes of a grid along one axis are cut: for sums, and among processes.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <algorithm>
#include <numeric>

namespace seiche {

// So many planes are a unit; those left over join the last. Sums are taken unit by unit and added in the order of
// units, and a process holds whole units: so no sum depends on how many processes there are. Nor does a transform of
// lines, for FFTW computes one line alone in another way than two or more side by side, and a unit has at least two.
struct Units {
  Index planes = 1;   // here
  Index size = 2;     // ≥ 2
  Index of = planes;  // in all processes

  Index count() const {  // every sum asks, and mostly there is one: a division takes as long as twenty products
    if (planes < 2 * size) return planes > 0 ? 1 : 0;
    return planes / size;
  }
  Index begin(Index unit) const { return size * unit; }  // the first plane
  Index end(Index unit) const { return unit + 1 == count() ? planes : size * (unit + 1); }
  Units whole() const { return {of, size, of}; }
};

// Planes side by side.
struct Slab {
  Index first = 0, planes = 0;
};

// Which of so many processes this is.
struct Rank {
  int index = 0, count = 1;
};

// What each process holds of all planes: whole units, which may be none.
inline Slab slab_of(const Units& whole, const Rank& part) {
  const Index units = whole.count();
  const auto first_unit = [&](Index rank) { return units * rank / part.count; };
  const Index begin = first_unit(part.index), end = first_unit(part.index + 1);
  if (begin == end) return {whole.begin(begin), 0};
  return {whole.begin(begin), whole.end(end - 1) - whole.begin(begin)};
}

// Those of one process of the units of all.
inline Units units_of(const Units& units, const Rank& part) {
  return {slab_of(units.whole(), part).planes, units.size, units.of};
}

// The numbers of one field that are here, plane behind plane.
struct FieldPart {
  Index size = 0;
  Units units = {};
  Index first = 0, of = size;  // the number of the whole field that is the first here, and how many those are

  Index plane() const { return of == units.of ? 1 : of / units.of; }
  Index begin(Index unit) const { return units.begin(unit) * plane(); }
  Index end(Index unit) const { return units.end(unit) * plane(); }
  // visit(begin, length) of the parts of a vector of so many numbers that belong to a unit.
  template <class Visit>
  void for_parts(Index numbers, Index unit, const Visit& visit) const {
    if (units.whole().count() == 1) return visit(Index{0}, numbers);
    for (Index at = 0; at < numbers; at += size) visit(at + begin(unit), end(unit) - begin(unit));
  }
};

// Units of so many numbers each that eight lie side by side from their first number on, whatever lies before them.
inline Units units_in_eights(Index planes, Index plane) {
  constexpr Index eight = 8;
  return {.planes = planes, .size = std::max<Index>(eight / std::gcd(eight, plane), 2)};
}

}  // namespace seiche
