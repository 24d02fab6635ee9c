#include <seiche/core/simd/multiversion.hpp>
#include <seiche/formula/expression_graph.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace seiche {
namespace {

using Kind = Instruction::Kind;

// xⁿ by multiplications, all points at a time; std::pow takes over where they would be too many.
SEICHE_MULTIVERSION void raise(const double* x, int n, double* out, std::size_t points) {
  constexpr int most = 64;
  const int size = std::abs(n);
  if (size > most || size == 0) {
    for (std::size_t j = 0; j < points; ++j) out[j] = std::pow(x[j], n);
    return;
  }
  std::array<double, ExpressionGraph::block> square;  // NOLINT(cppcoreguidelines-pro-type-member-init): written below
  for (std::size_t j = 0; j < points; ++j) square[j] = x[j];
  bool is_first = true;
  for (int rest = size; rest > 0; rest /= 2) {
    if (rest % 2 == 1 && is_first) {
      for (std::size_t j = 0; j < points; ++j) out[j] = square[j];
      is_first = false;
    } else if (rest % 2 == 1) {
      for (std::size_t j = 0; j < points; ++j) out[j] *= square[j];
    }
    if (rest > 1)
      for (std::size_t j = 0; j < points; ++j) square[j] *= square[j];
  }
  if (n < 0)
    for (std::size_t j = 0; j < points; ++j) out[j] = 1 / out[j];
}

SEICHE_MULTIVERSION void add(const double* x, const double* y, double* out, std::size_t points) {
  for (std::size_t j = 0; j < points; ++j) out[j] = x[j] + y[j];
}
SEICHE_MULTIVERSION void subtract(const double* x, const double* y, double* out, std::size_t points) {
  for (std::size_t j = 0; j < points; ++j) out[j] = x[j] - y[j];
}
SEICHE_MULTIVERSION void multiply(const double* x, const double* y, double* out, std::size_t points) {
  for (std::size_t j = 0; j < points; ++j) out[j] = x[j] * y[j];
}
SEICHE_MULTIVERSION void divide(const double* x, const double* y, double* out, std::size_t points) {
  for (std::size_t j = 0; j < points; ++j) out[j] = x[j] / y[j];
}

SEICHE_MULTIVERSION void negate(const double* x, double* out, std::size_t points) {
  for (std::size_t j = 0; j < points; ++j) out[j] = -x[j];
}

void call(const FormulaFunction& function, const double* x, const double* y, double* out, std::size_t points) {
  if (function.of_many != nullptr) return (vector_functions().*function.of_many)(x, out, points);
  if (function.arity == 1) {
    double (*const f)(double) = function.one;
    for (std::size_t j = 0; j < points; ++j) out[j] = f(x[j]);
    return;
  }
  double (*const f)(double, double) = function.two;
  for (std::size_t j = 0; j < points; ++j) out[j] = f(x[j], y[j]);
}

}  // namespace

ExpressionGraph::ExpressionGraph(int variables, std::span<const std::span<const Instruction>> programs)
    : variables_(variables) {
  for (int v = 0; v < variables; ++v) nodes_.push_back({.kind = Kind::variable, .index = v});
  Known known;
  for (const std::span<const Instruction> program : programs) {
    outputs_.push_back(static_cast<std::size_t>(add_program(program, known)));
    if (outputs_.size() == 1) first_end_ = nodes_.size();
  }
  find_partners();
  find_factors();
}

// What functions, powers, products and quotients are taken of, and what it takes to know that.
void ExpressionGraph::find_factors() {
  in_slopes_.assign(first_end_, false);
  for (std::size_t i = first_end_; i-- > 0;) {
    const Node& node = nodes_[i];
    const bool is_sum = node.kind == Kind::add || node.kind == Kind::subtract || node.kind == Kind::negate;
    const int number = node.kind == Kind::multiply ? number_in_product(node) : -1;
    if (number >= 0) in_slopes_[static_cast<std::size_t>(number)] = true;
    if ((is_sum || number >= 0) && !in_slopes_[i]) continue;
    for (const int operand : {node.a, node.b})
      if (operand >= 0) in_slopes_[static_cast<std::size_t>(operand)] = true;
  }
}

int ExpressionGraph::number_in_product(const Node& product) const {
  for (const int operand : {product.a, product.b})
    if (nodes_[static_cast<std::size_t>(operand)].kind == Kind::number) return operand;
  return -1;
}

bool ExpressionGraph::has_sums_in_slopes() const {
  for (std::size_t i = 0; i < first_end_; ++i)
    if (in_slopes_[i] && (nodes_[i].kind == Kind::add || nodes_[i].kind == Kind::subtract)) return true;
  return false;
}

void ExpressionGraph::find_partners() {
  const FormulaFunction* const sine = find_formula_function("sin");
  const FormulaFunction* const cosine = find_formula_function("cos");
  std::map<int, int> sines;  // by their operand
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i)
    if (const Node& node = nodes_[static_cast<std::size_t>(i)]; node.function == sine) sines[node.a] = i;
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
    Node& node = nodes_[static_cast<std::size_t>(i)];
    const auto same = node.function == cosine ? sines.find(node.a) : sines.end();
    if (same == sines.end()) continue;
    node.partner = same->second;
    nodes_[static_cast<std::size_t>(same->second)].partner = i;
  }
}

int ExpressionGraph::add(const Node& node, Known& known) {
  const auto [place, is_new] = known.try_emplace({node.kind, node.a, node.b, node.number, node.index, node.function},
                                                 static_cast<int>(nodes_.size()));
  if (is_new) nodes_.push_back(node);
  return place->second;
}

int ExpressionGraph::add_program(std::span<const Instruction> program, Known& known) {
  std::vector<int> stack;
  const auto pop = [&stack] {
    const int top = stack.back();
    stack.pop_back();
    return top;
  };
  for (const Instruction& instruction : program) {
    if (instruction.kind == Kind::variable) {
      stack.push_back(instruction.index);
      continue;
    }
    Node node{.kind = instruction.kind, .number = instruction.number, .function = instruction.function};
    if (node.kind == Kind::whole_power) node.index = instruction.index;
    const int count = operands(instruction);
    if (count == 2) node.b = pop();
    if (count > 0) node.a = pop();
    // The order of operands makes no other value.
    if ((node.kind == Kind::add || node.kind == Kind::multiply) && node.a > node.b) std::swap(node.a, node.b);
    stack.push_back(add(node, known));
  }
  return stack.back();
}

void ExpressionGraph::set_numbers(double* table, std::size_t points) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (nodes_[i].kind == Kind::number) std::fill_n(table + i * block, points, nodes_[i].number);
}

void ExpressionGraph::evaluate(double* table, std::size_t points) const {
  evaluate_nodes(table, points, nodes_.size(), [](std::size_t) { return true; });
}

void ExpressionGraph::evaluate_first(double* table, std::size_t points) const {
  evaluate_nodes(table, points, first_end_, [](std::size_t) { return true; });
}

void ExpressionGraph::evaluate_for_slopes(double* table, std::size_t points) const {
  evaluate_nodes(table, points, first_end_, [this](std::size_t node) { return in_slopes_[node]; });
}

template <class IsAsked>
void ExpressionGraph::evaluate_nodes(double* table, std::size_t points, std::size_t end,
                                     const IsAsked& is_asked) const {
  const auto row = [table](int node) { return table + static_cast<std::size_t>(node) * block; };
  for (std::size_t i = static_cast<std::size_t>(variables_); i < end; ++i) {
    if (!is_asked(i)) continue;
    const Node& node = nodes_[i];
    double* const out = table + i * block;
    switch (node.kind) {
      case Kind::number:
      case Kind::variable: break;
      case Kind::add: seiche::add(row(node.a), row(node.b), out, points); break;
      case Kind::subtract: subtract(row(node.a), row(node.b), out, points); break;
      case Kind::multiply: multiply(row(node.a), row(node.b), out, points); break;
      case Kind::divide: divide(row(node.a), row(node.b), out, points); break;
      case Kind::negate: negate(row(node.a), out, points); break;
      case Kind::power: vector_functions().pow(row(node.a), row(node.b), out, points); break;
      case Kind::whole_power: raise(row(node.a), node.index, out, points); break;
      case Kind::call:
        // Sine and cosine of one number come together, where the first of them stands.
        if (const int partner = node.partner;
            partner >= 0 && static_cast<std::size_t>(partner) < end && is_asked(static_cast<std::size_t>(partner))) {
          if (static_cast<std::size_t>(partner) < i) break;
          const bool is_sine = node.function->of_many == &VectorFunctions::sin;
          vector_functions().sincos(row(node.a), is_sine ? out : row(partner), is_sine ? row(partner) : out, points);
          break;
        }
        call(*node.function, row(node.a), node.b < 0 ? nullptr : row(node.b), out, points);
        break;
    }
  }
}

}  // namespace seiche
