#include <seiche/config/custom/outward_growth.hpp>
#include <seiche/core/numerics/definiteness.hpp>
#include <seiche/formula/algebra_functions.hpp>
#include <seiche/formula/expansion.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>

namespace seiche {
namespace {

enum class Sign { unknown, non_negative, positive };
// Of an expression along u, 2u, 3u, …: u·∇ is 0, ≥ 0 or ≤ 0.
enum class Growth { unknown, none, outward, inward };

bool is(const Expression& e, const char* function) {
  return GiNaC::is_a<GiNaC::function>(e) && name_of_function(e) == function;
}

bool is_number(const Expression& e) { return GiNaC::is_a<GiNaC::numeric>(e); }
const GiNaC::numeric& number(const Expression& e) { return GiNaC::ex_to<GiNaC::numeric>(e); }
bool is_even_power(const Expression& e) {
  return GiNaC::is_a<GiNaC::power>(e) && is_number(e.op(1)) && number(e.op(1)).is_even();
}

Growth turned(Growth g) { return g == Growth::outward ? Growth::inward : g == Growth::inward ? Growth::outward : g; }
Growth both(Growth a, Growth b) {
  if (a == Growth::none || a == b) return b;
  return b == Growth::none ? a : Growth::unknown;
}

class Look {
 public:
  explicit Look(const Symbols& fields) : fields_(fields) {}

  bool outward(const Expression& w) const {
    const Growth whole = growth(w);
    if (whole == Growth::outward || whole == Growth::none) return true;
    Expression rest = 0;  // terms that only together, and with others, may do
    for (std::size_t i = 0; i < terms(w); ++i) {
      const Expression t = term(w, i);
      const Growth g = growth(t);
      if (g != Growth::outward && g != Growth::none) rest += t;
    }
    return (convex(rest) && at_rest(rest)) || is_nonnegative_form(rest);
  }

 private:
  static std::size_t terms(const Expression& e) { return GiNaC::is_a<GiNaC::add>(e) ? e.nops() : 1; }
  static Expression term(const Expression& e, std::size_t i) { return GiNaC::is_a<GiNaC::add>(e) ? e.op(i) : e; }

  bool names_field(const Expression& e) const {
    return std::any_of(fields_.begin(), fields_.end(), [&](const GiNaC::realsymbol& u) { return e.has(u); });
  }

  bool is_affine(const Expression& e) const {
    return std::all_of(fields_.begin(), fields_.end(),
                       [&](const GiNaC::realsymbol& u) { return !names_field(e.diff(u)); });
  }

  // c₁u₁ + c₂u₂ + … without a constant: then u·∇ of it is itself.
  bool is_linear(const Expression& e) const { return is_affine(e) && at_origin(e).is_zero(); }

  Expression at_origin(const Expression& e) const {
    GiNaC::exmap zero;
    for (const GiNaC::realsymbol& u : fields_) zero[u] = 0;
    return seiche::at_origin(e, zero);
  }

  bool at_rest(const Expression& e) const {
    return std::all_of(fields_.begin(), fields_.end(),
                       [&](const GiNaC::realsymbol& u) { return at_origin(e.diff(u)).is_zero(); });
  }

  Sign sign(const Expression& e) const {
    if (is_number(e))
      return number(e).is_positive() ? Sign::positive : e.is_zero() ? Sign::non_negative : Sign::unknown;
    if (is(e, "exp") || is(e, "cosh") || is(e, "sech")) return Sign::positive;
    if (is(e, "abs") || is_even_power(e)) return Sign::non_negative;
    if (GiNaC::is_a<GiNaC::power>(e)) return sign(e.op(0)) == Sign::positive ? Sign::positive : Sign::unknown;
    if (!GiNaC::is_a<GiNaC::add>(e) && !GiNaC::is_a<GiNaC::mul>(e)) return Sign::unknown;
    const bool is_sum = GiNaC::is_a<GiNaC::add>(e);
    Sign all = is_sum ? Sign::non_negative : Sign::positive;
    for (std::size_t i = 0; i < e.nops(); ++i) {
      const Sign one = sign(e.op(i));
      if (one == Sign::unknown) return Sign::unknown;
      if (is_sum == (one == Sign::positive)) all = one;
    }
    return all;
  }

  Growth growth(const Expression& e) const {
    if (!names_field(e)) return Growth::none;
    if (GiNaC::is_a<GiNaC::add>(e)) {
      Growth all = Growth::none;
      for (std::size_t i = 0; i < e.nops(); ++i) all = both(all, growth(e.op(i)));
      return all;
    }
    if (GiNaC::is_a<GiNaC::mul>(e)) return growth_of_product(e);
    if (GiNaC::is_a<GiNaC::power>(e)) return growth_of_power(e.op(0), e.op(1));
    if (is(e, "abs") || is(e, "cosh")) return is_linear(e.op(0)) ? Growth::outward : Growth::unknown;
    if (is(e, "sech")) return is_linear(e.op(0)) ? Growth::inward : Growth::unknown;
    for (const char* rising : {"exp", "log", "sinh", "tanh", "asinh", "atan"})
      if (is(e, rising)) return growth(e.op(0));
    return Growth::unknown;
  }

  // u·∇(ab) = b u·∇a + a u·∇b, with a factor −1 in front as it may be.
  Growth growth_of_product(const Expression& e) const {
    Growth all = Growth::none;
    bool turns = false;
    for (std::size_t i = 0; i < e.nops(); ++i) {
      const Expression factor = e.op(i);
      if (is_number(factor) && number(factor).is_negative()) {
        turns = !turns;
        continue;
      }
      if (sign(factor) == Sign::unknown) return Growth::unknown;
      all = both(all, growth(factor));
    }
    return turns ? turned(all) : all;
  }

  Growth growth_of_power(const Expression& base, const Expression& exponent) const {
    if (!is_number(exponent)) return Growth::unknown;
    const Growth of_rise = number(exponent).is_positive() ? Growth::outward : Growth::inward;
    if (number(exponent).is_even() && is_linear(base)) return of_rise;
    if (sign(base) == Sign::unknown) return Growth::unknown;
    return of_rise == Growth::outward ? growth(base) : turned(growth(base));
  }

  bool convex(const Expression& e) const {
    if (is_affine(e)) return true;
    if (GiNaC::is_a<GiNaC::add>(e)) {
      for (std::size_t i = 0; i < e.nops(); ++i)
        if (!convex(e.op(i))) return false;
      return true;
    }
    if (GiNaC::is_a<GiNaC::mul>(e)) return convex_multiple(e);
    if (is(e, "exp")) return convex(e.op(0));
    if (is(e, "abs") || is(e, "cosh")) return is_affine(e.op(0));
    if (GiNaC::is_a<GiNaC::power>(e) && is_number(e.op(1)) && number(e.op(1)) >= 1)
      return is_even_power(e) ? is_affine(e.op(0)) : sign(e.op(0)) != Sign::unknown && convex(e.op(0));
    return false;
  }

  // A constant ≥ 0 times what is convex.
  bool convex_multiple(const Expression& e) const {
    Expression rest = 1;
    for (std::size_t i = 0; i < e.nops(); ++i) {
      const Expression factor = e.op(i);
      if (names_field(factor)) {
        rest *= factor;
      } else if (sign(factor) == Sign::unknown) {
        return false;
      }
    }
    return !GiNaC::is_a<GiNaC::mul>(rest) && convex(rest);
  }

  // Σ aᵢⱼuᵢuⱼ/b with coefficients in other symbols, as the kinetic energy of a double pendulum: then u·∇ is twice it.
  // Not negative where that holds with every |aᵢⱼ| as large, and every aᵢᵢ as small, as their bounds allow.
  bool is_nonnegative_form(const Expression& e) const {
    if (is_number(e) || has_endless_power(e) || most_terms_multiplied_out(e) > most_terms) return false;
    const Expression quotient = e.normal().numer_denom();
    const std::optional<Bounds> below = bounds(quotient.op(1));
    if (!below || names_field(quotient.op(1)) || !(below->least > 0 || below->most < 0)) return false;
    const Expression form = (below->least > 0 ? quotient.op(0) : -quotient.op(0)).expand();
    const auto n = static_cast<Index>(fields_.size());
    SparseMatrix comparison(n, n);
    Expression counted = 0;
    for (Index i = 0; i < n; ++i) {
      const GiNaC::realsymbol& a = fields_[static_cast<std::size_t>(i)];
      if (!form.is_polynomial(a)) return false;
      for (Index j = 0; j <= i; ++j) {
        const GiNaC::realsymbol& b = fields_[static_cast<std::size_t>(j)];
        const Expression coefficient = i == j ? form.coeff(a, 2) : form.coeff(a, 1).coeff(b, 1);
        counted += coefficient * a * b;
        const std::optional<Bounds> of = bounds(coefficient);
        if (!of) return false;
        const double entry = i == j ? of->least : -std::max(-of->least, of->most) / 2;
        comparison.coeffRef(i, j) = comparison.coeffRef(j, i) = entry;
      }
    }
    if (!(form - counted).expand().is_zero()) return false;  // of another degree
    return !negative_direction(comparison);
  }

  struct Bounds {
    double least, most;
  };
  // Of all values that an expression can have, whatever its symbols are; nothing where it is not seen to be bounded.
  static std::optional<Bounds> bounds(const Expression& e) {
    if (is_number(e)) return Bounds{number(e).to_double(), number(e).to_double()};
    for (const char* bounded : {"sin", "cos", "tanh"})
      if (is(e, bounded)) return Bounds{-1, 1};
    if (is(e, "sech")) return Bounds{0, 1};
    if (GiNaC::is_a<GiNaC::power>(e)) return bounds_of_power(e.op(0), e.op(1));
    const bool is_sum = GiNaC::is_a<GiNaC::add>(e);
    if (!is_sum && !GiNaC::is_a<GiNaC::mul>(e)) return std::nullopt;
    Bounds all = is_sum ? Bounds{0, 0} : Bounds{1, 1};
    for (std::size_t i = 0; i < e.nops(); ++i) {
      const std::optional<Bounds> one = bounds(e.op(i));
      if (!one) return std::nullopt;
      if (is_sum) {
        all = {all.least + one->least, all.most + one->most};
        continue;
      }
      const auto [least, most] =
          std::minmax({all.least * one->least, all.least * one->most, all.most * one->least, all.most * one->most});
      all = {least, most};
    }
    return all;
  }

  static std::optional<Bounds> bounds_of_power(const Expression& base, const Expression& exponent) {
    if (!is_number(exponent) || !number(exponent).is_pos_integer()) return std::nullopt;
    const std::optional<Bounds> of = bounds(base);
    if (!of) return std::nullopt;
    const double a = std::pow(of->least, number(exponent).to_double());
    const double b = std::pow(of->most, number(exponent).to_double());
    if (!number(exponent).is_even()) return Bounds{a, b};
    const bool passes_zero = of->least < 0 && of->most > 0;
    return Bounds{passes_zero ? 0 : std::min(a, b), std::max(a, b)};
  }

  const Symbols& fields_;
};

}  // namespace

bool grows_outward(const Expression& w, const Symbols& fields) {
  try {
    return Look(fields).outward(w);
  } catch (const std::exception&) {  // poles at 0: GiNaC's own types
    return false;
  }
}

}  // namespace seiche
