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
    int partner = -1;  // of a sine: the cosine of the same operand, if there is one, and the other way round
  };

  static constexpr std::size_t block = 128;  // points

  // Node v is variable v.
  ExpressionGraph(int variables, std::span<const std::span<const Instruction>> programs);

  std::span<const Node> nodes() const { return nodes_; }
  int variables() const { return variables_; }
  int number_in_product(const Node& product) const;  // the operand that is a number; -1: none is
  std::size_t output(std::size_t program) const { return outputs_[program]; }  // the node of its value

  // Values of all nodes at up to `block` points, block numbers for each. The caller has put in the numbers of the
  // variables; set_numbers, once, those that stay.
  std::size_t table_size() const { return nodes_.size() * block; }
  void set_numbers(double* table, std::size_t points = block) const;
  void evaluate(double* table, std::size_t points) const;        // of all programs
  void evaluate_first(double* table, std::size_t points) const;  // of the first program, whose nodes come first
  // Of these those alone that mean slopes of it are made of: what is only added up is not.
  void evaluate_for_slopes(double* table, std::size_t points) const;
  bool has_sums_in_slopes() const;  // is any of these a sum, in which terms might cancel?

 private:
  using Key = std::tuple<Instruction::Kind, int, int, double, int, const FormulaFunction*>;
  using Known = std::map<Key, int>;  // which node an operation already is
  int add(const Node& node, Known& known);
  int add_program(std::span<const Instruction> program, Known& known);
  void find_partners();
  void find_factors();
  template <class IsAsked>
  void evaluate_nodes(double* table, std::size_t points, std::size_t end, const IsAsked& is_asked) const;

  int variables_;
  std::vector<Node> nodes_;
  std::vector<std::size_t> outputs_;
  std::size_t first_end_ = 0;    // behind the nodes of the first program
  std::vector<bool> in_slopes_;  // of the first program
};

}  // namespace seiche
