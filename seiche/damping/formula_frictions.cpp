#include <seiche/core/text/number_text.hpp>
#include <seiche/damping/formula_frictions.hpp>

#include <fmt/format.h>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace seiche {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// 0 and ± 10ˣ, −4 ≤ x ≤ 3, in rising order: where the sign of a formula is looked at. Of 0 alone if it does not matter.
std::vector<double> sizes_to_try(bool matters, int per_decade) {
  std::vector<double> sizes = {0.0};
  for (int k = -4 * per_decade; matters && k <= 3 * per_decade; ++k)
    for (const double sign : {-1.0, 1.0}) sizes.push_back(sign * std::pow(10.0, static_cast<double>(k) / per_decade));
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

// An x where f is not ≥ 0: 0, which says most to a reader, one of the rising `places`, or between two of them where f
// dips; nothing where none is found.
template <class F>
std::optional<double> find_negative(const std::vector<double>& places, const F& f) {
  constexpr int bits = 24;
  if (!(f(0.0) >= 0)) return 0.0;
  double before = 0, here = 0;  // f at the last two places
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double next = f(places[i]);
    if (!(next >= 0)) return places[i];
    if (i >= 2 && here <= before && here <= next) {
      const auto [x, value] = boost::math::tools::brent_find_minima(f, places[i - 2], places[i], bits);
      if (!(value >= 0)) return x;
    }
    before = here;
    here = next;
  }
  return std::nullopt;
}

class FormulaFriction : public Friction {
 public:
  FormulaFriction(FrictionFormula formula, const Grid& grid) : f_(std::move(formula)) {
    for (Index j = 0; j < grid.unknowns(); ++j) places_.push_back(grid.place(j));
  }
  FormulaFriction(const FormulaFriction& other) : Friction(other), f_(other.f_), places_(other.places_) {}  // fed_ anew
  FormulaFriction& operator=(const FormulaFriction&) = delete;

  void force(double t, std::span<const double> q, std::span<const double> v, std::span<double> r) const override {
    for (std::size_t i = 0; i < v.size(); ++i) {
      r[i] = rate(t, q[i], v[i], place(i));
      see(t, v[i], r[i]);
    }
  }
  bool uses_coordinates() const override { return f_.uses_u; }
  bool uses_place() const override { return f_.uses_place; }
  bool is_dissipative() const override { return false; }  // a formula has no form to judge by
  std::string fed_at() const override {
    const double t = fed_.load(std::memory_order_relaxed);
    return std::isnan(t) ? "" : fmt::format("t = {:.6g}", t);
  }

  void forget_fed() const override { fed_.store(nan, std::memory_order_relaxed); }

  std::string feeds_at(double t_end) const override {
    if (places_.empty()) return "";
    constexpr std::size_t most_places = 16, most_tries = 1U << 21U, least_times = 64;
    constexpr int fine = 128, coarse = 8;  // places in a decade, of one variable or of each of two
    const std::size_t stride = f_.uses_place ? std::max<std::size_t>(1, places_.size() / most_places) : places_.size();
    const bool by_speed = !is_proportional();  // else v > 0 says all, and the sign is that of a function of u
    const int density = by_speed && f_.uses_u ? coarse : fine;
    const std::vector<double> speeds = by_speed ? sizes_to_try(true, density) : std::vector{1.0};
    const std::vector<double> coordinates = sizes_to_try(f_.uses_u, density);
    const std::size_t per_time = (places_.size() / stride) * speeds.size() * coordinates.size();
    const std::size_t times = f_.uses_t ? std::clamp(most_tries / per_time, least_times, std::size_t{4096}) : 1;
    constexpr double golden = 0.6180339887498949;  // its multiples avoid every period
    for (std::size_t n = 0; n < times; ++n) {
      const double fraction = static_cast<double>(n) * golden;
      const double t = t_end * (fraction - std::floor(fraction));
      for (std::size_t j = 0; j < places_.size(); j += stride)
        if (std::string found = feeds_at(t, places_[j], speeds, coordinates); !found.empty()) return found;
    }
    return "";
  }

 protected:
  virtual bool is_proportional() const { return false; }  // to v
  // R at one point.
  virtual double rate(double t, double u, double v, const Place& place) const = 0;

  double formula(double t, double u, double v, const Place& place) const {
    const std::array<double, 6> arguments = {v, u, t, place[0], place[1], place[2]};
    return (*f_.formula)(arguments);
  }
  const Place& place(std::size_t i) const { return places_[i % places_.size()]; }
  const std::string& formula_text() const { return f_.formula->text(); }
  void see(double t, double v, double r) const {
    if (v * r < 0) fed_.store(t, std::memory_order_relaxed);
  }

 private:
  std::string feeds_at(double t, const Place& place, const std::vector<double>& speeds,
                       const std::vector<double>& coordinates) const {
    const auto feeds = [&](double u, double v) { return witness(t, u, v, rate(t, u, v, place)); };
    if (speeds.size() == 1) {
      const double v = speeds.front();
      const auto u = find_negative(coordinates, [&](double at) { return v * rate(t, at, v, place); });
      return u ? feeds(*u, v) : "";
    }
    // r/v has the sign of v·r, and no dip at v = 0 for its being small there.
    for (const double u : coordinates)
      if (const auto v = find_negative(speeds, [&](double at) {
            return at == 0 ? 0.0 * rate(t, u, at, place) : rate(t, u, at, place) / at;
          }))
        return feeds(u, *v);
    return "";
  }

  std::string witness(double t, double u, double v, double r) const {
    std::string text = fmt::format("v = {:.4g}", v);
    if (f_.uses_u) text += fmt::format(", u = {:.4g}", u);
    if (f_.uses_t) text += fmt::format(", t = {:.4g}", t);
    return text + (std::isfinite(r) ? fmt::format(", where v·R = {:.4g}", v * r)
                                    : fmt::format(", where R = {}", number_text(r)));
  }

  FrictionFormula f_;
  std::vector<Place> places_;
  mutable std::atomic<double> fed_ = nan;  // the last time at which v·R < 0 was met
};

class PositionFriction final : public FormulaFriction {
 public:
  using FormulaFriction::FormulaFriction;

  void flow(double t, double h, double w, std::span<const double> q, std::span<double> v) const override {
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double c = formula(t + h / 2, q[i], 0, place(i));
      see(t, 1, c);
      v[i] *= std::exp(-w * c * h);
    }
  }
  std::string text() const override { return fmt::format("({})·v", formula_text()); }
  FrictionPointer with_own_memory() const override { return std::make_shared<PositionFriction>(*this); }

 private:
  bool is_proportional() const override { return true; }
  double rate(double t, double u, double v, const Place& place) const override { return formula(t, u, 0, place) * v; }
};

class VelocityFriction final : public FormulaFriction {
 public:
  using FormulaFriction::FormulaFriction;

  void flow(double t, double h, double w, std::span<const double> q, std::span<double> v) const override {
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto r = [&](double m) { return formula(t + h / 2, q[i], m, place(i)); };
      const double m = midpoint(v[i], w * h / 2, r);
      see(t, m, r(m));
      v[i] = 2 * m - v[i];
    }
  }
  std::string text() const override { return formula_text(); }
  FrictionPointer with_own_memory() const override { return std::make_shared<VelocityFriction>(*this); }

 private:
  double rate(double t, double u, double v, const Place& place) const override { return formula(t, u, v, place); }

  // The root m of g(m) = m − v + s r(m): between 0 and v where r opposes v. Elsewhere it is looked for on the side of v
  // to which g falls in size, within |g(v)| where r rises.
  template <class R>
  static double midpoint(double v, double s, const R& r) {
    const auto g = [&](double m) { return (m - v) + s * r(m); };
    const double at_v = g(v);
    if (at_v == 0 || !std::isfinite(at_v)) return at_v == 0 ? v : nan;
    constexpr int most_doublings = 60;
    double reach = std::abs(at_v);
    double end = 0, at_end = g(0);
    for (int i = 0; i < most_doublings && (at_end > 0) == (at_v > 0) && at_end != 0; ++i, reach *= 2) {
      end = at_v > 0 ? v - reach : v + reach;
      at_end = g(end);
    }
    if (!std::isfinite(at_end)) return nan;
    if (at_end == 0) return end;
    if ((at_end > 0) == (at_v > 0)) return nan;
    constexpr int all_digits = std::numeric_limits<double>::digits - 1;
    std::uintmax_t iterations = 100;
    const boost::math::tools::eps_tolerance<double> tolerance(all_digits);
    const auto [low, high] = end < v
                                 ? boost::math::tools::toms748_solve(g, end, v, at_end, at_v, tolerance, iterations)
                                 : boost::math::tools::toms748_solve(g, v, end, at_v, at_end, tolerance, iterations);
    return (low + high) / 2;
  }
};

}  // namespace

FrictionPointer position_friction(FrictionFormula c, const Grid& grid) {
  return std::make_shared<PositionFriction>(std::move(c), grid);
}

FrictionPointer formula_friction(FrictionFormula r, const Grid& grid) {
  return std::make_shared<VelocityFriction>(std::move(r), grid);
}

}  // namespace seiche
