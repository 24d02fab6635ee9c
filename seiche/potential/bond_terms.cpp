#include <seiche/potential/bond_terms.hpp>

namespace seiche {

std::vector<TermsOfPotential> bond_terms(const std::shared_ptr<const PointwisePotential>& free, Boundary boundary,
                                         Index first, Index count, Index of) {
  if (count == 0) return {};
  const bool is_ring = boundary == Boundary::periodic, is_held = boundary == Boundary::dirichlet;
  TermsOfPotential own{.points = {}, .potential = free};
  if (is_held && first == 0) own.points.push_back(TermsOfPotential::held);
  for (Index point = first; point < first + count; ++point) own.points.push_back(point);
  if (first + count < of)
    own.points.push_back(first + count);
  else if (is_ring)
    own.points.push_back(0);
  else if (is_held)
    own.points.push_back(TermsOfPotential::held);
  std::vector<TermsOfPotential> terms = {std::move(own)};
  if (first > 0 || (is_ring && count < of))
    terms.push_back({.points = {first > 0 ? first - 1 : of - 1, first}, .potential = free, .is_counted = false});
  return terms;
}

}  // namespace seiche
