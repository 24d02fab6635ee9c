#include <seiche/core/simd/with_lanes.hpp>
#include <seiche/formula/expression_code.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace seiche {
namespace {

using Operation = ExpressionCode::Operation;
using Do = Operation::Kind;

constexpr int longest_product = 64;  // of powers; beyond it one call costs less

bool is_arithmetic(const Operation& o) { return o.kind < Do::power; }

// Numbers that may be multiplied later than it is written: what they are factors of comes no nearer to the ends of
// double than by this.
bool is_moderate(double factor) { return std::abs(factor) > 1e-20 && std::abs(factor) < 1e20; }

// Code in which every operation has a place of its own for its result; places become rows once all is known.
class Builder {
 public:
  explicit Builder(const ExpressionGraph& graph)
      : graph_(graph), places_(graph.variables()), known_(graph.nodes().size()) {}

  struct Term {  // factor · place, or where there is no place the number `factor`
    double factor = 0;
    int place = -1;
  };

  Term of_node(std::size_t node) {
    if (!known_[node]) known_[node] = make(graph_.nodes()[node], static_cast<int>(node));
    return *known_[node];
  }

  std::vector<Operation> take() { return std::move(operations_); }
  int places() const { return places_; }

 private:
  using Bits = std::uint64_t;  // of numbers: NaN has no place in an order
  using Key = std::tuple<Operation::Kind, int, int, int, Bits, Bits, Bits, int, const FormulaFunction*>;

  Term make(const ExpressionGraph::Node& node, int index) {
    using Is = Instruction::Kind;
    if (node.kind == Is::variable) return {1, index};
    if (node.kind == Is::number) return {node.number, -1};
    const Term x = of_node(static_cast<std::size_t>(node.a));
    const Term y = node.b < 0 ? Term{} : of_node(static_cast<std::size_t>(node.b));
    switch (node.kind) {
      case Is::add: return sum(x, y);
      case Is::subtract: return sum(x, {-y.factor, y.place});
      case Is::negate: return {-x.factor, x.place};
      case Is::multiply: return product(x, y);
      case Is::divide: return quotient(x, y);
      case Is::whole_power: return raised(x, node.index);
      case Is::power: return {1, emit({.kind = Do::power, .x = place_of(x), .y = place_of(y)})};
      default: return call(*node.function, place_of(x), node.b < 0 ? -1 : place_of(y));
    }
  }

  Term sum(Term x, Term y) {
    if (x.place < 0 && y.place < 0) return {x.factor + y.factor, -1};
    if (x.place < 0 || (y.place >= 0 && y.place < x.place)) std::swap(x, y);
    if (y.place < 0) {
      if (y.factor == 0) return x;
      return {1, emit({.kind = Do::affine, .x = x.place, .a = x.factor, .c = y.factor})};
    }
    // A factor that both have stays outside.
    const double common = std::abs(x.factor) == std::abs(y.factor) ? x.factor : 1;
    return {common,
            emit({.kind = Do::linear, .x = x.place, .z = y.place, .a = x.factor / common, .b = y.factor / common})};
  }

  Term product(Term x, Term y) {
    if (x.place < 0) std::swap(x, y);
    if (y.place < 0 && (x.place < 0 || is_moderate(x.factor * y.factor))) return {x.factor * y.factor, x.place};
    settle(x, y);
    return {x.factor * y.factor,
            emit({.kind = Do::product, .x = std::min(x.place, y.place), .y = std::max(x.place, y.place)})};
  }

  Term quotient(Term x, Term y) {
    if (x.place < 0 && y.place < 0) return {x.factor / y.factor, -1};
    if (y.place < 0 && is_moderate(x.factor / y.factor)) return {x.factor / y.factor, x.place};
    if (x.place < 0 && is_moderate(x.factor / y.factor))
      return {x.factor / y.factor, emit({.kind = Do::reciprocal, .x = y.place})};
    settle(x, y);
    return {x.factor / y.factor, emit({.kind = Do::quotient, .x = x.place, .y = y.place})};
  }

  Term raised(Term x, int n) {
    const int size = std::abs(n);
    if (x.place < 0 || size == 0) return {std::pow(x.place < 0 ? x.factor : 1.0, n), -1};
    if (size > longest_product || !is_moderate(std::pow(x.factor, size))) {
      const int base = place_of(x);
      return {1, emit({.kind = Do::whole_power, .x = base, .n = n})};
    }
    const int positive = power_of(x.place, size);
    const int place = n > 0 ? positive : emit({.kind = Do::reciprocal, .x = positive});
    return {std::pow(x.factor, n), place};
  }

  int power_of(int place, int n) {
    if (n == 1) return place;
    const int half = power_of(place, n / 2), rest = power_of(place, n - n / 2);
    return emit({.kind = Do::product, .x = std::min(half, rest), .y = std::max(half, rest)});
  }

  Term call(const FormulaFunction& function, int x, int y) {
    const bool is_sine = function.of_many == &VectorFunctions::sin,
               is_cosine = function.of_many == &VectorFunctions::cos;
    if (is_sine || is_cosine) {
      if (const auto same = turns_.find(x); same != turns_.end()) return {1, turn(same->second, is_sine)};
      const auto half = emitted_.find(key_of({.kind = Do::affine, .x = x, .a = 0.5}));
      const auto turn_of_half = half == emitted_.end() ? turns_.end() : turns_.find(half->second);
      if (is_sine && turn_of_half != turns_.end())  // sin 2φ = 2 sin φ cos φ
        return product({2, turn(turn_of_half->second, true)}, {1, turn(turn_of_half->second, false)});
      turns_[x] = operations_.size();
    }
    return {1, emit({.kind = Do::call, .x = x, .y = y, .function = &function})};
  }

  // The sine or cosine of what the operation at this index takes one of the two of; it then takes both.
  int turn(std::size_t index, bool is_sine) {
    Operation& o = operations_[index];
    const bool has_sine = o.kind == Do::sine_and_cosine || o.function->of_many == &VectorFunctions::sin;
    if (o.kind == Do::call && has_sine == is_sine) return o.out;
    if (o.kind == Do::call) {
      const int first = o.out, second = places_++;
      o = {.kind = Do::sine_and_cosine, .x = o.x, .z = has_sine ? second : first, .out = has_sine ? first : second};
    }
    return is_sine ? o.out : o.z;
  }

  // Both become places times factors of which the product and the quotient are moderate.
  void settle(Term& x, Term& y) {
    for (Term* term : {&x, &y})
      if (term->place < 0 || !is_moderate(term->factor * term->factor)) *term = {1, place_of(*term)};
  }

  int place_of(Term x) {
    if (x.place < 0) return emit({.kind = Do::fill, .c = x.factor});
    return x.factor == 1 ? x.place : emit({.kind = Do::affine, .x = x.place, .a = x.factor});
  }

  static Key key_of(const Operation& o) {
    return {o.kind, o.x,       o.y, o.z, std::bit_cast<Bits>(o.a), std::bit_cast<Bits>(o.b), std::bit_cast<Bits>(o.c),
            o.n,    o.function};
  }
  int emit(Operation o) {
    const auto [known, is_new] = emitted_.try_emplace(key_of(o), places_);
    if (!is_new) return known->second;
    o.out = places_++;
    operations_.push_back(o);
    return o.out;
  }

  const ExpressionGraph& graph_;
  int places_;
  std::vector<std::optional<Term>> known_;
  std::map<Key, int> emitted_;
  std::map<int, std::size_t> turns_;  // sines and cosines, by their operand
  std::vector<Operation> operations_;
};

template <class Visit>
void for_operands(Operation& o, const Visit& visit) {
  for (int* place : {&o.x, &o.y})
    if (*place >= 0) visit(*place);
  if (o.z >= 0 && o.kind != Do::sine_and_cosine) visit(o.z);
}
template <class Visit>
void for_results(Operation& o, const Visit& visit) {
  visit(o.out);
  if (o.kind == Do::sine_and_cosine) visit(o.z);
}

// A product that is one term of one sum becomes a part of it.
void fuse(std::vector<Operation>& code, std::vector<int> uses) {
  std::map<int, std::size_t> products;
  for (std::size_t i = 0; i < code.size(); ++i) {
    Operation& o = code[i];
    if (o.kind == Do::product && uses[static_cast<std::size_t>(o.out)] == 1) products[o.out] = i;
    if (o.kind != Do::linear && o.kind != Do::affine) continue;
    if (o.kind == Do::linear && !products.contains(o.x)) {
      std::swap(o.x, o.z);
      std::swap(o.a, o.b);
    }
    const auto term = products.find(o.x);
    if (term == products.end()) continue;
    Operation& p = code[term->second];
    o.kind = o.kind == Do::linear ? Do::product_linear : Do::product_affine;
    o.x = p.x;
    o.y = std::exchange(p.y, -1);
    p.out = -1;
  }
  std::erase_if(code, [](const Operation& o) { return o.out < 0; });
}

[[gnu::always_inline]] inline double* row_of(double* table, int place) {  // -1: not asked for
  return table + static_cast<std::size_t>(std::max(place, 0)) * ExpressionCode::block;
}

template <class V>
[[gnu::always_inline]] inline const Operation* run_arithmetic(const Operation* o, const Operation* end, double* table,
                                                              std::size_t points) {
  for (; o != end; ++o) {
    const double *const x = row_of(table, o->x), *const y = row_of(table, o->y), *const z = row_of(table, o->z);
    double* const out = row_of(table, o->out);
    const double a = o->a, b = o->b, c = o->c;
    switch (o->kind) {
      case Do::fill:
        for (std::size_t j = 0; j < points; j += lane_count) store<V>(out + j, V{} + c);
        break;
      case Do::affine:
        for (std::size_t j = 0; j < points; j += lane_count) store<V>(out + j, a * load<V>(x + j) + c);
        break;
      case Do::linear:
        for (std::size_t j = 0; j < points; j += lane_count)
          store<V>(out + j, a * load<V>(x + j) + b * load<V>(z + j) + c);
        break;
      case Do::product:
        for (std::size_t j = 0; j < points; j += lane_count) store<V>(out + j, load<V>(x + j) * load<V>(y + j));
        break;
      case Do::product_affine:
        for (std::size_t j = 0; j < points; j += lane_count)
          store<V>(out + j, a * (load<V>(x + j) * load<V>(y + j)) + c);
        break;
      case Do::product_linear:
        for (std::size_t j = 0; j < points; j += lane_count)
          store<V>(out + j, a * (load<V>(x + j) * load<V>(y + j)) + b * load<V>(z + j) + c);
        break;
      case Do::quotient:
        for (std::size_t j = 0; j < points; j += lane_count) store<V>(out + j, load<V>(x + j) / load<V>(y + j));
        break;
      case Do::reciprocal:
        for (std::size_t j = 0; j < points; j += lane_count) store<V>(out + j, 1 / load<V>(x + j));
        break;
      default: return o;
    }
  }
  return o;
}

void run_call(const Operation& o, double* table, std::size_t points) {
  const double *const x = row_of(table, o.x), *const y = row_of(table, o.y);
  double* const out = row_of(table, o.out);
  switch (o.kind) {
    case Do::power: return vector_functions().pow(x, y, out, points);
    case Do::sine_and_cosine: return vector_functions().sincos(x, out, row_of(table, o.z), points);
    case Do::whole_power:
      for (std::size_t j = 0; j < points; ++j) out[j] = std::pow(x[j], o.n);
      return;
    default: break;
  }
  if (o.function->of_many != nullptr) return (vector_functions().*o.function->of_many)(x, out, points);
  for (std::size_t j = 0; j < points; ++j)
    out[j] = o.function->arity == 1 ? o.function->one(x[j]) : o.function->two(x[j], y[j]);
}

}  // namespace

ExpressionCode::ExpressionCode(const ExpressionGraph& graph, std::span<const std::size_t> nodes)
    : variables_(graph.variables()) {
  Builder builder(graph);
  std::vector<Builder::Term> terms;
  for (const std::size_t node : nodes) terms.push_back(builder.of_node(node));
  operations_ = builder.take();

  std::vector<int> uses(static_cast<std::size_t>(builder.places()));
  const auto used = [&](int place) -> int& { return uses[static_cast<std::size_t>(place)]; };
  for (Operation& o : operations_) for_operands(o, [&](int place) { ++used(place); });
  for (const Builder::Term& term : terms)
    if (term.place >= 0) used(term.place) += 2;  // it stays to the end, and is no part of a sum
  fuse(operations_, uses);

  // A place gets a row when it is written, and gives it back behind its last use.
  std::fill(uses.begin(), uses.end(), 0);
  for (Operation& o : operations_) for_operands(o, [&](int place) { ++used(place); });
  for (const Builder::Term& term : terms)
    if (term.place >= 0) ++used(term.place);
  std::vector<int> rows(uses.size()), free;
  for (int v = 0; v < variables_; ++v) rows[static_cast<std::size_t>(v)] = v;
  rows_ = static_cast<std::size_t>(variables_);
  for (Operation& o : operations_) {
    std::vector<int> released;
    for_operands(o, [&](int& place) {
      const int row = rows[static_cast<std::size_t>(place)];
      if (--used(place) == 0 && place >= variables_) released.push_back(row);
      place = row;
    });
    if (is_arithmetic(o)) free.insert(free.end(), released.begin(), released.end());
    for_results(o, [&](int& place) {
      const bool grows = free.empty();
      const int row = grows ? static_cast<int>(rows_++) : free.back();
      if (!grows) free.pop_back();
      rows[static_cast<std::size_t>(place)] = row;
      place = row;
    });
    if (!is_arithmetic(o)) free.insert(free.end(), released.begin(), released.end());
  }
  for (const auto& [factor, place] : terms)
    values_.push_back({factor, place < 0 ? -1 : rows[static_cast<std::size_t>(place)]});
}

void ExpressionCode::run(double* table, std::size_t points) const {
  // All eight lanes are numbers of some point: what no point asks for, 1/0 say, is not computed.
  const std::size_t asked = points;
  while (points % lane_count != 0) ++points;
  for (std::size_t v = 0; v < static_cast<std::size_t>(variables_); ++v)
    std::fill(table + v * block + asked, table + v * block + points, table[v * block + asked - 1]);
  const Operation* o = operations_.data();
  const Operation* const end = o + operations_.size();
  const auto run_arithmetic_here = [&]<class V>() __attribute__((always_inline)) {
    return run_arithmetic<V>(o, end, table, points);
  };
  while ((o = with_lanes(run_arithmetic_here)) != end) run_call(*o++, table, points);
}

}  // namespace seiche
