#include <seiche/core/base/vector.hpp>
#include <seiche/core/simd/multiversion.hpp>
#include <seiche/formula/expression_slopes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

using Kind = Instruction::Kind;
constexpr std::size_t block = ExpressionGraph::block;

// Mean slope of x^y, which is exp(y log x) where y changes: slopes of x and y go into it with these factors.
struct PowerFactors {
  double base, exponent;
};

PowerFactors power_factors(double xa, double xb, double ya, double yb, bool exponent_is_number) {
  if (exponent_is_number) return {mean_slope_of_power(xa, xb, ya), 0};
  static const FormulaFunction& exp = *find_formula_function("exp");
  static const FormulaFunction& log = *find_formula_function("log");
  const double la = std::log(xa), lb = std::log(xb);
  const double outer = exp.mean_slope(ya * la, yb * lb);
  return {outer * (ya + yb) / 2 * log.mean_slope(xa, xb), outer * (la + lb) / 2};
}

SEICHE_MULTIVERSION void take_term(const double* f, const double* x, double* out, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) out[j] = f[j] * x[j];
}
SEICHE_MULTIVERSION void add_terms(const double* f, const double* x, const double* g, const double* y, double* out,
                                   std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) out[j] = f[j] * x[j] + g[j] * y[j];
}

// Sums of products; or, with `bounds` for the factors of products, the same where no term has a sign.
template <bool unsigned_terms>
void add_up(const ExpressionGraph& graph, const double* a, const double* b, const double* bounds, int directions,
            std::size_t points, double* slopes) {
  const std::span<const ExpressionGraph::Node> nodes = graph.nodes();
  const auto width = static_cast<std::size_t>(directions) * block;
  const std::size_t last = graph.output(0);
  const auto at = [](const double* table, int node, std::size_t j) {
    return table[static_cast<std::size_t>(node) * block + j];
  };
  const auto sized = [](double x) { return unsigned_terms ? std::abs(x) : x; };
  std::array<double, block> of_f, of_g;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before they are read
  // out ← f·(slopes of x) + g·(slopes of y), where x and y are nodes and f and g functions of the point
  const auto combine = [&](std::size_t i, int x, int y, const auto& f, const auto& g) {
    double* const out = slopes + i * width;
    const auto changes = [&](int node) {
      return node >= 0 && nodes[static_cast<std::size_t>(node)].kind != Kind::number;
    };
    const double* const of_x = changes(x) ? slopes + static_cast<std::size_t>(x) * width : nullptr;
    const double* const of_y = changes(y) ? slopes + static_cast<std::size_t>(y) * width : nullptr;
    for (std::size_t j = 0; of_x != nullptr && j < points; ++j) of_f[j] = sized(f(j));
    for (std::size_t j = 0; of_y != nullptr && j < points; ++j) of_g[j] = sized(g(j));
    for (std::size_t d = 0; d < width; d += block) {
      if (of_x != nullptr && of_y != nullptr)
        add_terms(of_f.data(), of_x + d, of_g.data(), of_y + d, out + d, points);
      else if (of_x != nullptr)
        take_term(of_f.data(), of_x + d, out + d, points);
      else if (of_y != nullptr)
        take_term(of_g.data(), of_y + d, out + d, points);
      else
        std::fill_n(out + d, points, 0.0);
    }
  };
  std::array<double, block> of_call;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
  const auto none = [](std::size_t) { return 0.0; };
  const auto one = [](std::size_t) { return 1.0; };
  const auto minus_one = [](std::size_t) { return -1.0; };
  for (std::size_t i = 0; i <= last; ++i) {
    const ExpressionGraph::Node& node = nodes[i];
    const int x = node.a, y = node.b;
    const auto power = [&](int base, int exponent, std::size_t j) {
      return power_factors(at(a, base, j), at(b, base, j), at(a, exponent, j), at(b, exponent, j),
                           nodes[static_cast<std::size_t>(exponent)].kind == Kind::number);
    };
    const auto mean = [&](int of, std::size_t j) {
      if constexpr (unsigned_terms) return std::max(std::abs(at(a, of, j)), at(bounds, of, j));
      return (at(a, of, j) + at(b, of, j)) / 2;
    };
    switch (node.kind) {
      case Kind::number:
      case Kind::variable:
        for (std::size_t d = 0; d < width; d += block) std::fill_n(slopes + i * width + d, points, 0.0);
        if (node.kind == Kind::variable && node.index < directions)
          std::fill_n(slopes + i * width + static_cast<std::size_t>(node.index) * block, points, 1.0);
        break;
      case Kind::add: combine(i, x, y, one, one); break;
      case Kind::subtract: combine(i, x, y, one, minus_one); break;
      case Kind::negate: combine(i, x, -1, minus_one, none); break;
      case Kind::multiply:
        if (const int number = graph.number_in_product(node); number >= 0) {
          combine(
              i, number == x ? y : x, -1, [&](std::size_t j) { return mean(number, j); }, none);
          break;
        }
        combine(
            i, x, y, [&](std::size_t j) { return mean(y, j); }, [&](std::size_t j) { return mean(x, j); });
        break;
      case Kind::divide:  // x · (1/y)
        combine(
            i, x, y, [&](std::size_t j) { return (1 / at(a, y, j) + 1 / at(b, y, j)) / 2; },
            [&](std::size_t j) { return -mean(x, j) / (at(a, y, j) * at(b, y, j)); });
        break;
      case Kind::whole_power:
        combine(
            i, x, -1, [&](std::size_t j) { return mean_slope_of_whole_power(at(a, x, j), at(b, x, j), node.index); },
            none);
        break;
      case Kind::power:
        combine(
            i, x, y, [&](std::size_t j) { return power(x, y, j).base; },
            [&](std::size_t j) { return power(x, y, j).exponent; });
        break;
      case Kind::call: {
        const auto slope = node.function->mean_slope;
        if (node.function->mean_slopes != nullptr) {
          const auto row = static_cast<std::size_t>(x) * block;
          node.function->mean_slopes(a + row, b + row, of_call.data(), points);
          combine(
              i, x, -1, [&](std::size_t j) { return of_call[j]; }, none);
          break;
        }
        combine(
            i, x, -1,
            [&](std::size_t j) {
              return slope == nullptr ? std::numeric_limits<double>::quiet_NaN() : slope(at(a, x, j), at(b, x, j));
            },
            none);
        break;
      }
    }
  }
}

}  // namespace

void mean_slopes(const ExpressionGraph& graph, const double* a, const double* b, int directions, std::size_t points,
                 double* slopes) {
  add_up<false>(graph, a, b, nullptr, directions, points, slopes);
}

void sizes_of_slopes(const ExpressionGraph& graph, const double* at, const double* bounds, int directions,
                     std::size_t points, double* sizes) {
  add_up<true>(graph, at, at, bounds, directions, points, sizes);
}

void error_bounds(const ExpressionGraph& graph, const double* table, std::size_t points, std::size_t end,
                  double* bounds) {
  const std::span<const ExpressionGraph::Node> nodes = graph.nodes();
  const auto row = [](const auto* of, int node) {
    return node < 0 ? nullptr : of + static_cast<std::size_t>(node) * block;
  };
  for (std::size_t i = 0; i < end; ++i) {
    const ExpressionGraph::Node& node = nodes[i];
    double* const out = bounds + i * block;
    const double* const value = table + i * block;
    const double *const x = row(table, node.a), *const y = row(table, node.b);
    const double *const of_x = row(bounds, node.a), *const of_y = row(bounds, node.b);
    const auto set = [&](const auto& carried) {
      for (std::size_t j = 0; j < points; ++j) {
        const double bound = carried(j) + std::abs(value[j]);
        out[j] = std::isfinite(bound) ? bound : std::abs(value[j]);
      }
    };
    switch (node.kind) {
      case Kind::number: std::fill_n(out, points, 0.0); break;
      case Kind::variable: set([](std::size_t) { return 0.0; }); break;
      case Kind::add:
      case Kind::subtract: set([&](std::size_t j) { return of_x[j] + of_y[j]; }); break;
      case Kind::negate: std::copy_n(of_x, points, out); break;
      case Kind::multiply:
        set([&](std::size_t j) { return of_x[j] * std::abs(y[j]) + std::abs(x[j]) * of_y[j]; });
        break;
      case Kind::divide:
        set([&](std::size_t j) { return (of_x[j] + std::abs(value[j]) * of_y[j]) / std::abs(y[j]); });
        break;
      case Kind::whole_power:
        set([&](std::size_t j) {
          const double n = std::abs(node.index), size = std::abs(x[j]);
          const double most = size + epsilon * of_x[j];
          const double slope = node.index == 2  ? most
                               : node.index > 0 ? std::pow(most, n - 1)
                                                : std::abs(value[j]) / size;
          return n * (std::abs(value[j]) + (n > 0 ? slope * of_x[j] : 0.0));
        });
        break;
      case Kind::power:
        set([&](std::size_t j) {
          const double of_exponent = of_y[j] > 0 ? std::abs(std::log(x[j])) * of_y[j] : 0.0;
          return std::abs(value[j]) * (std::abs(y[j]) * of_x[j] / std::abs(x[j]) + of_exponent);
        });
        break;
      case Kind::call:
        if (const auto carried = node.function->carried; carried != nullptr)
          set([&](std::size_t j) { return carried(x[j], value[j], of_x[j]); });
        else
          set([&](std::size_t j) { return std::max(of_x[j], of_y[j]); });
        break;
    }
  }
}

void add_taylor(const ExpressionGraph& graph, std::span<const double> p, std::span<const double> q, int degree,
                double* scratch, std::span<double> coefficients) {
  const std::span<const ExpressionGraph::Node> nodes = graph.nodes();
  const auto length = static_cast<std::size_t>(degree) + 1;
  const auto row = [&](int node) { return scratch + static_cast<std::size_t>(node) * length; };
  // out ← x·y; out is neither.
  const auto multiply = [length](const double* x, const double* y, double* out) {
    for (std::size_t k = 0; k < length; ++k) {
      out[k] = 0;
      for (std::size_t i = 0; i <= k; ++i) out[k] += x[i] * y[k - i];
    }
  };
  double* const product = scratch + nodes.size() * length;
  for (std::size_t i = 0; i <= graph.output(0); ++i) {
    const ExpressionGraph::Node& node = nodes[i];
    double* const out = scratch + i * length;
    switch (node.kind) {
      case Kind::number:
      case Kind::variable: {
        std::fill_n(out, length, 0.0);
        const auto v = static_cast<std::size_t>(node.index);
        out[0] = node.kind == Kind::number ? node.number : p[v];
        if (node.kind == Kind::variable && length > 1) out[1] = q[v];
        break;
      }
      case Kind::add:
        for (std::size_t k = 0; k < length; ++k) out[k] = row(node.a)[k] + row(node.b)[k];
        break;
      case Kind::subtract:
        for (std::size_t k = 0; k < length; ++k) out[k] = row(node.a)[k] - row(node.b)[k];
        break;
      case Kind::negate:
        for (std::size_t k = 0; k < length; ++k) out[k] = -row(node.a)[k];
        break;
      case Kind::multiply: multiply(row(node.a), row(node.b), out); break;
      case Kind::divide:  // by what does not change along the line
        for (std::size_t k = 0; k < length; ++k) out[k] = row(node.a)[k] / row(node.b)[0];
        break;
      case Kind::whole_power:
        std::fill_n(out, length, 0.0);
        out[0] = node.index < 0 ? std::pow(row(node.a)[0], node.index) : 1;  // of what does not change along the line
        for (int n = 0; n < node.index; ++n) {
          multiply(out, row(node.a), product);
          std::copy_n(product, length, out);
        }
        break;
      default:  // functions and powers of what does not change along the line
        std::fill_n(out, length, 0.0);
        out[0] = node.kind == Kind::power    ? std::pow(row(node.a)[0], row(node.b)[0])
                 : node.function->arity == 2 ? node.function->two(row(node.a)[0], row(node.b)[0])
                                             : node.function->one(row(node.a)[0]);
    }
  }
  const double* const all = scratch + graph.output(0) * length;
  for (std::size_t k = 0; k < std::min(length, coefficients.size()); ++k) coefficients[k] += all[k];
}

}  // namespace seiche
