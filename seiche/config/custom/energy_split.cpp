#include <seiche/config/custom/energy_split.hpp>
#include <seiche/config/custom/outward_growth.hpp>
#include <seiche/config/custom/written_summands.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/axis_names.hpp>
#include <seiche/formula/expansion.hpp>
#include <seiche/formula/expression_text.hpp>
#include <seiche/formula/formula_compiler.hpp>
#include <seiche/formula/formula_expression.hpp>

#include <algorithm>
#include <optional>

namespace seiche {
namespace {

using Factor = QuadraticTerm::Factor;

constexpr Index most_axes = 3;

struct NamedFactor {
  std::string name;
  Factor factor;
};

// Fields, places, derivatives and bonds: one name for each variable of the formula. Axes that the grid lacks have
// the name "", which no formula can contain.
struct Layout {
  std::vector<std::string> variables;
  std::vector<NamedFactor> factors;  // beside the fields
  std::size_t fields = 0;

  explicit Layout(const EnergyNames& names) : variables(names.fields), fields(names.fields.size()) {
    for (Index a = 0; a < most_axes; ++a)
      variables.emplace_back(a < names.axes ? axis_names[static_cast<std::size_t>(a)] : "");
    for (std::size_t f = 0; f < fields; ++f) {
      const auto field = static_cast<Index>(f);
      for (Index a = 0; a < names.axes; ++a) {
        const std::string axis = axis_names[static_cast<std::size_t>(a)];
        factors.push_back({fmt::format("{}_{}", names.fields[f], axis), {field, Factor::Kind::first, a}});
        factors.push_back({fmt::format("{0}_{1}{1}", names.fields[f], axis), {field, Factor::Kind::second, a}});
      }
      if (names.axes == 1) factors.push_back({"d" + names.fields[f], {field, Factor::Kind::bond, 0}});
    }
    for (const NamedFactor& f : factors) variables.push_back(f.name);
  }

  Factor factor(std::size_t variable) const {
    if (variable < fields) return {static_cast<Index>(variable), Factor::Kind::value, 0};
    return factors[variable - fields - most_axes].factor;
  }
  std::size_t first_factor() const { return fields + most_axes; }
};

class Splitter {
 public:
  Splitter(std::string key, std::string text, const EnergyNames& names, const QuadraticTerms& quadratic)
      : key_(std::move(key)), text_(std::move(text)), layout_(names), advice_(names.advice), quadratic_(quadratic) {}

  EnergySplit split(const FormulaConstants& constants) {
    const FormulaProgram program = parse(text_, constants);
    const AlgebraLock lock;
    symbols_ = make_symbols(layout_.variables);
    for (std::size_t v = 0; v < symbols_.size(); ++v)
      if (v < layout_.fields || v >= layout_.first_factor()) active_.append(symbols_[v]);
    bond_.assign(layout_.fields, Expression(0));
    try {
      sort(to_expression(program, symbols_));
      for (const Expression& term : summands(polynomial_)) place(term);
      for (const Expression& term : summands(as_written_)) place(term);
      EnergySplit split = result();
      if (quadratic_.found) show_as_written(split, constants);
      return split;
    } catch (const Error& error) {
      const std::string_view said = error.what();
      throw said.starts_with(key_) ? error : Error("{} = \"{}\": {}", key_, shortened(text_), said);
    } catch (const std::exception& error) {  // poles, overflow: GiNaC's own types
      throw Error("{} = \"{}\" cannot be taken apart: {}", key_, shortened(text_), shortened(error.what()));
    }
  }

 private:
  FormulaProgram parse(const std::string& text, const FormulaConstants& constants) const {
    try {
      return parse_formula(text, layout_.variables, constants, advice_, FunctionsAllowed::differentiable).program;
    } catch (const Error& error) {
      throw Error("{}: {}", key_, error.what());
    }
  }

  // Term by term. What is a polynomial about the origin is multiplied out, as long as that ends, and whole before any
  // term of it is placed: what one bracket holds another may cancel. The rest stays as it was written.
  void sort(const Expression& expression) {
    if (GiNaC::is_a<GiNaC::add>(expression)) {
      for (const Expression& term : expression) sort(term);
    } else if (multiplied_out(expression)) {
      polynomial_ += expression.expand();
    } else {
      as_written_ += expression;
    }
  }

  bool multiplied_out(const Expression& term) const {
    return is_small_polynomial(term, active_, symbols_) && !has_shifted_power(term, active_);
  }

  static std::vector<Expression> summands(const Expression& sum) {
    if (GiNaC::is_a<GiNaC::add>(sum)) return in_one_order(sum);
    return sum.is_zero() ? std::vector<Expression>() : std::vector{sum};
  }

  std::vector<std::size_t> named_in(const Expression& term) const {
    std::vector<std::size_t> found;
    for (std::size_t v = 0; v < symbols_.size(); ++v)
      if (term.has(symbols_[v])) found.push_back(v);
    return found;
  }

  void place(const Expression& term) {
    bool has_place = false, has_field = false, has_derivative = false, has_bond = false;
    for (const std::size_t v : named_in(term)) {
      if (v < layout_.fields) {
        has_field = true;
      } else if (v < layout_.first_factor()) {
        has_place = true;
      } else {
        (layout_.factor(v).kind == Factor::Kind::bond ? has_bond : has_derivative) = true;
      }
    }
    if (!has_field && !has_derivative && !has_bond) {  // moves nothing, but says what H is counted from
      (has_place ? offset_in_place_ : offset_) += term;
      return;
    }
    const std::optional<QuadraticTerm> square = as_quadratic(term);
    if (has_derivative) {
      if (!square)
        throw Error(
            "{} = \"{}\": the term {} is not c·a·b with derivatives or fields a, b and a constant c: derivatives stand "
            "in quadratic terms only; differences between neighbours, as in d{}^4, may be anything",
            key_, shortened(text_), shortened(text_of(term)), layout_.variables.front());
      if (!quadratic_.found)
        throw Error(
            "{} = \"{}\": the term {} belongs into M (with d_x for derivatives), or write the whole energy as H", key_,
            shortened(text_), shortened(text_of(term)));
    }
    if (has_bond && (has_field || has_place || has_derivative))
      throw Error("{} = \"{}\": the term {} mixes a difference between neighbours with what belongs to one point", key_,
                  shortened(text_), shortened(text_of(term)));
    if (square && is_in_M(*square)) {
      split_.quadratic.push_back(*square);
      quadratic_sum_ += term;
    } else if (has_bond) {
      add_bond(term);
    } else {
      point_ += term;
    }
  }

  bool is_in_M(const QuadraticTerm& term) const {
    const bool is_of_values = term.a.kind == Factor::Kind::value && term.b.kind == Factor::Kind::value;
    const auto [i, j] = std::minmax(term.a.field, term.b.field);
    return quadratic_.found && !(is_of_values && quadratic_.left_in_V.contains({i, j}));
  }

  // c·a·b with a number c.
  std::optional<QuadraticTerm> as_quadratic(const Expression& term) const {
    std::vector<std::size_t> factors;
    Expression rest = term;
    for (const std::size_t v : named_in(term)) {
      if (v >= layout_.fields && v < layout_.first_factor()) return std::nullopt;
      if (!term.is_polynomial(symbols_[v])) return std::nullopt;
      const int degree = term.degree(symbols_[v]);
      if (degree > 2 || term.ldegree(symbols_[v]) != degree) return std::nullopt;
      factors.insert(factors.end(), static_cast<std::size_t>(degree), v);
      rest = rest.coeff(symbols_[v], degree);
    }
    const std::optional<double> coefficient = real_number(rest);
    if (factors.size() != 2 || !coefficient) return std::nullopt;
    return QuadraticTerm{.a = layout_.factor(factors[0]), .b = layout_.factor(factors[1]), .coefficient = *coefficient};
  }

  void add_bond(const Expression& term) {
    std::optional<Index> field;
    for (const std::size_t v : named_in(term)) {
      const Index of = layout_.factor(v).field;
      if (field && *field != of)
        throw Error(
            "{} = \"{}\": the term {} couples differences of two fields, which is possible in quadratic terms only",
            key_, shortened(text_), shortened(text_of(term)));
      field = of;
    }
    bond_[static_cast<std::size_t>(*field)] += term;
  }

  EnergySplit result() {
    split_.quadratic_text = text_of(quadratic_sum_);
    // A constant counts once for each point, or where there are bonds alone for each bond; without V it says nothing.
    const auto first_bond = std::find_if(bond_.begin(), bond_.end(), [](const Expression& w) { return !w.is_zero(); });
    if (!point_.is_zero()) {
      point_ += offset_ + offset_in_place_;
    } else if (first_bond != bond_.end()) {
      *first_bond += offset_;
      leave_out(offset_in_place_);
    } else {
      leave_out(offset_ + offset_in_place_);
    }
    Expression rest = point_;
    for (const Expression& bond : bond_) rest += bond;
    split_.rest_text = text_of(rest);
    add_point_formula();
    for (std::size_t f = 0; f < layout_.fields; ++f) {
      if (bond_[f].is_zero()) continue;
      const Symbols of_bond = {bond_symbol(f)};
      split_.per_bond.push_back(formula(bond_[f], of_bond, static_cast<Index>(f)));
    }
    return std::move(split_);
  }

  // In the user's own terms, where each of them belongs to one part as a whole.
  void show_as_written(EnergySplit& split, const FormulaConstants& constants) const {
    std::vector<WrittenSummand> in_M, in_V;
    Expression sum_in_M = 0;
    for (const WrittenSummand& written : written_summands(text_)) {
      const Expression term = to_expression(parse(written.text, constants), symbols_);
      const std::vector<Expression> parts = multiplied_out(term) ? summands(term.expand()) : std::vector{term};
      const bool is_quadratic = std::all_of(parts.begin(), parts.end(), [&](const Expression& part) {
        const std::optional<QuadraticTerm> square = as_quadratic(part);
        return square && is_in_M(*square);
      });
      (is_quadratic ? in_M : in_V).push_back(written);
      if (is_quadratic) sum_in_M += written.is_subtracted ? -term : term;
    }
    if (!(sum_in_M - quadratic_sum_).expand().is_zero()) return;
    split.quadratic_text = sum_text(in_M);
    if (split.left_out_text.empty() && split.rest_text != "0") split.rest_text = sum_text(in_V);
  }

  // Throws where it is no real number, as √−1.
  void leave_out(const Expression& offset) {
    if (offset.is_zero()) return;
    const auto places = symbols_.begin() + static_cast<std::ptrdiff_t>(layout_.fields);
    compiled(offset, {places, places + most_axes});
    split_.left_out_text = text_of(offset);
  }

  GiNaC::realsymbol bond_symbol(std::size_t field) const {
    std::size_t v = layout_.first_factor();
    while (layout_.factor(v).kind != Factor::Kind::bond || layout_.factor(v).field != static_cast<Index>(field)) ++v;
    return symbols_[v];
  }

  void add_point_formula() {
    std::optional<std::size_t> first, last;
    for (const std::size_t v : named_in(point_)) {
      if (v >= layout_.fields) continue;
      if (!first) first = v;
      last = v;
    }
    if (!first) return;  // V does not change
    const auto begin = static_cast<std::ptrdiff_t>(*first), end = static_cast<std::ptrdiff_t>(*last) + 1;
    split_.per_point.push_back(
        formula(point_, {symbols_.begin() + begin, symbols_.begin() + end}, static_cast<Index>(begin)));
  }

  // W of these fields and, behind them, of the places.
  FieldFormula formula(const Expression& w, const Symbols& fields, Index first) const {
    Symbols symbols = fields;
    const auto places = symbols_.begin() + static_cast<std::ptrdiff_t>(layout_.fields);
    symbols.insert(symbols.end(), places, places + most_axes);
    FieldFormula result{.field = first, .count = static_cast<Index>(fields.size())};
    result.w.value = compiled(w, symbols);
    for (const GiNaC::realsymbol& field : fields) result.w.gradient.push_back(compiled(w.diff(field), symbols));
    result.w.uses_place = std::any_of(places, places + most_axes, [&](const Expression& x) { return w.has(x); });
    look_at_powers(w, fields, result);
    result.w.grows_outward = grows_outward(w, fields);
    result.w.grows_outward_from = {result.w.grows_outward};
    for (auto from = fields.begin() + 1; from != fields.end(); ++from)
      result.w.grows_outward_from.push_back(grows_outward(w, Symbols(from, fields.end())));
    return result;
  }

  FormulaPointer compiled(const Expression& expression, const Symbols& symbols) const {
    std::vector<std::string> names;
    for (const GiNaC::realsymbol& symbol : symbols) names.push_back(symbol.get_name());
    FormulaProgram program;
    append_program(expression, symbols, program);
    return formula_of(text_of(expression), names, std::move(program));
  }

  // What is known of W as a polynomial in the fields.
  static void look_at_powers(const Expression& w, const Symbols& fields, FieldFormula& out) {
    GiNaC::lst list;
    for (const GiNaC::realsymbol& field : fields) list.append(field);
    if (!w.is_polynomial(list) || has_shifted_power(w, list)) return;
    std::set<int> degrees;
    // Sums that were too long to be multiplied out have degrees all the same.
    const bool is_sum = GiNaC::is_a<GiNaC::add>(w);
    for (std::size_t i = 0; i < (is_sum ? w.nops() : 1); ++i) {
      const Expression term = is_sum ? w.op(i) : w;
      int degree = 0;
      for (const GiNaC::realsymbol& field : fields) {
        const int power = term.degree(field);
        degree += power;
        if (term.ldegree(field) != power) degrees.insert(-1);
      }
      degrees.insert(degree);
    }
    if (*degrees.rbegin() > highest_degree) return;
    out.w.degree = *degrees.rbegin();
    out.w.homogeneity = degrees.size() == 1 && out.w.degree > 0 ? out.w.degree : 0;
    if (out.w.uses_place) return;
    if (fields.size() == 1) out.polynomial = coefficients(w, fields[0], out.w.degree);
    if (fields.size() == 2) look_at_modulus(w, fields, out);
  }

  static std::vector<double> coefficients(const Expression& w, const Expression& variable, int degree) {
    const Expression expanded = w.expand();
    std::vector<double> c;
    for (int k = 0; k <= degree; ++k) {
      const std::optional<double> number = real_number(expanded.coeff(variable, k));
      if (!number) return {};
      c.push_back(*number);
    }
    return c;
  }

  static void look_at_modulus(const Expression& w, const Symbols& fields, FieldFormula& out) {
    const Expression even = w.subs(fields[1] == 0).expand();
    std::vector<double> c;
    Expression in_modulus = 0;
    for (int k = 0; k <= out.w.degree; ++k) {
      const Expression coefficient = even.coeff(fields[0], k);
      if (k % 2 != 0 && !coefficient.is_zero()) return;
      if (k % 2 != 0) continue;
      const std::optional<double> number = real_number(coefficient);
      if (!number) return;
      c.push_back(*number);
      in_modulus += coefficient * GiNaC::pow(GiNaC::pow(fields[0], 2) + GiNaC::pow(fields[1], 2), k / 2);
    }
    if ((in_modulus - w).expand().is_zero()) out.of_modulus = std::move(c);
  }

  std::string key_, text_;
  Layout layout_;
  const NameAdvice& advice_;
  const QuadraticTerms& quadratic_;
  Symbols symbols_;
  GiNaC::lst active_;  // all symbols but the places
  Expression polynomial_ = 0, as_written_ = 0;
  Expression point_ = 0, offset_ = 0, offset_in_place_ = 0, quadratic_sum_ = 0;
  std::vector<Expression> bond_;  // by field
  EnergySplit split_;
};

}  // namespace

EnergySplit split_energy(const std::string& key, const std::string& text, const EnergyNames& names,
                         const FormulaConstants& constants, const QuadraticTerms& quadratic) {
  return Splitter(key, text, names, quadratic).split(constants);
}

}  // namespace seiche
