// Loops over the rows of panels for potentials per point or bond, with a W for each member.
#pragma once

#include <seiche/core/panel_potential.hpp>
#include <seiche/core/simd/pack.hpp>
#include <seiche/potential/polynomial.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace seiche {

// Any W, member by member.
template <PointPotential W>
class PanelW {
 public:
  explicit PanelW(std::vector<W> w) : w_(std::move(w)) {}

  void slopes(const double* u, double* slopes, Index rows) const {
    for (Index i = 0; i < rows * panel_members; ++i) slopes[i] = w_[member(i)].slope(u[i]);
  }
  void values_and_slopes(const double* u, double* slopes, Index rows, PanelValues& values) const {
    values.fill(0);
    for (Index i = 0; i < rows * panel_members; ++i) {
      values[member(i)] += w_[member(i)].value(u[i]);
      slopes[i] = w_[member(i)].slope(u[i]);
    }
  }
  void values_and_magnitudes(const double* u, Index rows, PanelValues& values, PanelValues& magnitudes) const {
    values.fill(0);
    magnitudes.fill(0);
    for (Index i = 0; i < rows * panel_members; ++i) {
      const double value = w_[member(i)].value(u[i]);
      values[member(i)] += value;
      magnitudes[member(i)] += std::abs(value);
    }
  }
  void mean_slopes(const double* a, const double* b, double* mean, Index rows) const {
    for (Index i = 0; i < rows * panel_members; ++i) mean[i] = w_[member(i)].mean_slope(a[i], b[i]);
  }

 private:
  static std::size_t member(Index i) { return static_cast<std::size_t>(i % panel_members); }
  std::vector<W> w_;
};

// Horner's rule on registers, since GCC does not turn a loop over members into them. Row i of `c` holds the
// coefficients of uⁱ, row i of `d` those of W' times u; where all odd ones are zero, both are polynomials in u².
template <int degree, bool even>
struct PolynomialLoops {
  static constexpr int step = even ? 2 : 1;
  static constexpr int count = degree / step + 1;
  using Coefficients = Pack[count][packs];

  // Copies, which no store to a panel can change, so that they may stay in registers.
  [[gnu::always_inline]] static void copy(const double* from, Coefficients& to) {
#pragma GCC unroll 17
    for (int k = 0; k < count; ++k) {
#pragma GCC unroll 8
      for (int q = 0; q < packs; ++q) to[k][q] = packs_of(from + k * step * panel_members)[q];
    }
  }

  [[gnu::always_inline]] static void slope(const Coefficients& d, const Pack& u, const Pack& x, int q, Pack& out) {
    Pack sum = d[count - 1][q];
#pragma GCC unroll 16
    for (int k = count - 2; k >= 1; --k) sum = sum * x + d[k][q];
    out = even ? sum * u : sum;
  }

  SEICHE_MULTIVERSION static void slopes(const double* d_rows, const double* u, double* slopes, Index rows) {
    Coefficients d;
    copy(d_rows, d);
    for (Index j = 0; j < rows; ++j) {
      const Pack* at = packs_of(u + j * panel_members);
      Pack* out = packs_of(slopes + j * panel_members);
#pragma GCC unroll 8
      for (int q = 0; q < packs; ++q) slope(d, at[q], even ? at[q] * at[q] : at[q], q, out[q]);
    }
  }

  SEICHE_MULTIVERSION static void values_and_slopes(const double* c_rows, const double* d_rows, const double* u,
                                                    double* slopes, Index rows, double* values) {
    Coefficients c, d;
    copy(c_rows, c);
    copy(d_rows, d);
    Pack sum[packs] = {};
    for (Index j = 0; j < rows; ++j) {
      const Pack* at = packs_of(u + j * panel_members);
      Pack* out = packs_of(slopes + j * panel_members);
#pragma GCC unroll 8
      for (int q = 0; q < packs; ++q) {
        const Pack here = at[q];
        const Pack x = even ? here * here : here;
        Pack value = c[count - 1][q];
#pragma GCC unroll 17
        for (int k = count - 2; k >= 0; --k) value = value * x + c[k][q];
        slope(d, here, x, q, out[q]);
        sum[q] += value;
      }
    }
    std::memcpy(values, sum, sizeof sum);
  }
};

// As Polynomial::mean_slope: divide by (u − a) and evaluate the quotient at b.
template <int degree>
SEICHE_MULTIVERSION void polynomial_mean_slopes(const double* c, const double* a, const double* b, double* mean,
                                                Index rows) {
  for (Index j = 0; j < rows; ++j) {
    const Pack* x = packs_of(a + j * panel_members);
    const Pack* y = packs_of(b + j * panel_members);
    Pack* out = packs_of(mean + j * panel_members);
#pragma GCC unroll 8
    for (int q = 0; q < packs; ++q) {
      Pack quotient = packs_of(c + degree * panel_members)[q];
      Pack sum = quotient;
#pragma GCC unroll 16
      for (int k = 1; k < degree; ++k) {
        quotient = quotient * x[q] + packs_of(c + (degree - k) * panel_members)[q];
        sum = sum * y[q] + quotient;
      }
      out[q] = sum;
    }
  }
}

template <int degree>
class PanelW<Polynomial<degree>> {
 public:
  explicit PanelW(const std::vector<Polynomial<degree>>& w) : c_(degree + 1), d_(degree + 1) {
    for (Index i = 0; i <= degree; ++i) {
      for (Index l = 0; l < panel_members; ++l) {
        c_(i, l) = w[static_cast<std::size_t>(l)].c[static_cast<std::size_t>(i)];
        d_(i, l) = static_cast<double>(i) * c_(i, l);
        even_ = even_ && (i % 2 == 0 || c_(i, l) == 0);
      }
    }
  }
  void slopes(const double* u, double* slopes, Index rows) const {
    if constexpr (degree % 2 == 0) {
      if (even_) return PolynomialLoops<degree, true>::slopes(d_.row(0), u, slopes, rows);
    }
    PolynomialLoops<degree, false>::slopes(d_.row(0), u, slopes, rows);
  }
  void values_and_slopes(const double* u, double* slopes, Index rows, PanelValues& values) const {
    if constexpr (degree % 2 == 0) {
      if (even_)
        return PolynomialLoops<degree, true>::values_and_slopes(c_.row(0), d_.row(0), u, slopes, rows, values.data());
    }
    PolynomialLoops<degree, false>::values_and_slopes(c_.row(0), d_.row(0), u, slopes, rows, values.data());
  }
  void values_and_magnitudes(const double* u, Index rows, PanelValues& values, PanelValues& magnitudes) const {
    values.fill(0);
    magnitudes.fill(0);
    for (Index i = 0; i < rows * panel_members; ++i) {
      const Index member = i % panel_members;
      double value = c_(degree, member);
      for (Index k = degree; k-- > 0;) value = value * u[i] + c_(k, member);
      values[static_cast<std::size_t>(member)] += value;
      magnitudes[static_cast<std::size_t>(member)] += std::abs(value);
    }
  }
  void mean_slopes(const double* a, const double* b, double* mean, Index rows) const {
    polynomial_mean_slopes<degree>(c_.row(0), a, b, mean, rows);
  }

 private:
  Panel c_, d_;
  bool even_ = degree % 2 == 0;
};

// The W of every member if all members are Potential, else none. Potential tells its W by w().
template <class Potential>
auto member_functions(PanelMembers members) {
  std::vector<std::remove_cvref_t<decltype(std::declval<const Potential&>().w())>> w;
  for (const auto& member : members) {
    const auto* same = dynamic_cast<const Potential*>(member.get());
    if (same == nullptr) return decltype(w)();
    w.push_back(same->w());
  }
  return w;
}

}  // namespace seiche
