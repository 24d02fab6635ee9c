#include <seiche/core/numerics/gauss_rule.hpp>
#include <seiche/formula/cancellation.hpp>
#include <seiche/formula/expression_code.hpp>
#include <seiche/formula/expression_slopes.hpp>
#include <seiche/potential/formula_potential.hpp>
#include <seiche/potential/loops.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace seiche {
namespace {

constexpr std::size_t block = ExpressionGraph::block;
constexpr std::size_t axes = 3;

// Each thread has one, which grows to what the largest formula asks for in the worst case: later calls find it large
// enough.
std::span<double> scratch_of(std::size_t size) {
  thread_local std::vector<double> memory;
  if (memory.size() < size) memory.resize(size);
  return memory;
}

ExpressionGraph graph_of(const PointFormula& w) {
  std::vector<FormulaProgram> written = {without_cancellation(w.value->program())};
  for (const FormulaPointer& derivative : w.gradient) written.push_back(without_cancellation(derivative->program()));
  const std::vector<std::span<const Instruction>> programs(written.begin(), written.end());
  return ExpressionGraph(static_cast<int>(w.gradient.size() + axes), programs);
}

// Of the value alone, for its mean slopes: as it was written, with fewer functions, where no sum in it can cancel.
ExpressionGraph mean_graph_of(const PointFormula& w) {
  const int variables = static_cast<int>(w.gradient.size() + axes);
  ExpressionGraph as_written(variables, std::array{w.value->program()});
  if (!as_written.has_sums_in_slopes()) return as_written;
  const FormulaProgram program = without_cancellation(w.value->program());
  return {variables, std::array{std::span<const Instruction>(program)}};
}

// Of the values of so many programs from `first` on.
ExpressionCode code_of(const ExpressionGraph& graph, std::size_t first, std::size_t count) {
  std::vector<std::size_t> outputs;
  for (std::size_t program = first; program < first + count; ++program) outputs.push_back(graph.output(program));
  return {graph, outputs};
}

class FormulaPotential final : public PointwisePotential {
 public:
  FormulaPotential(PointFormula w, const Grid& grid)
      : w_(std::move(w)),
        graph_(graph_of(w_)),
        mean_graph_(mean_graph_of(w_)),
        fields_(w_.gradient.size()),
        value_(code_of(graph_, 0, 1)),
        slopes_(code_of(graph_, 1, fields_)),
        value_and_slopes_(code_of(graph_, 0, 1 + fields_)),
        mean_rule_(gauss_rule((w_.degree + 1) / 2)) {
    scratch_size_ = std::max({2 * graph_.table_size(), (2 + fields_) * mean_graph_.table_size(),
                              2 * (fields_ + axes) + taylor_scratch_size(graph_, w_.degree),
                              value_and_slopes_.table_size(), slopes_.table_size(), value_.table_size()});
    if (!w_.uses_place) return;
    const Index n = grid.unknowns();
    for (Index a = 0; a < grid.dimension(); ++a) {
      places_.emplace_back(static_cast<std::size_t>(n));
      for (Index j = 0; j < n; ++j) places_.back()[static_cast<std::size_t>(j)] = grid.coordinate(j, a);
    }
  }

  FormulaPotential(FormulaPotential all, Index first, Index count) : FormulaPotential(std::move(all)) {
    for (std::vector<double>& coordinates : places_)
      coordinates = {coordinates.begin() + first, coordinates.begin() + first + count};
  }

  Index fields() const override { return static_cast<Index>(fields_); }
  bool is_pointwise() const override { return true; }
  std::shared_ptr<const PointwisePotential> at_points(Index first, Index count) const override {
    return w_.uses_place ? std::make_shared<const FormulaPotential>(*this, first, count) : nullptr;
  }
  bool is_local() const override { return fields_ == 1 && !w_.uses_place; }
  int degree() const override { return w_.degree; }
  int homogeneity() const override { return w_.homogeneity; }
  bool grows_outward() const override { return w_.grows_outward; }
  bool grows_outward_from(Index first) const override {
    if (first == 0) return w_.grows_outward;
    const auto field = static_cast<std::size_t>(first);
    return field < w_.grows_outward_from.size() && w_.grows_outward_from[field];
  }

  double value(std::span<const double> u) const override {
    return sum(u, [&](double* table, std::size_t, std::size_t points) {
      value_.run(table, points);
      return total(value_.value(0), table, points);
    });
  }

  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    LongSum bounds;
    set_numbers(graph_, u.size());
    const double value = sum(u, [&](double* table, std::size_t, std::size_t points) {
      double* const of_nodes = table + graph_.table_size();
      graph_.evaluate_first(table, points);
      error_bounds(graph_, table, points, graph_.output(0) + 1, of_nodes);
      bounds.add(total(value_row(of_nodes), points));
      return total(value_row(table), points);
    });
    return {value, bounds.total()};
  }

  // Of ∇W itself, and of the sums that make a mean slope.
  void gradient_round_off(std::span<const double> u, std::span<double> bounds) const override {
    const std::size_t n = u.size() / fields_;
    sum(u, [&](double* table, std::size_t begin, std::size_t points) {
      double* of_nodes = table + graph_.table_size();
      graph_.set_numbers(table, points);
      graph_.evaluate(table, points);
      error_bounds(graph_, table, points, graph_.nodes().size(), of_nodes);
      for (std::size_t f = 0; f < fields_; ++f)
        std::copy_n(of_nodes + graph_.output(1 + f) * block, points, bounds.data() + f * n + begin);
      of_nodes = table + mean_graph_.table_size();
      double* const slopes = of_nodes + mean_graph_.table_size();
      mean_graph_.set_numbers(table, points);
      mean_graph_.evaluate(table, points);
      error_bounds(mean_graph_, table, points, mean_graph_.nodes().size(), of_nodes);
      sizes_of_slopes(mean_graph_, table, of_nodes, static_cast<int>(fields_), points, slopes);
      for (std::size_t f = 0; f < fields_; ++f) {
        const double* const mean = slopes + (mean_graph_.output(0) * fields_ + f) * block;
        for (std::size_t j = 0; j < points; ++j)
          if (std::isfinite(mean[j])) bounds[f * n + begin + j] = std::max(bounds[f * n + begin + j], mean[j]);
      }
      return 0.0;
    });
  }

  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    return slopes(1, 1, u, gradient);
  }

  double value_and_gradient_in_place(double in, double out, std::span<double> values) const override {
    return slopes(in, out, values, values);
  }

  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    if (fields_ > 1 && w_.degree > 0) {
      mean_by_quadrature(a, b, mean);
    } else {
      mean_by_slopes(a, b, mean);
    }
  }

  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override {
    if (w_.degree == 0) {
      std::fill(coefficients.begin(), coefficients.end(), 0.0);
      return;
    }
    const std::size_t variables = fields_ + axes;
    const std::span<double> memory = scratch_of(scratch_size_);
    const std::span<double> here = memory.first(variables);
    const std::span<double> way = memory.subspan(variables, variables);
    std::fill_n(memory.begin(), 2 * variables, 0.0);
    const std::size_t n = p.size() / fields_;
    sum_coefficients(n, coefficients, [&](std::size_t j, double* into) {
      for (std::size_t f = 0; f < fields_; ++f) {
        here[f] = p[f * n + j];
        way[f] = q[f * n + j];
      }
      for (std::size_t a = 0; a < places_.size(); ++a) here[fields_ + a] = places_[a][j];
      add_taylor(graph_, here, way, w_.degree, memory.data() + 2 * variables, {into, coefficients.size()});
    });
  }

 private:
  const double* value_row(const double* table) const { return table + graph_.output(0) * block; }

  SEICHE_MULTIVERSION static double total(const double* values, std::size_t points) {
    LaneSums sums;
    for_points(0, points, [&](std::size_t j, std::size_t lane) { sums[lane] += values[j]; });
    return sums.total();
  }
  static double total(const ExpressionCode::Value& value, const double* table, std::size_t points) {
    if (value.row < 0) return value.factor * static_cast<double>(points);
    return value.factor * total(table + static_cast<std::size_t>(value.row) * block, points);
  }

  SEICHE_MULTIVERSION static void put_between(double theta, const double* a, const double* b, double* out,
                                              std::size_t points) {
    for (std::size_t j = 0; j < points; ++j) out[j] = a[j] + theta * (b[j] - a[j]);
  }

  // out ← or += factor · value
  template <bool adds = false>
  static void put_out(const ExpressionCode::Value& value, double factor, const double* table, double* out,
                      std::size_t points) {
    factor *= value.factor;
    if (value.row >= 0)
      multiply_row<adds>(factor, table + static_cast<std::size_t>(value.row) * block, out, points);
    else
      for (std::size_t j = 0; j < points; ++j) out[j] = adds ? out[j] + factor : factor;
  }
  template <bool adds>
  SEICHE_MULTIVERSION static void multiply_row(double factor, const double* row, double* out, std::size_t points) {
    for (std::size_t j = 0; j < points; ++j) out[j] = adds ? out[j] + factor * row[j] : factor * row[j];
  }

  // Fields in the order of u, times `factor`, and the place, into the rows of the variables.
  void put_in(double* table, std::span<const double> u, double factor, std::size_t begin, std::size_t points) const {
    const std::size_t n = u.size() / fields_;
    for (std::size_t f = 0; f < fields_; ++f)
      for (std::size_t j = 0; j < points; ++j) table[f * block + j] = factor * u[f * n + begin + j];
    for (std::size_t a = 0; a < places_.size(); ++a)
      std::copy_n(places_[a].data() + begin, points, table + (fields_ + a) * block);
  }
  // What stays from block to block of n points in all: no place, and the numbers of a graph, in the first table or the
  // second.
  void set_no_place(double* table, std::size_t n) const {
    for (std::size_t a = places_.size(); a < axes; ++a)
      std::fill_n(table + (fields_ + a) * block, std::min(block, n), 0.0);
  }
  void set_numbers(const ExpressionGraph& graph, std::size_t size, std::size_t table = 0) const {
    graph.set_numbers(scratch_of(scratch_size_).data() + table * graph.table_size(), std::min(block, size / fields_));
  }

  // Σ visit(table, first point, points) over the blocks, with u in the first of 2 + fields_ tables.
  template <class Visit>
  double sum(std::span<const double> u, const Visit& visit, double factor = 1) const {
    double* const table = scratch_of(scratch_size_).data();
    const std::size_t n = u.size() / fields_;
    set_no_place(table, n);
    LongSum all;
    for (std::size_t begin = 0; begin < n; begin += block) {
      const std::size_t points = std::min(block, n - begin);
      put_in(table, u, factor, begin, points);
      all.add(visit(table, begin, points));
    }
    return all.total();
  }

  double slopes(double in, double out, std::span<const double> u, std::span<double> gradient) const {
    const std::size_t n = u.size() / fields_;
    return sum(
        u,
        [&](double* table, std::size_t begin, std::size_t points) {
          value_and_slopes_.run(table, points);
          for (std::size_t f = 0; f < fields_; ++f)
            put_out(value_and_slopes_.value(1 + f), out, table, gradient.data() + f * n + begin, points);
          return total(value_and_slopes_.value(0), table, points);
        },
        in);
  }

  void mean_by_slopes(std::span<const double> a, std::span<const double> b, std::span<double> mean) const {
    const std::size_t n = a.size() / fields_;
    for (const std::size_t table : {0, 1}) set_numbers(mean_graph_, a.size(), table);
    set_no_place(scratch_of(scratch_size_).data() + mean_graph_.table_size(), n);
    sum(a, [&](double* at_a, std::size_t begin, std::size_t points) {
      double* const at_b = at_a + mean_graph_.table_size();
      double* const slopes = at_b + mean_graph_.table_size();
      put_in(at_b, b, 1, begin, points);
      mean_graph_.evaluate_for_slopes(at_a, points);
      mean_graph_.evaluate_for_slopes(at_b, points);
      mean_slopes(mean_graph_, at_a, at_b, static_cast<int>(fields_), points, slopes);
      for (std::size_t f = 0; f < fields_; ++f)
        std::copy_n(slopes + (mean_graph_.output(0) * fields_ + f) * block, points, mean.data() + f * n + begin);
      return 0.0;
    });
  }

  void mean_by_quadrature(std::span<const double> a, std::span<const double> b, std::span<double> mean) const {
    const std::size_t n = a.size() / fields_;
    sum(a, [&](double* table, std::size_t begin, std::size_t points) {
      for (std::size_t f = 0; f < fields_; ++f) std::fill_n(mean.data() + f * n + begin, points, 0.0);
      for (const auto& [node, weight] : mean_rule_) {
        for (std::size_t f = 0; f < fields_; ++f)
          put_between(node, &a[f * n + begin], &b[f * n + begin], table + f * block, points);
        slopes_.run(table, points);
        for (std::size_t f = 0; f < fields_; ++f)
          put_out<true>(slopes_.value(f), weight, table, mean.data() + f * n + begin, points);
      }
      return 0.0;
    });
  }

  PointFormula w_;
  ExpressionGraph graph_;  // of the value and its slopes, rewritten so that their terms do not cancel
  ExpressionGraph mean_graph_;
  std::size_t fields_, scratch_size_ = 0;
  ExpressionCode value_, slopes_, value_and_slopes_;
  std::vector<GaussNode> mean_rule_;         // for polynomials
  std::vector<std::vector<double>> places_;  // by axis; empty unless W asks
};

}  // namespace

std::shared_ptr<const PointwisePotential> formula_potential(const PointFormula& w, const Grid& grid) {
  return std::make_shared<FormulaPotential>(w, grid);
}

}  // namespace seiche
