#include <seiche/core/base/error.hpp>
#include <seiche/core/grid/fourier_multiplier.hpp>
#include <seiche/core/grid/line_modes.hpp>
#include <seiche/core/text/number_text.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace seiche {
namespace {

std::string shown(const WaveVector& kappa, Index dimension) {
  if (dimension == 1) return fmt::format("k_x = {:.6g}", kappa[0]);
  return fmt::format("(k_x, k_y{}) = ({:.6g})", dimension > 2 ? ", k_z" : "",
                     fmt::join(kappa.begin(), kappa.begin() + dimension, ", "));
}

std::string rounded(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : number_text(value); }

WaveVector along(const WaveVector& direction, double size) {
  return {size * direction[0], size * direction[1], size * direction[2]};
}

// The limit of f(x) for x → 0, x > 0, where f has a power series in x: Romberg's extrapolation from seven values at x,
// x/2, …, for every x over many octaves. Where x is large f may look like another function, where it is small
// differences of nearly equal numbers lose all digits: from small x on, the first is taken at which the last two
// extrapolations agree, and better ones next to it.
constexpr double settled = 1e-9;
struct Limit {
  double value = 0, uncertainty = std::numeric_limits<double>::infinity();  // the latter relative to f there
};

Limit extrapolated(std::span<const double> values) {
  std::array<double, 7> row{};
  double before = 0, here = 0, size = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    before = here;
    here = values[i];
    size = std::max(size, std::abs(here));
    double power = 1;
    for (std::size_t j = 0; j < i; ++j) {
      power *= 2;
      const double better = here + (here - row[j]) / (power - 1);
      row[j] = std::exchange(here, better);
    }
    row[i] = here;
  }
  if (!(size > 0) || !std::isfinite(here)) return {};  // nothing is left of f, or too much
  return {here, std::abs(here - before) / size};
}

Limit limit_of(const std::function<double(double)>& f, double middle) {
  constexpr std::size_t octaves = 56, points = 7;
  const double unlike = 1.2345 * middle;  // no zero of a sine
  std::array<double, octaves> values{};
  for (std::size_t i = 0; i < octaves; ++i) values[i] = f(std::ldexp(unlike, 24 - static_cast<int>(i)));
  Limit best;
  for (std::size_t begin = octaves - points + 1; begin-- > 0;) {
    const Limit here = extrapolated(std::span(values).subspan(begin, points));
    if (here.uncertainty < best.uncertainty)
      best = here;
    else if (best.uncertainty <= settled)
      return best;
  }
  if (std::all_of(values.begin(), values.end(), [](double value) { return value == 0; })) return {0, 0};
  // k² log k has no power series, and falls all the same.
  const auto small = values.begin() + 40;
  const bool falls = std::is_sorted(small, values.end(), [](double a, double b) { return std::abs(a) > std::abs(b); });
  if (!(best.uncertainty <= settled) && falls && std::abs(values.back()) < 1e-4 * std::abs(*small)) return {0, 0};
  return best;
}

// Column k of the complex exponentials, sines or cosines of an axis, orthonormal; and the mode that it is.
Eigen::MatrixXcd full_line(const GridAxis& axis) {
  if (axis.boundary != Boundary::periodic) return line_modes(axis).cast<std::complex<double>>();
  const Index n = axis.intervals;
  Eigen::MatrixXcd modes(n, n);
  const double scale = 1 / std::sqrt(static_cast<double>(n));
  for (Index k = 0; k < n; ++k)
    for (Index j = 0; j < n; ++j)
      modes(j, k) = scale * std::complex<double>(sin_pi(4 * (j * k % n) + n, 2 * n), sin_pi(2 * (j * k % n), n));
  return modes;
}

Eigen::MatrixXcd kronecker(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  Eigen::MatrixXcd product(a.rows() * b.rows(), a.cols() * b.cols());
  for (Index i = 0; i < a.rows(); ++i)
    for (Index j = 0; j < a.cols(); ++j) product.block(i * b.rows(), j * b.cols(), b.rows(), b.cols()) = a(i, j) * b;
  return product;
}

}  // namespace

FourierMultiplier::FourierMultiplier(const Grid& grid, WaveFunction f, Parity parity)
    : f_(std::move(f)), parity_(parity) {
  if (grid.only_numbers) throw Error("a function of the wave number needs a grid with places");
  if (parity == Parity::odd && !grid.is_periodic())
    throw Error("an odd function of the wave number needs a grid that is periodic along every axis");
  for (Index a = 0; a < grid.dimension(); ++a) {
    dx_[static_cast<std::size_t>(a)] = grid.axis(a).dx();
    periodic_[static_cast<std::size_t>(a)] = grid.axis(a).boundary == Boundary::periodic;
  }
  if (parity == Parity::even) at_zero_ = limit_at_zero(grid);
  const Modes modes(grid);
  // Parity is looked at on some of the modes, evenly; whether f is finite, on all.
  constexpr Index most = 4096;
  const Index stride = (modes.count() + most - 1) / most;
  for (Index k = 0; k < modes.count(); ++k) {
    const Mode mode = modes[k];
    const WaveVector kappa = wave_vector(mode);
    if (k % stride == 0) require_parity(grid, kappa);
    if (!std::isfinite(value(mode)))
      throw Error("the function of the wave number is {} at {}", number_text(value(mode)),
                  shown(kappa, grid.dimension()));
  }
}

void FourierMultiplier::require_parity(const Grid& grid, const WaveVector& kappa) const {
  constexpr double round_off = 1e-10;
  if (kappa == WaveVector{}) return;
  const auto require = [&](const WaveVector& mirrored, double sign, const char* why) {
    const double here = f_(kappa), there = f_(mirrored);
    if (!std::isfinite(here) && !std::isfinite(there)) return;  // said of the mean over both
    if (std::abs(there - sign * here) <= round_off * std::max(std::abs(here), std::abs(there))) return;
    throw Error("the function of the wave number is {} at {} and {} at {}: {}", rounded(here),
                shown(kappa, grid.dimension()), rounded(there), shown(mirrored, grid.dimension()), why);
  };
  require(along(kappa, -1), parity_ == Parity::even ? 1 : -1,
          parity_ == Parity::even
              ? "of a real operator it is even, as that of k_x^2 or abs(k_x) is"
              : "beside an odd number of derivatives stands an even function, or the operator is not real");
  if (grid.is_periodic()) return;
  for (Index a = 0; a < grid.dimension(); ++a) {
    WaveVector mirrored = kappa;
    mirrored[static_cast<std::size_t>(a)] *= -1;
    require(mirrored, 1, "between ends it is even along every axis");
  }
}

double FourierMultiplier::limit_at_zero(const Grid& grid) const {
  const double there = f_({});
  if (std::isfinite(there)) return there;
  double longest = 0;
  for (const GridAxis& axis : grid.axes) {
    if (axis.boundary == Boundary::dirichlet) return 0;  // no mode is constant there
    longest = std::max(longest, axis.length);
  }
  // Axes, diagonals, and directions between them.
  const std::vector<WaveVector> line = {{1, 0, 0}};
  const std::vector<WaveVector> plane = {{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, -1, 0}, {1, 0.4, 0}, {1, -0.4, 0}};
  const std::vector<WaveVector> space = {{1, 0, 0},   {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, -1, 1},    {1, 1, -1},
                                         {1, -1, -1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, 0.4, 0.7}, {1, -0.4, 0.7}};
  const Index dimension = grid.dimension();
  const std::vector<WaveVector>& directions = dimension == 1 ? line : dimension == 2 ? plane : space;
  constexpr double alike = 1e-7;
  double first = 0;
  for (const WaveVector& direction : directions) {
    const Limit limit = limit_of([&](double s) { return f_(along(direction, s)); }, 2 * std::numbers::pi / longest);
    if (!(limit.uncertainty <= settled))
      throw Error("the function of the wave number is {} at k = 0, and no limit there was found", number_text(there));
    if (&direction == directions.data()) first = limit.value;
    if (std::abs(limit.value - first) > alike * std::max(std::abs(limit.value), std::abs(first)))
      throw Error(
          "the function of the wave number has no limit at k = 0: from one side it is {:.6g} there, from another {:.6g}",
          first, limit.value);
  }
  return first;
}

WaveVector FourierMultiplier::wave_vector(const Mode& mode) const {
  WaveVector kappa{};
  for (std::size_t a = 0; a < kappa.size(); ++a) {
    const Index k = 2 * mode.k[a] > mode.period[a] ? mode.k[a] - mode.period[a] : mode.k[a];
    kappa[a] = 2 * std::numbers::pi * static_cast<double>(k) / (static_cast<double>(mode.period[a]) * dx_[a]);
  }
  return kappa;
}

double FourierMultiplier::value(const Mode& mode) const {
  const WaveVector kappa = wave_vector(mode);
  if (kappa == WaveVector{}) return at_zero_;
  double sum = 0;
  int count = 0;
  for (unsigned flips = 0; flips < 8; ++flips) {  // of the highest wave numbers
    WaveVector at = kappa;
    bool applies = true;
    for (std::size_t a = 0; a < at.size(); ++a) {
      if ((flips >> a & 1U) == 0) continue;
      applies = applies && periodic_[a] && 2 * mode.k[a] == mode.period[a];
      at[a] = -at[a];
    }
    if (!applies) continue;
    sum += f_(at);
    ++count;
  }
  return sum / count;
}

std::complex<double> FourierMultiplier::symbol(const Mode& mode) const {
  return parity_ == Parity::even ? std::complex<double>(value(mode), 0) : std::complex<double>(0, value(mode));
}

// Of every mode of full_line along every axis, the last axis running fastest.
Eigen::VectorXcd FourierMultiplier::symbols_in_full(const Grid& grid) const {
  Eigen::VectorXcd symbols(grid.unknowns());
  for (Index i = 0; i < symbols.size(); ++i) {
    Mode mode;
    Index rest = i;
    for (Index a = grid.dimension() - 1; a >= 0; --a) {
      const auto at = static_cast<std::size_t>(a);
      const GridAxis& axis = grid.axis(a);
      mode.k[at] = rest % axis.unknowns() + (axis.boundary == Boundary::dirichlet ? 1 : 0);
      mode.period[at] = periodic_[at] ? axis.intervals : 2 * axis.intervals;
      rest /= axis.unknowns();
    }
    symbols[i] = symbol(mode);
  }
  return symbols;
}

Eigen::MatrixXd FourierMultiplier::matrix(const Grid& grid) const {
  Eigen::MatrixXcd modes = Eigen::MatrixXcd::Ones(1, 1);
  for (const GridAxis& axis : grid.axes) modes = kronecker(modes, full_line(axis));
  const Eigen::VectorXcd symbols = symbols_in_full(grid);
  if (!grid.is_periodic()) return (modes * symbols.asDiagonal() * modes.adjoint()).real();

  // Entry (i, j) depends on the way from j to i alone: the first column has them all.
  const Index n = grid.unknowns();
  const Vector column = (modes * (symbols.array() * modes.row(0).adjoint().array()).matrix()).real();
  Eigen::MatrixXd a(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      Index way = 0, stride = 1, from = j, to = i;
      for (Index b = grid.dimension() - 1; b >= 0; --b) {
        const Index points = grid.axis(b).intervals;
        way += ((to - from) % points + points) % points * stride;
        from /= points;
        to /= points;
        stride *= points;
      }
      a(i, j) = column[way];
    }
  return a;
}

}  // namespace seiche
