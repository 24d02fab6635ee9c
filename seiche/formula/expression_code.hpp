// Some values of an expression graph as straight-line code: what is evaluated in every step of a run.
#pragma once

#include <seiche/formula/expression_graph.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace seiche {

// A few rows of `block` points take turns, so that they stay in the first-level cache. Powers are products that share
// their factors, numbers stand in the operations, and constant factors are multiplied only where a sum needs them:
// values differ from those of the graph by round-off.
class ExpressionCode {
 public:
  static constexpr std::size_t block = ExpressionGraph::block;

  ExpressionCode(const ExpressionGraph& graph, std::span<const std::size_t> nodes);

  // Rows of the table, of which the first are those of the variables. Where `points` is no multiple of eight, `run`
  // repeats the last point up to the next one.
  std::size_t table_size() const { return rows_ * block; }
  void run(double* table, std::size_t points) const;

  struct Value {  // factor · row; without a row, −1, the number `factor`
    double factor = 0;
    int row = -1;
  };
  const Value& value(std::size_t node) const { return values_[node]; }  // of the node in this place of the list

  struct Operation {
    enum class Kind {
      fill,            // c
      affine,          // c + a x
      linear,          // a x + b z + c
      product,         // x y
      product_affine,  // c + a x y
      product_linear,  // a x y + b z + c
      quotient,        // x / y
      reciprocal,      // 1 / x
      power,           // x^y, here and below by a call
      whole_power,     // xⁿ
      call,            // f(x), or f(x, y)
      sine_and_cosine  // of x, into out and z
    };
    Kind kind = Kind::fill;
    int x = -1, y = -1, z = -1, out = -1;
    double a = 0, b = 0, c = 0;
    int n = 0;
    const FormulaFunction* function = nullptr;
  };
  std::span<const Operation> operations() const { return operations_; }

 private:
  int variables_;
  std::vector<Operation> operations_;
  std::vector<Value> values_;
  std::size_t rows_ = 0;
};

}  // namespace seiche
