// ETDRK4 with Krogstad's stages (S. Krogstad, J. Comput. Phys. 203, 2005), whose stiff order is better than that of
// Cox and Matthews:
//   a = e^{½} z + ½hφ₁(½) N(z)                              (½) stands for hA/2, φ_j without argument for hA
//   b = e^{½} z + h(½φ₁(½) − φ₂(½)) N(z) + hφ₂(½) N(a)
//   c = e z + h(φ₁ − 2φ₂) N(z) + 2hφ₂ N(b)
//   z⁺ = e z + h(φ₁ − 3φ₂ + 4φ₃) N(z) + h(2φ₂ − 4φ₃)(N(a) + N(b)) + h(4φ₃ − φ₂) N(c)
#include <bench/peers/hand_written.hpp>
#include <bench/peers/modal_run.hpp>

namespace seiche::bench {
namespace {

// The coefficients of the scheme for one mode.
template <class T>
struct Weights {
  T half, one;            // e^{½}, e
  T a, b0, b1, c0, c2;    // of N(z), N(a), N(b) in the stages
  T first, middle, last;  // of the result

  Weights(const T& A, Real h) {
    const Phi<T> p = phi((h / 2) * A);
    const Phi<T> q = phi(h * A);
    half = p[0];
    one = q[0];
    a = (h / 2) * p[1];
    b0 = h * (Real{0.5} * p[1] + Real{-1} * p[2]);
    b1 = h * p[2];
    c0 = h * (q[1] + Real{-2} * q[2]);
    c2 = (2 * h) * q[2];
    first = h * (q[1] + Real{-3} * q[2] + Real{4} * q[3]);
    middle = h * (Real{2} * q[2] + Real{-4} * q[3]);
    last = h * (Real{4} * q[3] + Real{-1} * q[2]);
  }
};

double narrow(Real x) { return static_cast<double>(x); }

class Etdrk4Run : public ModalRun {
 protected:
  Etdrk4Run(const Equation& equation, double h) : ModalRun(equation, h) {
    for (std::vector<double>* v : {&stage_, &base_, &n0_, &na_, &nb_, &nc_}) v->resize(u_.size());
  }
  std::vector<double> stage_, base_, n0_, na_, nb_, nc_;  // what enters N, its linear part, and N of z, a, b, c
};

// N acts on v̂ and depends on û, so stages need û alone, and of every weight its second column.
class WaveEtdrk4 : public Etdrk4Run {
 public:
  WaveEtdrk4(const Equation& equation, double h) : Etdrk4Run(equation, h) {
    weights_.reserve(u_.size());
    const std::vector<Matrix2> blocks = wave_blocks(equation, symbols_);
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      if (k > 0 && is_same(blocks[k], blocks[k - 1])) {
        weights_.push_back(weights_.back());
        continue;
      }
      const Weights<Matrix2> w(blocks[k], h);
      weights_.push_back({narrow(w.half.a), narrow(w.half.b), narrow(w.a.b), narrow(w.b0.b), narrow(w.b1.b),
                          narrow(w.one.a), narrow(w.one.b), narrow(w.one.c), narrow(w.one.d), narrow(w.c0.b),
                          narrow(w.c2.b), narrow(w.first.b), narrow(w.middle.b), narrow(w.last.b), narrow(w.first.d),
                          narrow(w.middle.d), narrow(w.last.d)});
    }
  }

 private:
  struct Slot {
    double half_u, half_v, a, b0, b1, uu, uv, vu, vv, c0, c2, first_u, middle_u, last_u, first_v, middle_v, last_v;
  };

  void steps(std::int64_t count) override {
    const std::size_t n = u_.size();
    const Slot* w = weights_.data();
    double* u = u_.data();
    double* v = v_.data();
    for (; count > 0; --count) {
      nonlinear(u, n0_.data());
      for (std::size_t k = 0; k < n; ++k) {
        base_[k] = w[k].half_u * u[k] + w[k].half_v * v[k];
        stage_[k] = base_[k] + w[k].a * n0_[k];
      }
      nonlinear(stage_.data(), na_.data());
      for (std::size_t k = 0; k < n; ++k) stage_[k] = base_[k] + w[k].b0 * n0_[k] + w[k].b1 * na_[k];
      nonlinear(stage_.data(), nb_.data());
      for (std::size_t k = 0; k < n; ++k) {
        base_[k] = w[k].uu * u[k] + w[k].uv * v[k];
        stage_[k] = base_[k] + w[k].c0 * n0_[k] + w[k].c2 * nb_[k];
      }
      nonlinear(stage_.data(), nc_.data());
      for (std::size_t k = 0; k < n; ++k) {
        const double middle = na_[k] + nb_[k];
        v[k] = w[k].vu * u[k] + w[k].vv * v[k] + w[k].first_v * n0_[k] + w[k].middle_v * middle + w[k].last_v * nc_[k];
        u[k] = base_[k] + w[k].first_u * n0_[k] + w[k].middle_u * middle + w[k].last_u * nc_[k];
      }
    }
  }

  std::vector<Slot> weights_;
};

// gkdv and gradient flows: one complex number per mode.
class ScalarEtdrk4 : public Etdrk4Run {
 public:
  ScalarEtdrk4(const Equation& equation, double h) : Etdrk4Run(equation, h) {
    for (const Complex& block : scalar_blocks(equation, symbols_)) weights_.emplace_back(block, Real{h});
  }

 private:
  struct Number {  // std::complex would check its products for infinities
    double re, im;
  };
  struct Mode {
    explicit Mode(const Complex& block, Real h) : Mode(Weights<Complex>(block, h)) {}
    explicit Mode(const Weights<Complex>& w)
        : half(number(w.half)),
          one(number(w.one)),
          a(number(w.a)),
          b0(number(w.b0)),
          b1(number(w.b1)),
          c0(number(w.c0)),
          c2(number(w.c2)),
          first(number(w.first)),
          middle(number(w.middle)),
          last(number(w.last)) {}
    static Number number(const Complex& x) { return {narrow(x.real()), narrow(x.imag())}; }
    Number half, one, a, b0, b1, c0, c2, first, middle, last;
  };
  static Number at(const std::vector<double>& x, std::size_t k) { return {x[2 * k], x[2 * k + 1]}; }
  static void put(std::vector<double>& x, std::size_t k, Number value) {
    x[2 * k] = value.re;
    x[2 * k + 1] = value.im;
  }
  friend Number operator+(Number x, Number y) { return {x.re + y.re, x.im + y.im}; }
  friend Number operator*(Number x, Number y) { return {x.re * y.re - x.im * y.im, x.re * y.im + x.im * y.re}; }

  void steps(std::int64_t count) override {
    const std::size_t modes = weights_.size();
    const Mode* w = weights_.data();
    for (; count > 0; --count) {
      nonlinear(u_.data(), n0_.data());
      for (std::size_t k = 0; k < modes; ++k) {
        const Number base = w[k].half * at(u_, k);
        put(base_, k, base);
        put(stage_, k, base + w[k].a * at(n0_, k));
      }
      nonlinear(stage_.data(), na_.data());
      for (std::size_t k = 0; k < modes; ++k)
        put(stage_, k, at(base_, k) + w[k].b0 * at(n0_, k) + w[k].b1 * at(na_, k));
      nonlinear(stage_.data(), nb_.data());
      for (std::size_t k = 0; k < modes; ++k) {
        const Number base = w[k].one * at(u_, k);
        put(base_, k, base);
        put(stage_, k, base + w[k].c0 * at(n0_, k) + w[k].c2 * at(nb_, k));
      }
      nonlinear(stage_.data(), nc_.data());
      for (std::size_t k = 0; k < modes; ++k)
        put(u_, k,
            at(base_, k) + w[k].first * at(n0_, k) + w[k].middle * (at(na_, k) + at(nb_, k)) + w[k].last * at(nc_, k));
    }
  }

  std::vector<Mode> weights_;
};

}  // namespace

std::unique_ptr<Run> make_etdrk4(const Equation& equation, double h) {
  if (equation.is_second_order()) return std::make_unique<WaveEtdrk4>(equation, h);
  return std::make_unique<ScalarEtdrk4>(equation, h);
}

}  // namespace seiche::bench
