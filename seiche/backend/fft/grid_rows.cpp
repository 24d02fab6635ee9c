#include <seiche/backend/fft/fftw_plan.hpp>
#include <seiche/backend/fft/grid_rows.hpp>
#include <seiche/backend/fft/line_kinds.hpp>
#include <seiche/backend/fft/sine_rows.hpp>

#include <fftw3.h>

#include <algorithm>
#include <numbers>

namespace seiche {
namespace {

using std::numbers::sqrt2;

// â_k = w_k Σ_j u_j e^{−2πijk/N} for k = 0 … N/2.
class FourierRows final : public RowTransform {
 public:
  FourierRows(Index length, const Batches& rows, bool alone_are_real, bool measure)
      : length_(length),
        batch_(rows.width()),
        alone_are_real_(alone_are_real),
        values_(fftw_buffer(static_cast<std::size_t>(rows.most() * length))),
        slots_(fftw_buffer(static_cast<std::size_t>(rows.most() * slots()))),
        forward_(batch_, rows.rest(), measure,
                 [&](int count, unsigned flags) {
                   const int n = static_cast<int>(length_);
                   const int modes = n / 2 + 1;
                   return fftw_plan_many_dft_r2c(1, &n, count, values_.get(), nullptr, 1, n, pairs(slots_.get()),
                                                 nullptr, 1, modes, flags);
                 }),
        inverse_(batch_, rows.rest(), measure, [&](int count, unsigned flags) {
          const int n = static_cast<int>(length_);
          const int modes = n / 2 + 1;
          return fftw_plan_many_dft_c2r(1, &n, count, pairs(slots_.get()), nullptr, 1, modes, values_.get(), nullptr, 1,
                                        n, flags);
        }) {
    values_.reset();  // planned upon only
    slots_.reset();
  }

  Index values() const override { return length_; }
  Index slots() const override { return 2 * (length_ / 2 + 1); }

  void to_slots(const double* values, double* slots, Index rows) const override {
    fftw_execute_dft_r2c((rows == batch_ ? forward_.full : forward_.rest).of(values, slots),
                         const_cast<double*>(values),
                         pairs(slots));  // keeps its input
    scale_alone(slots, rows, 1 / sqrt2);
  }
  void to_values(double* slots, double* values, Index rows) const override {
    scale_alone(slots, rows, sqrt2);
    fftw_execute_dft_c2r((rows == batch_ ? inverse_.full : inverse_.rest).of(slots, values), pairs(slots), values);
  }

 private:
  void scale_alone(double* slots, Index rows, double factor) const {
    const double imaginary = alone_are_real_ ? 0.0 : factor;  // in one dimension these modes are real
    for (Index row = 0; row < rows; ++row) {
      double* first = slots + row * this->slots();
      first[0] *= factor;
      first[1] *= imaginary;
      if (length_ % 2 != 0) continue;
      first[length_] *= factor;
      first[length_ + 1] *= imaginary;
    }
  }

  Index length_, batch_;
  bool alone_are_real_;
  FftwBuffer values_, slots_;
  BatchPlans forward_, inverse_;
};

// Sines, cosines or half-complex coefficients by FFTW's own real transforms.
class RealRows final : public RowTransform {
 public:
  RealRows(const GridAxis& axis, const Batches& rows, bool measure)
      : length_(axis.unknowns()),
        batch_(rows.width()),
        alone_(modes_alone(axis)),
        values_(fftw_buffer(static_cast<std::size_t>(rows.most() * length_))),
        slots_(fftw_buffer(static_cast<std::size_t>(rows.most() * length_))),
        forward_(batch_, rows.rest(), measure,
                 [&](int count, unsigned flags) {
                   return plan(values_, slots_, count, kinds_of(axis.boundary).forward, flags);
                 }),
        inverse_(batch_, rows.rest(), measure, [&](int count, unsigned flags) {
          return plan(slots_, values_, count, kinds_of(axis.boundary).inverse, flags);
        }) {
    values_.reset();
    slots_.reset();
  }

  Index values() const override { return length_; }
  Index slots() const override { return length_; }

  void to_slots(const double* values, double* slots, Index rows) const override {
    fftw_execute_r2r((rows == batch_ ? forward_.full : forward_.rest).of(values, slots), const_cast<double*>(values),
                     slots);  // keeps its input
    scale_alone(slots, rows, 1 / sqrt2);
  }
  void to_values(double* slots, double* values, Index rows) const override {
    scale_alone(slots, rows, sqrt2);
    fftw_execute_r2r((rows == batch_ ? inverse_.full : inverse_.rest).of(slots, values), slots, values);
  }

 private:
  fftw_plan plan(const FftwBuffer& in, const FftwBuffer& out, int count, int kind, unsigned flags) const {
    const auto r2r_kind = static_cast<fftw_r2r_kind>(kind);
    const int n = static_cast<int>(length_);
    return fftw_plan_many_r2r(1, &n, count, in.get(), nullptr, 1, n, out.get(), nullptr, 1, n, &r2r_kind, flags);
  }

  void scale_alone(double* slots, Index rows, double factor) const {
    for (Index row = 0; row < rows; ++row)
      for (const Index position : alone_) slots[row * length_ + position] *= factor;
  }

  Index length_, batch_;
  std::vector<Index> alone_;
  FftwBuffer values_, slots_;
  BatchPlans forward_, inverse_;
};

}  // namespace

Index rows_of_batch(Index length) {
  constexpr Index numbers = 16384;
  return length > numbers ? 1 : std::max<Index>(numbers / length / 2 * 2, 2);
}

std::unique_ptr<RowTransform> fourier_rows(Index length, const Batches& rows, bool alone_are_real, bool measure) {
  return std::make_unique<FourierRows>(length, rows, alone_are_real, measure);
}

std::unique_ptr<RowTransform> real_rows(const GridAxis& axis, const Batches& rows, bool is_only_one, bool measure) {
  constexpr Index longest_split = 1 << 18;
  if (axis.boundary == Boundary::dirichlet && is_only_one && axis.intervals <= longest_split)
    return sine_row(axis.intervals, measure);
  return std::make_unique<RealRows>(axis, rows, measure);
}

}  // namespace seiche
