#include <seiche/core/base/error.hpp>
#include <seiche/method/splitting/nystrom_scheme.hpp>

#include <cmath>

namespace seiche {
namespace {

// The first halves, without the last b, which makes the sum of all b one; the same for a with the number of flows
// known.
NystromScheme palindrome(std::vector<double> a, std::vector<double> b, std::size_t flows) {
  NystromScheme scheme;
  double rest = 1;
  for (const double x : a) rest -= 2 * x;
  const bool odd = flows % 2 == 1;
  a.push_back(odd ? rest : rest / 2);
  scheme.a = a;
  for (std::size_t i = a.size() - (odd ? 1 : 0); i-- > 0;) scheme.a.push_back(a[i]);
  rest = 1;
  for (const double x : b) rest -= 2 * x;
  b.push_back(odd ? rest / 2 : rest);
  scheme.b = b;
  for (std::size_t i = b.size() - (odd ? 0 : 1); i-- > 0;) scheme.b.push_back(b[i]);
  return scheme;
}

}  // namespace

const NystromScheme& nystrom_scheme(int order) {
  static const NystromScheme four = palindrome({0.245298957184271, 0.604872665711080},
                                               {0.0829844064174052, 0.396309801498368, -0.0390563049223486}, 6);
  static const NystromScheme six =
      palindrome({0.123229775946271, 0.290553797799558, -0.127049212625417, -0.246331761062075, 0.357208872795928},
                 {0.0414649985182624, 0.198128671918067, -0.0400061921041533, 0.0752539843015807, -0.0115113874206879},
                 11);
  if (order == 4) return four;
  if (order == 6) return six;
  throw Error("there are Nyström splittings of order 4 and 6, and none of order {}", order);
}

// A step is a map of (q, p/ω) with determinant one: its powers are bounded as long as |trace| ≤ 2.
double stability_of_kicks(const NystromScheme& scheme) {
  constexpr double spacing = 0.01, largest = 100, resonance = 5e-5;
  const auto half_trace = [&](double x) {
    double trace = 0;
    for (const bool first : {true, false}) {
      double q = first ? 1 : 0;
      double p = first ? 0 : 1;
      for (std::size_t i = 0; i < scheme.b.size(); ++i) {
        p -= scheme.b[i] * x * q;
        if (i < scheme.flows()) q += scheme.a[i] * x * p;
      }
      trace += first ? q : p;
    }
    return trace / 2;
  };
  double x = spacing;
  while (x < largest && std::abs(half_trace(x)) <= 1 + resonance) x += spacing;
  return x - spacing;
}

}  // namespace seiche
