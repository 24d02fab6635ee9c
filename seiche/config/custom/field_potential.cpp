#include <seiche/config/custom/field_potential.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/potential/on_bonds.hpp>
#include <seiche/potential/polynomials.hpp>

#include <fmt/ranges.h>

namespace seiche {
namespace {

bool fits(const std::vector<double>& polynomial) {
  return !polynomial.empty() && polynomial.size() <= max_polynomial_degree + 1;
}

}  // namespace

std::shared_ptr<const PointwisePotential> point_potential(const FieldFormula& f, const Grid& grid) {
  if (fits(f.polynomial)) return nodal_polynomial(f.polynomial);
  if (fits(f.of_modulus)) return modulus_polynomial(f.of_modulus);
  return formula_potential(f.w, grid);
}

std::shared_ptr<const PointwisePotential> bond_potential(const FieldFormula& f, const Grid& grid) {
  const Boundary boundary = grid.axis(0).boundary;
  if (fits(f.polynomial)) return bond_polynomial(f.polynomial, boundary);
  return on_bonds(formula_potential(f.w, grid), boundary);
}

std::shared_ptr<const PointwisePotential> point_potential(const std::string& key, const std::string& text,
                                                          const std::vector<std::string>& fields, bool grows_outward) {
  EnergySplit split = split_energy(key, text, {.fields = fields}, {}, {.found = false});
  if (split.per_point.empty()) return nullptr;
  FieldFormula& f = split.per_point.front();
  if (f.count != static_cast<Index>(fields.size()))
    throw Error("{} = \"{}\" does not name all of the fields {}", key, shortened(text), fmt::join(fields, ", "));
  if (grows_outward) f.w.grows_outward = true;
  return point_potential(f, Grid{});
}

}  // namespace seiche
