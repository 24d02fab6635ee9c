#include <seiche/core/base/error.hpp>
#include <seiche/core/numerics/gauss_rule.hpp>
#include <seiche/potential/own_potential.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

namespace seiche {
namespace {

using ConstMap = Eigen::Map<const Vector>;
using Map = Eigen::Map<Vector>;

ConstMap vector(std::span<const double> u) { return {u.data(), std::ssize(u)}; }
Map vector(std::span<double> u) { return {u.data(), std::ssize(u)}; }
std::span<const double> span(const Vector& u) { return {u.data(), static_cast<std::size_t>(u.size())}; }
std::span<double> span(Vector& u) { return {u.data(), static_cast<std::size_t>(u.size())}; }

class Own final : public PointwisePotential {
 public:
  explicit Own(OwnPotential own) : own_(std::move(own)) {}

  Index fields() const override { return own_.fields; }
  double value(std::span<const double> u) const override { return own_.value(u); }

  // What round-off in u makes of V, u·∇V, is counted by the sizes of its terms.
  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    Vector slope(std::ssize(u));
    const double v = value_and_gradient(u, span(slope));
    return {v, (std::abs(v) + vector(u).cwiseAbs().dot(slope.cwiseAbs())) * (precision_ / epsilon)};
  }

  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    own_.gradient(u, gradient);
    return own_.value(u);
  }
  void gradient(std::span<const double> u, std::span<double> out) const override { own_.gradient(u, out); }

  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    const Vector step = vector(b) - vector(a);
    Vector at(step.size()), slope(step.size()), sum = Vector::Zero(step.size());
    for (const GaussNode& node : rule_) {
      at = vector(a) + node.place * step;
      own_.gradient(span(at), span(slope));
      sum += node.weight * slope;
    }
    const double va = own_.value(a);
    const double vb = own_.value(b);
    const double defect = (vb - va) - sum.dot(step);
    const double round_off = 8 * precision_ * (std::abs(va) + std::abs(vb) + sum.cwiseAbs().dot(step.cwiseAbs()));
    if (std::abs(defect) > round_off) sum += (defect / step.squaredNorm()) * step;
    vector(mean) = sum;
  }

  std::string complaint(std::span<const double> u) const override {
    if (checked_) return "";  // the functions are the same at every start
    std::string text = gradient_complaint(own_, u);
    checked_ = text.empty();
    precision_ = relative_precision(own_, u);
    return text;
  }

  int degree() const override { return 0; }
  void along(std::span<const double>, std::span<const double>, std::span<double> coefficients) const override {
    std::fill(coefficients.begin(), coefficients.end(), 0.0);
  }
  bool grows_outward() const override { return own_.grows_outward; }

 private:
  OwnPotential own_;
  mutable std::atomic<bool> checked_ = false;
  mutable std::atomic<double> precision_ = epsilon;  // of V, once it was looked at
  std::vector<GaussNode> rule_ = gauss_rule(4);
};

// Of a state, for lengths on it.
double size_of(const Vector& u) {
  const double largest = u.size() > 0 ? u.lpNorm<Eigen::Infinity>() : 0.0;
  return largest > 0 ? largest : 1.0;
}

// V is asked for as far as three of these from a state: it need not exist farther away.
double probe_length(const Vector& u) { return 1e-3 * std::max(size_of(u), 1e-3); }

double precision_of(std::span<const double> values) {
  const auto is_single = [](double x) { return static_cast<double>(static_cast<float>(x)) == x; };
  return std::all_of(values.begin(), values.end(), is_single) ? std::numeric_limits<float>::epsilon() : epsilon;
}

// ∂V/∂(direction) at u by differences over ±d and ±2d, with the round-off of that: fourth differences of a smooth V are
// next to nothing, so that they show how much of V is noise, as of terms that cancel. Noise of single precision may be
// the same in all values, and is told by their digits.
struct Slope {
  double value, round_off;
};
Slope slope_along(const OwnPotential& own, const Vector& u, const Vector& direction, double d) {
  std::array<double, 7> v{};  // at −3d … 3d
  for (std::size_t k = 0; k < v.size(); ++k)
    v[k] = own.value(span(Vector(u + (static_cast<double>(k) - 3) * d * direction)));
  double noise = 0;
  for (std::size_t k = 0; k + 4 < v.size(); ++k)
    noise = std::max(noise, std::abs((v[k] + v[k + 4]) - 4 * (v[k + 1] + v[k + 3]) + 6 * v[k + 2]));
  const double difference = (8 * (v[4] - v[2]) - (v[5] - v[1])) / (12 * d);
  return {difference, (2 * noise + 8 * precision_of(v) * std::abs(v[3])) / d};
}

// How far apart a claimed slope and the differences are, where they are: over a step of d and over a shorter one, since
// what shrinks with the step is a kink nearby, or the error of the differences.
std::optional<double> slope_instead(const OwnPotential& own, const Vector& u, const Vector& direction, double claimed,
                                    double size) {
  const double d = probe_length(u);
  const auto missed = [&](const Slope& found) {
    const double allowed = 1e-4 * (std::abs(claimed) + std::abs(found.value)) + 1e-9 * size + found.round_off;
    const double miss = std::abs(found.value - claimed);
    return std::isfinite(found.value) && !(miss <= allowed) ? miss : 0.0;
  };
  const double coarse = missed(slope_along(own, u, direction, d));
  if (coarse == 0) return std::nullopt;
  const Slope found = slope_along(own, u, direction, d / 8);
  const double fine = missed(found);
  if (fine <= coarse / 2) return std::nullopt;
  return found.value;
}

// Of `count` components all, or so many at random; and of many the sum, so that none goes unseen.
std::string complaint_at(const OwnPotential& own, const Vector& u, const std::string& where, std::mt19937_64& random) {
  constexpr Index most = 64;
  Vector slope(u.size());
  own.gradient(span(u), span(slope));
  const double size = slope.lpNorm<Eigen::Infinity>();
  std::vector<Index> components(static_cast<std::size_t>(u.size()));
  std::iota(components.begin(), components.end(), Index{0});
  if (u.size() > most) {
    std::shuffle(components.begin(), components.end(), random);
    components.resize(most);
    std::sort(components.begin(), components.end());
  }
  for (const Index i : components) {
    const std::optional<double> found = slope_instead(own, u, Vector::Unit(u.size(), i), slope[i], size);
    if (found)
      return fmt::format(
          "the gradient is not that of V: {}, its component {} (from 0) is {:.6g}, and differences of V give {:.6g}",
          where, i, slope[i] + 0.0, *found);
  }
  if (u.size() <= most) return "";
  Vector direction(u.size());
  for (double& x : direction) x = (random() & 1U) != 0 ? 1.0 : -1.0;
  const double claimed = slope.dot(direction);
  const std::optional<double> found = slope_instead(own, u, direction, claimed, slope.cwiseAbs().sum());
  if (!found) return "";
  return fmt::format(
      "the gradient is not that of V: {}, along a direction of ±1 in every entry differences of V give {:.6g} per unit, and "
      "the gradient {:.6g}",
      where, *found, claimed);
}

}  // namespace

std::shared_ptr<const PointwisePotential> own_potential(OwnPotential own) {
  if (!own.value || !own.gradient) throw Error("a potential needs both functions, V and its gradient");
  if (own.fields < 1) throw Error("a potential reads {} fields; it must be one at least", own.fields);
  return std::make_shared<Own>(std::move(own));
}

double relative_precision(const OwnPotential& own, std::span<const double> u) {
  const Vector here = Eigen::Map<const Vector>(u.data(), std::ssize(u));
  const double d = probe_length(here);
  std::vector<double> values;
  for (const int k : {-3, -2, -1, 1, 2, 3}) {  // not at u alone, where V may be 0
    const Vector at = here.array() + k * d;
    values.push_back(own.value(span(at)));
  }
  return precision_of(values);
}

std::string gradient_complaint(const OwnPotential& own, std::span<const double> u) {
  constexpr int states = 3;
  std::mt19937_64 random(1);
  const Vector start = Eigen::Map<const Vector>(u.data(), std::ssize(u));
  if (std::string complaint = complaint_at(own, start, "at the start", random); !complaint.empty()) return complaint;
  const double scale = size_of(start);
  for (int k = 0; k < states; ++k) {
    Vector at(start.size());
    for (double& x : at) x = scale * (2 * static_cast<double>(random()) / static_cast<double>(random.max()) - 1);
    try {
      const std::string where = fmt::format("at a random state of the size {:.3g}", scale);
      if (std::string complaint = complaint_at(own, at, where, random); !complaint.empty()) return complaint;
    } catch (const std::exception&) {  // V need not exist everywhere: log u
      continue;
    }
  }
  return "";
}

}  // namespace seiche
