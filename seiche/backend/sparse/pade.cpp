#include <seiche/backend/sparse/pade.hpp>
#include <seiche/core/control/stop_request.hpp>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

double norm_1(const SparseMatrix& a) {
  double largest = 0;
  for (Index j = 0; j < a.outerSize(); ++j) {
    double sum = 0;
    for (SparseMatrix::InnerIterator entry(a, j); entry; ++entry) sum += std::abs(entry.value());
    largest = std::max(largest, sum);
  }
  return largest;
}

}  // namespace

double spectral_radius_bound(const SparseMatrix& B) {
  const SparseMatrix B2 = B * B;
  const SparseMatrix B3 = B2 * B;
  return std::min({norm_1(B), std::sqrt(norm_1(B2)), std::cbrt(norm_1(B3))});
}

PadeForce::PadeForce(const Product& S, const Product& M, Index size, const Resolvents& resolvents, double h,
                     PadePlan plan)
    : S_(S), M_(M), h_(h / plan.steps), steps_(plan.steps), slope_(size), rate_(size), x_(size) {
  for (const std::complex<double>& pole : pade_poles(plan.degree)) {
    end_if_asked();
    factors_.push_back({pole, resolvents.make(h_, pole)});
  }
}

//   pair of poles p, p̄:   y ← y + 4 Re p · Im((A − p)⁻¹ hS(My + c)) / Im p
//   real pole p:          y ← y − 2 (A − p)⁻¹ hS(My + c)
void PadeForce::apply(const Vector& c, Vector& y) const {
  y.setZero(c.size());
  for (int step = 0; step < steps_; ++step) {
    for (const Factor& factor : factors_) {
      end_if_asked();
      M_.apply(y, slope_);
      slope_ += c;
      S_.apply(slope_, rate_);
      rate_ *= h_;
      factor.resolvent->apply(rate_, x_);
      y += (factor.pole.imag() == 0 ? -2.0 : 4 * factor.pole.real()) * x_;
    }
  }
}

}  // namespace seiche
