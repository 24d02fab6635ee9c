#include <seiche/formula/expansion.hpp>
#include <seiche/formula/formula_parser.hpp>

#include <algorithm>

namespace seiche {
namespace {

double bits_of_number(const Expression& number) {
  if (!GiNaC::is_a<GiNaC::numeric>(number) || !number.info(GiNaC::info_flags::rational)) return 0;
  const auto& x = GiNaC::ex_to<GiNaC::numeric>(number);
  return x.numer().int_length() + x.denom().int_length();
}

// At most so many terms stand in it when it is multiplied out: C(n + m − 1, n) in the n-th power of m terms.
double terms_multiplied_out(const Expression& expression) {
  double terms = 1;
  if (GiNaC::is_a<GiNaC::add>(expression)) {
    terms = 0;
    for (const Expression& term : expression) terms += terms_multiplied_out(term);
  } else if (GiNaC::is_a<GiNaC::mul>(expression)) {
    for (const Expression& factor : expression) terms *= terms_multiplied_out(factor);
  } else if (GiNaC::is_a<GiNaC::power>(expression) && expression.op(1).info(GiNaC::info_flags::posint)) {
    const double m = terms_multiplied_out(expression.op(0));
    const double n = GiNaC::ex_to<GiNaC::numeric>(expression.op(1)).to_double();
    for (double k = 1; k <= n && m > 1; ++k) terms *= (m - 1 + k) / k;
  }
  return terms;
}

}  // namespace

double bits_of(const Expression& base) {
  double bits = bits_of_number(base);
  for (std::size_t i = 0; GiNaC::is_a<GiNaC::mul>(base) && i < base.nops(); ++i) bits += bits_of_number(base.op(i));
  return bits;
}

bool is_small_polynomial(const Expression& expression, const GiNaC::lst& symbols, const Symbols& beside) {
  if (!expression.is_polynomial(symbols)) return false;
  constexpr double most_terms = 2000;
  double terms = 1;
  double degree = 0, bits = 0;
  int used = 0;
  for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part)
    bits = std::max(bits, bits_of_number(*part));
  for (const GiNaC::realsymbol& symbol : beside) {
    if (!expression.has(symbol)) continue;
    if (!expression.is_polynomial(symbol)) {  // beside the polynomial, as 1/x is: no degree bounds its powers
      if (terms_multiplied_out(expression) > most_terms) return false;
      continue;
    }
    degree += expression.degree(symbol);
    ++used;
  }
  for (int k = 1; k <= used; ++k) terms *= (degree + k) / k;
  return degree <= highest_degree * std::max(used, 1) && terms <= most_terms && degree * bits <= most_bits;
}

bool has_shifted_power(const Expression& expression, const GiNaC::lst& symbols) {
  GiNaC::exmap origin;
  for (const Expression& symbol : symbols) origin[symbol] = 0;
  const auto is_shifted = [&](const Expression& base) {
    if (!GiNaC::is_a<GiNaC::add>(base) || base.subs(origin).expand().is_zero()) return false;
    return std::any_of(symbols.begin(), symbols.end(), [&](const Expression& symbol) {
      return !base.diff(GiNaC::ex_to<GiNaC::symbol>(symbol)).subs(origin).expand().is_zero();
    });
  };
  for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part)
    if (GiNaC::is_a<GiNaC::power>(*part) && part->op(1).info(GiNaC::info_flags::posint) && part->op(1) > 2 &&
        is_shifted(part->op(0)))
      return true;
  return false;
}

}  // namespace seiche
