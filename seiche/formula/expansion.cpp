#include <seiche/formula/expansion.hpp>
#include <seiche/formula/formula_parser.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace seiche {
namespace {

double bits_of_number(const Expression& number) {
  if (!GiNaC::is_a<GiNaC::numeric>(number) || !number.info(GiNaC::info_flags::rational)) return 0;
  const auto& x = GiNaC::ex_to<GiNaC::numeric>(number);
  return x.numer().int_length() + x.denom().int_length();
}

// C(n + m − 1, n): so many terms the n-th power of m terms has, or no fewer than 10¹².
double terms_of_power(double m, double n) {
  if (m <= 1 || n == 0) return 1;
  constexpr double enough = 1e12;
  const double few = std::min(m - 1, n), many = std::max(m - 1, n);
  double terms = 1;
  for (double k = 1; k <= few && terms < enough; ++k) terms *= (many + k) / k;
  return terms;
}

// The n of aᵇ = aⁿaᶜ where b is a sum that is not a number: then aⁿ is multiplied out. Infinite where aⁿ has too many
// digits.
double whole_part(const Expression& base, const Expression& exponent) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  if (most_terms_multiplied_out(exponent) > most_terms) return endless;
  double n = 0;
  const Expression sum = exponent.expand();
  for (std::size_t i = 0; GiNaC::is_a<GiNaC::add>(sum) && i < sum.nops(); ++i)
    if (GiNaC::is_a<GiNaC::numeric>(sum.op(i))) n = std::abs(GiNaC::ex_to<GiNaC::numeric>(sum.op(i)).to_double());
  return bits_of(base) * n > most_bits ? endless : n;
}

// At most so many terms stand above and below the line of a common denominator.
struct Terms {
  double above = 1, below = 1;
};

Terms terms_of_quotient(const Expression& expression) {
  Terms terms;
  if (GiNaC::is_a<GiNaC::add>(expression)) {
    terms.above = 0;
    for (const Expression& part : expression) {
      const Terms one = terms_of_quotient(part);
      terms = {terms.above * one.below + one.above * terms.below, terms.below * one.below};
    }
  } else if (GiNaC::is_a<GiNaC::mul>(expression)) {
    for (const Expression& part : expression) {
      const Terms one = terms_of_quotient(part);
      terms = {terms.above * one.above, terms.below * one.below};
    }
  } else if (GiNaC::is_a<GiNaC::power>(expression) && expression.op(1).info(GiNaC::info_flags::integer)) {
    const Terms base = terms_of_quotient(expression.op(0));
    const double n = GiNaC::ex_to<GiNaC::numeric>(expression.op(1)).to_double();
    terms = {terms_of_power(base.above, std::abs(n)), terms_of_power(base.below, std::abs(n))};
    if (n < 0) std::swap(terms.above, terms.below);
  } else if (GiNaC::is_a<GiNaC::power>(expression) && !GiNaC::is_a<GiNaC::numeric>(expression.op(1))) {
    const double n = whole_part(expression.op(0), expression.op(1));
    const Terms base = terms_of_quotient(expression.op(0));
    terms = {terms_of_power(base.above, n), terms_of_power(base.below, n)};
    terms.above = std::max({terms.above, base.above, most_terms_multiplied_out(expression.op(1))});
    if (std::isinf(n)) terms.above = n;
  } else {
    for (const Expression& argument : expression)
      terms.above = std::max(terms.above, most_terms_multiplied_out(argument));
  }
  return terms;
}

}  // namespace

double bits_of(const Expression& base) {
  double bits = bits_of_number(base);
  for (std::size_t i = 0; GiNaC::is_a<GiNaC::mul>(base) && i < base.nops(); ++i) bits += bits_of_number(base.op(i));
  return bits;
}

double most_terms_multiplied_out(const Expression& expression) {
  const Terms terms = terms_of_quotient(expression);
  return std::max(terms.above, terms.below);
}

bool is_small_polynomial(const Expression& expression, const GiNaC::lst& symbols, const Symbols& beside) {
  if (!expression.is_polynomial(symbols)) return false;
  double terms = 1;
  double degree = 0, bits = 0;
  int used = 0;
  for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part)
    bits = std::max(bits, bits_of_number(*part));
  for (const GiNaC::realsymbol& symbol : beside) {
    if (!expression.has(symbol)) continue;
    if (!expression.is_polynomial(symbol)) {  // beside the polynomial, as 1/x is: no degree bounds its powers
      if (most_terms_multiplied_out(expression) > most_terms) return false;
      continue;
    }
    degree += expression.degree(symbol);
    ++used;
  }
  for (int k = 1; k <= used; ++k) terms *= (degree + k) / k;
  return degree <= highest_degree * std::max(used, 1) && terms <= most_terms && degree * bits <= most_bits;
}

bool has_endless_power(const Expression& expression) {
  for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part) {
    if (!GiNaC::is_a<GiNaC::power>(*part)) continue;
    const Expression exponent = part->op(1);
    if (!exponent.info(GiNaC::info_flags::rational)) return true;
    const auto& n = GiNaC::ex_to<GiNaC::numeric>(exponent);
    if (abs(n.numer()) > most_terms || n.denom() > most_terms) return true;
  }
  return false;
}

Expression at_origin(const Expression& expression, const GiNaC::exmap& origin) {
  if (has_endless_power(expression)) return expression;
  const Expression there = expression.subs(origin);  // of the place alone, and not always small
  return most_terms_multiplied_out(there) > most_terms ? there : there.expand();
}

bool has_shifted_power(const Expression& expression, const GiNaC::lst& symbols) {
  GiNaC::exmap origin;
  for (const Expression& symbol : symbols) origin[symbol] = 0;
  const auto is_shifted = [&](const Expression& base) {
    if (!GiNaC::is_a<GiNaC::add>(base) || at_origin(base, origin).is_zero()) return false;
    return std::any_of(symbols.begin(), symbols.end(), [&](const Expression& symbol) {
      return !at_origin(base.diff(GiNaC::ex_to<GiNaC::symbol>(symbol)), origin).is_zero();
    });
  };
  for (auto part = expression.preorder_begin(); part != expression.preorder_end(); ++part)
    if (GiNaC::is_a<GiNaC::power>(*part) && part->op(1).info(GiNaC::info_flags::posint) && part->op(1) > 2 &&
        is_shifted(part->op(0)))
      return true;
  return false;
}

}  // namespace seiche
