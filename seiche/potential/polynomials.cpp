#include <seiche/core/base/error.hpp>
#include <seiche/potential/bond.hpp>
#include <seiche/potential/modulus.hpp>
#include <seiche/potential/nodal.hpp>
#include <seiche/potential/polynomials.hpp>

#include <algorithm>

namespace seiche {
namespace {

using Pointer = std::shared_ptr<const PointwisePotential>;

// The degree becomes a compile-time number, so that the loops over coefficients unroll: the next of 1 … 6, 8, 12, 16,
// with zeros for the highest coefficients, which leave every bit of a value as it is.
template <int Most = 1, class Make>
Pointer with_degree(const std::vector<double>& c, const Make& make) {
  if (static_cast<int>(c.size()) > Most + 1) {
    constexpr int exact = Polynomial<Most>::most_exact;
    constexpr int next = Most < exact ? Most + 1 : Most == exact ? Most + 2 : Most + 4;
    if constexpr (Most < max_polynomial_degree) return with_degree<std::min(next, max_polynomial_degree)>(c, make);
    throw Error("a polynomial potential of degree {} is asked for; up to {} is allowed", c.size() - 1,
                max_polynomial_degree);
  }
  Polynomial<Most> w;
  std::copy(c.begin(), c.end(), w.c.begin());
  w.last = std::max(static_cast<int>(c.size()) - 1, 1);
  return make(w);
}

}  // namespace

Pointer nodal_polynomial(const std::vector<double>& c) {
  return with_degree(c, [](auto w) -> Pointer { return std::make_shared<NodalPotential<decltype(w)>>(w); });
}

Pointer bond_polynomial(const std::vector<double>& c, Boundary boundary) {
  return with_degree(c, [boundary](auto w) -> Pointer {
    return std::make_shared<BondPotential<decltype(w)>>(w, boundary);
  });
}

Pointer modulus_polynomial(const std::vector<double>& c) {
  return with_degree(c, [](auto w) -> Pointer { return std::make_shared<ModulusPotential<decltype(w)>>(w); });
}

std::vector<double> monomial(double c, int d) {
  std::vector<double> coefficients(static_cast<std::size_t>(d) + 1, 0.0);
  coefficients.back() = c;
  return coefficients;
}

}  // namespace seiche
