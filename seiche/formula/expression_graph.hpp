// Formulas of the same variables as one graph: what they share is computed once, and a block of points at a time.
#pragma once

#include <seiche/formula/formula_program.hpp>

#include <cstddef>
#include <map>
#include <span>
#include <tuple>
#include <vector>

namespace seiche {

class ExpressionGraph {
 public:
  struct Node {
    Instruction::Kind kind = Instruction::Kind::number;
    int a = -1, b = -1;   // operands: nodes before this one
    double number = 0.0;  // of `number`
    int index = 0;        // of `whole_power`: the exponent
    const FormulaFunction* function = nullptr;
  };

  static constexpr std::size_t block = 64;  // points

  // Node v is variable v.
  ExpressionGraph(int variables, std::span<const std::span<const Instruction>> programs);

  std::span<const Node> nodes() const { return nodes_; }
  int variables() const { return variables_; }
  std::size_t output(std::size_t program) const { return outputs_[program]; }  // the node of its value

  // Values of all nodes at up to `block` points, block numbers for each. The caller has put in the numbers of the
  // variables; set_numbers, once, those that stay.
  std::size_t table_size() const { return nodes_.size() * block; }
  void set_numbers(double* table) const;
  void evaluate(double* table, std::size_t points) const;        // of all programs
  void evaluate_first(double* table, std::size_t points) const;  // of the first program, whose nodes come first

 private:
  using Key = std::tuple<Instruction::Kind, int, int, double, int, const FormulaFunction*>;
  using Known = std::map<Key, int>;  // which node an operation already is
  int add(const Node& node, Known& known);
  int add_program(std::span<const Instruction> program, Known& known);
  void evaluate_nodes(double* table, std::size_t points, std::size_t end) const;

  int variables_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> outputs_;
  std::size_t first_end_ = 0;  // behind the nodes of the first program
};

// At up to `block` points, of the first program: s with Σᵥ sᵥ (bᵥ − aᵥ) = f(b) − f(a), without cancellation. The sum
// and product rules with means in place of values, and mean slopes of functions: ∇f where a = b, symmetric in a and b,
// and therefore the mean gradient to second order; of one variable it is the mean slope. `a` and `b` are tables as
// after evaluate. Slopes are taken in the first `directions` variables; slopes holds directions × block numbers for
// every node.
void mean_slopes(const ExpressionGraph& graph, const double* a, const double* b, int directions, std::size_t points,
                 double* slopes);

// Sizes of the values of a table as after evaluate: |f| with the sizes of the terms of sums.
void term_sizes(const ExpressionGraph& graph, const double* table, std::size_t points, double* sizes);

// Coefficients of x ↦ f(p + xq) for the first program, a polynomial in the variables where q ≠ 0 of at most `degree`,
// added to `coefficients`.
inline std::size_t taylor_scratch_size(const ExpressionGraph& graph, int degree) {
  return (graph.nodes().size() + 1) * static_cast<std::size_t>(degree + 1);
}
void add_taylor(const ExpressionGraph& graph, std::span<const double> p, std::span<const double> q, int degree,
                double* scratch, std::span<double> coefficients);

}  // namespace seiche
