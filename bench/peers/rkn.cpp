// Runge–Kutta–Nyström splitting, b₁ a₁ b₂ a₂ … b₂ a₁ b₁: SRKN₆ᵇ of order four and SRKN₁₁ᵇ of order six (S. Blanes and
// P. C. Moan, J. Comput. Appl. Math. 142, 2002). They suppose that the a-flow is linear and the b-flow a kick of v that
// depends on u alone: then [B, [B, [B, A]]] = 0, damping in A included. Some a are negative: there damping runs
// backwards.
#include <bench/peers/energy_line.hpp>
#include <bench/peers/hand_written.hpp>
#include <bench/peers/modal_run.hpp>
#include <bench/peers/right_hand_side.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace seiche::bench {
namespace {

// Palindromes: the first half of the a, and the b up to the middle.
struct Scheme {
  std::vector<double> a, b;

  std::size_t flows() const { return a.size(); }
  double first_kick() const { return b.front(); }
  double kick_after(std::size_t flow) const { return b[std::min(flow + 1, a.size() - 1 - flow)]; }
  // Equal flows share their coefficients.
  std::size_t distinct_flows() const { return (a.size() + 1) / 2; }
  std::size_t which(std::size_t flow) const { return std::min(flow, a.size() - 1 - flow); }
};

const Scheme& scheme_of_order(int order) {
  static const Scheme four = [] {
    const double a1 = 0.245298957184271, a2 = 0.604872665711080, a3 = 0.5 - (a1 + a2);
    const double b1 = 0.0829844064174052, b2 = 0.396309801498368, b3 = -0.0390563049223486;
    return Scheme{{a1, a2, a3, a3, a2, a1}, {b1, b2, b3, 1 - 2 * (b1 + b2 + b3)}};
  }();
  static const Scheme six = [] {
    const double a1 = 0.123229775946271, a2 = 0.290553797799558, a3 = -0.127049212625417, a4 = -0.246331761062075,
                 a5 = 0.357208872795928, a6 = 1 - 2 * (a1 + a2 + a3 + a4 + a5);
    const double b1 = 0.0414649985182624, b2 = 0.198128671918067, b3 = -0.0400061921041533, b4 = 0.0752539843015807,
                 b5 = -0.0115113874206879, b6 = 0.5 - (b1 + b2 + b3 + b4 + b5);
    return Scheme{{a1, a2, a3, a4, a5, a6, a5, a4, a3, a2, a1}, {b1, b2, b3, b4, b5, b6}};
  }();
  return order == 4 ? four : six;
}

// A: the exact damped linear flow in modes, B: −∇V. A kick leaves u, so the force of the last one begins the next step.
class ExactRkn : public ModalRun {
 public:
  ExactRkn(const Equation& equation, double h, const Scheme& scheme)
      : ModalRun(equation, h), scheme_(scheme), force_(u_.size()) {
    const std::vector<Matrix2> blocks = wave_blocks(equation, symbols_);
    for (std::size_t i = 0; i < scheme.distinct_flows(); ++i) flows_.emplace_back(blocks, h * scheme.a[i]);
  }

 private:
  void kick(double b) {
    for (std::size_t k = 0; k < v_.size(); ++k) v_[k] += b * h_ * force_[k];
  }
  void steps(std::int64_t count) override {
    nonlinear(u_.data(), force_.data());
    for (; count > 0; --count) {
      kick(scheme_.first_kick());
      for (std::size_t i = 0; i < scheme_.flows(); ++i) {
        flows_[scheme_.which(i)].apply(u_.data(), v_.data());
        nonlinear(u_.data(), force_.data());
        kick(scheme_.kick_after(i));
      }
    }
  }

  const Scheme& scheme_;
  std::vector<WaveFlow> flows_;  // the distinct ones
  std::vector<double> force_;
};

// A: u' = v, v' = −γv; B: everything else, by differences. No transform and no stiff part, hence a bound on h. Where it
// projects, each step ends on the ray through its result at the energy that the drifts of the step have left.
template <bool projects>
class KickRkn : public Run {
 public:
  KickRkn(const Equation& equation, double h, const Scheme& scheme)
      : equation_(equation), h_(h), scheme_(scheme), line_(equation), z_(equation.size()), origin_(equation.size()) {
    restart();
    for (const double a : scheme.a) {
      const double t = h * a;
      decay_.push_back(std::exp(-equation.gamma * t));
      drift_.push_back(equation.gamma == 0 ? t : -std::expm1(-equation.gamma * t) / equation.gamma);
    }
  }

  void restart() override {
    z_ = equation_.initial;
    const EnergyLine::Coefficients c = line_.along(origin_.data(), z_.data());
    energy_ = c[1] + c[2] + c[3];
    steps_ = evaluations_ = 0;
  }

  std::string advance(double t) override {
    const std::int64_t count = std::llround(t / h_) - steps_;
    if (count <= 0) return "";
    const std::size_t last = scheme_.flows() - 1;
    if (!projects) kick(scheme_.first_kick());
    for (std::int64_t step = 1; step <= count; ++step) {
      if (projects) kick(scheme_.first_kick());
      for (std::size_t i = 0; i <= last; ++i) {
        drift(i);
        // The last kick of a step and the first of the next are one where nothing lies between them.
        const bool is_whole = !projects && i == last && step < count;
        kick(is_whole ? 2 * scheme_.first_kick() : scheme_.kick_after(i));
      }
      if (projects) project();
    }
    steps_ += count;
    return std::isfinite(z_[0]) ? "" : "not finite";
  }

  void values(std::span<double> z) const override { std::copy(z_.begin(), z_.end(), z.begin()); }
  Work work() const override { return {steps_, evaluations_}; }

  // kick/h plus the derivative of the drift at h = 0
  void right_hand_side(std::span<const double> z, std::span<double> dz) override {
    const std::vector<double> kept = z_;
    const std::size_t n = equation_.unknowns();
    z_.assign(z.begin(), z.end());
    kick(1 / h_);
    for (std::size_t j = 0; j < n; ++j) {
      dz[j] = z[n + j];
      dz[n + j] = z_[n + j] - z[n + j] - equation_.gamma * z[n + j];
    }
    z_ = kept;
  }

 private:
  //   H(xz) = c₁x² + c₂x³ + c₃x⁴
  void project() {
    const EnergyLine::Coefficients c = line_.along(origin_.data(), z_.data());
    const double factor = root_near_one([&](double x) {
      return std::pair(x * x * (c[1] + x * (c[2] + x * c[3])) - energy_,
                       x * (2 * c[1] + x * (3 * c[2] + x * 4 * c[3])));
    });
    for (double& number : z_) number *= factor;
  }

  void drift(std::size_t i) {
    const std::size_t n = equation_.unknowns();
    double* u = z_.data();
    double* v = u + n;
    const double d = drift_[i];
    const double e = decay_[i];
    if (projects) energy_ -= (1 - e * e) / 2 * std::transform_reduce(v, v + n, v, 0.0);
    for (std::size_t j = 0; j < n; ++j) {
      u[j] += d * v[j];
      v[j] *= e;
    }
  }

  void kick(double b) {
    ++evaluations_;
    const std::size_t n = equation_.unknowns();
    const double* u = z_.data();
    double* v = z_.data() + n;
    const double tau = b * h_;
    const double linear = -tau * equation_.mass_squared;
    const double cubic = -tau * equation_.strength;
    if (equation_.rows > 1) {
      add_laplacian(equation_, tau * equation_.stiffness, u, v);
      for (std::size_t j = 0; j < n; ++j) v[j] += (linear + cubic * u[j] * u[j]) * u[j];
      return;
    }
    const double c = tau * equation_.stiffness / (equation_.dx * equation_.dx);
    const auto force = [=](double left, double here, double right) {
      return c * (left + right - 2 * here) + (linear + cubic * here * here) * here;
    };
    v[0] += force(u[n - 1], u[0], u[1]);
    for (std::size_t j = 1; j + 1 < n; ++j) v[j] += force(u[j - 1], u[j], u[j + 1]);
    v[n - 1] += force(u[n - 2], u[n - 1], u[0]);
  }

  const Equation equation_;
  const double h_;
  const Scheme& scheme_;
  EnergyLine line_;
  std::vector<double> z_, origin_, decay_, drift_;  // origin_: zeros
  double energy_ = 0;
  std::int64_t steps_ = 0;
  std::int64_t evaluations_ = 0;
};

template <class Method, int order>
std::unique_ptr<Run> make(const Equation& equation, double h) {
  return std::make_unique<Method>(equation, h, scheme_of_order(order));
}

// The full kick has no place for a damping that is not a multiple of v.
bool kicks_apply(const Equation& equation) { return equation.kind == Equation::Kind::klein_gordon; }

Peer peer(const std::string& name, bool (*applies)(const Equation&),
          std::unique_ptr<Run> (*make)(const Equation&, double)) {
  return {.name = name,
          .library = "hand-written",
          .origin = Origin::hand_written,
          .sweep = Sweep::step_size,
          .applies = applies,
          .make = make};
}

}  // namespace

std::vector<Peer> rkn_peers() {
  return {peer("RKN4 kicks", kicks_apply, make<KickRkn<false>, 4>),
          peer("RKN6 kicks", kicks_apply, make<KickRkn<false>, 6>),
          peer("projected RKN4 kicks", kicks_apply, make<KickRkn<true>, 4>),
          peer("projected RKN6 kicks", kicks_apply, make<KickRkn<true>, 6>),
          peer("RKN4 exact flow", second_order_in_time, make<ExactRkn, 4>),
          peer("RKN6 exact flow", second_order_in_time, make<ExactRkn, 6>)};
}

}  // namespace seiche::bench
