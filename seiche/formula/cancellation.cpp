#include <seiche/formula/cancellation.hpp>

#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

namespace seiche {
namespace {

using Kind = Instruction::Kind;

const FormulaFunction& function(std::string_view name) { return *find_formula_function(name); }

class Rewriter {
 public:
  explicit Rewriter(std::span<const Instruction> program) {
    std::vector<int> stack;
    const auto pop = [&stack] {
      const int top = stack.back();
      stack.pop_back();
      return top;
    };
    for (const Instruction& i : program) {
      Node node{.is = i};
      const int count = operands(i);
      if (count == 2) node.b = pop();
      if (count > 0) node.a = pop();
      stack.push_back(static_cast<int>(nodes_.size()));
      nodes_.push_back(node);
    }
    write(stack.back());
  }

  FormulaProgram take() { return std::move(out_); }

 private:
  struct Node {
    Instruction is;
    int a = -1, b = -1;
  };
  struct Term {
    double factor;
    int node;
    double at_rest = 0;  // of a function that is taken as what it is there and what it has beyond
  };
  struct Sum {
    double number = 0;
    std::vector<Term> terms;
    bool has_numbers = false;
  };

  const Node& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
  bool is_sum(int node) const {
    const Kind kind = at(node).is.kind;
    return kind == Kind::add || kind == Kind::subtract || kind == Kind::negate;
  }
  bool calls(int node, std::string_view name) const {
    return at(node).is.kind == Kind::call && at(node).is.function->name == name;
  }

  void collect(int node, double factor, Sum& sum) const {
    const auto& [is, a, b] = at(node);
    switch (is.kind) {
      case Kind::number:
        sum.number += factor * is.number;
        sum.has_numbers = true;
        return;
      case Kind::add:
        collect(a, factor, sum);
        collect(b, factor, sum);
        return;
      case Kind::subtract:
        collect(a, factor, sum);
        collect(b, -factor, sum);
        return;
      case Kind::negate: collect(a, -factor, sum); return;
      case Kind::multiply:
        for (const auto& [number, other] : {std::pair{a, b}, std::pair{b, a}}) {
          if (at(number).is.kind != Kind::number || is_sum(other)) continue;
          collect(other, factor * at(number).is.number, sum);
          return;
        }
        [[fallthrough]];
      default: sum.terms.push_back({factor, node});
    }
  }

  Sum sum_of(int node) const {
    Sum sum;
    collect(node, 1, sum);
    for (Term& term : sum.terms) term.at_rest = at_rest(term.node);
    return sum;
  }

  // f(0) of a function that has a form of f(x) − f(0) without cancellation; else 0.
  double at_rest(int node) const {
    if (calls(node, "exp") || calls(node, "cos") || calls(node, "cosh")) return 1;
    if (!calls(node, "sqrt") || !is_sum(at(node).a)) return 0;
    Sum inside;
    collect(at(node).a, 1, inside);
    return inside.number > 0 && !inside.terms.empty() ? std::sqrt(inside.number) : 0;
  }

  // Is the sum `value` at rest, to the bit, with functions there that have another form? Exponentials vanish far away,
  // where eˣ − 1 would lose what they are: a number of their size must stand in the sum, so that it is lost already.
  bool rests_at(const Sum& sum, double value) const {
    double rest = sum.number - value, exponentials = 0;
    bool has_functions = false;
    for (const Term& term : sum.terms) {
      rest += term.factor * term.at_rest;
      has_functions |= term.at_rest != 0;
      if (calls(term.node, "exp")) exponentials += std::abs(term.factor);
    }
    return (has_functions || value != 0) && rest == 0 && exponentials <= 4 * std::abs(sum.number);
  }

  void put(Kind kind) { out_.push_back({.kind = kind}); }
  void put_number(double number) { out_.push_back({.kind = Kind::number, .number = number}); }
  void put_square() { out_.push_back({.kind = Kind::whole_power, .index = 2}); }
  void put_call(std::string_view name) { out_.push_back({.kind = Kind::call, .function = &function(name)}); }
  void put_factor(double factor) {
    if (factor == 1) return;
    put_number(factor);
    put(Kind::multiply);
  }

  // The sum without its number, and functions without what they are at rest.
  void write_excess(const Sum& sum) {
    bool is_first = true;
    for (const Term& term : sum.terms) {
      write_excess(term);
      if (!is_first) put(Kind::add);
      is_first = false;
    }
  }

  void write_excess(const Term& term) {
    const int x = at(term.node).a;
    if (term.at_rest == 0) {
      write(term.node);
      put_factor(term.factor);
    } else if (calls(term.node, "exp")) {
      write(x);
      put_call("expm1");
      put_factor(term.factor);
    } else if (calls(term.node, "sqrt")) {
      Sum inside;
      collect(x, 1, inside);
      write_excess(inside);
      put_factor(term.factor);
      write(term.node);
      put_number(term.at_rest);
      put(Kind::add);
      put(Kind::divide);
    } else {
      const bool is_cosine = calls(term.node, "cos");
      write(x);
      put_factor(0.5);
      put_call(is_cosine ? "sin" : "sinh");
      put_square();
      put_factor((is_cosine ? -2 : 2) * term.factor);
    }
  }

  // k − k tanh²x + … = k sech²x + …; false, and nothing written: there is no such pair.
  bool write_sech(const Sum& sum) {
    for (const Term& square : sum.terms) {
      const Node& power = at(square.node);
      const bool is_pair = power.is.kind == Kind::whole_power && power.is.index == 2 && calls(power.a, "tanh") &&
                           sum.number == -square.factor;
      if (!is_pair) continue;
      write(at(power.a).a);
      put_call("sech");
      put_square();
      put_factor(sum.number);
      for (const Term& term : sum.terms) {
        if (&term == &square) continue;
        write(term.node);
        put_factor(term.factor);
        put(Kind::add);
      }
      return true;
    }
    return false;
  }

  void write(int node) {
    const auto& [is, a, b] = at(node);
    if (is_sum(node)) {
      const Sum sum = sum_of(node);
      if (sum.has_numbers && write_sech(sum)) return;
      if (rests_at(sum, 0)) return write_excess(sum);
    }
    if (calls(node, "log")) {
      const Sum sum = sum_of(a);
      if (!sum.terms.empty() && rests_at(sum, 1)) {
        write_excess(sum);
        return put_call("log1p");
      }
    }
    if (a >= 0) write(a);
    if (b >= 0) write(b);
    out_.push_back(is);
  }

  std::vector<Node> nodes_;
  FormulaProgram out_;
};

}  // namespace

FormulaProgram without_cancellation(std::span<const Instruction> program) { return Rewriter(program).take(); }

}  // namespace seiche
