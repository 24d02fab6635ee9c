#include <seiche/backend/fft/fftw_plan.hpp>
#include <seiche/backend/fft/sine_rows.hpp>
#include <seiche/core/simd/multiversion.hpp>

#include <fftw3.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace seiche {
namespace {

// One split of S_k = 2 Σ_{0<j<N} x_j sin(πjk/N), with M = N/2. Sines of even k are those of length M of x_j − x_{N−j}.
// Of odd k, with s_j = x_j + x_{N−j} and s_M = x_M, they are a Fourier sum of length M:
//   S_{4n+1} = v_n,  S_{4n+3} = −v_{M−1−n},  v_n = Σ_k V_k e^{2πikn/M},  V_0 = 2s_M,  V_k = e^{iπk/2M} (s_{M−k} − i
//   s_k).
class Split {
 public:
  Split(Index half, bool measure)
      : half_(half),
        turns_(static_cast<std::size_t>(half / 2 + 1), {1, 0}),
        spectrum_(fftw_buffer(static_cast<std::size_t>(half + 2))),
        odd_(fftw_buffer(static_cast<std::size_t>(half))),
        differences_(fftw_buffer(static_cast<std::size_t>(half))),
        plan_([&] {
          return fftw_plan_dft_c2r_1d(static_cast<int>(half), pairs(spectrum_.get()), odd_.get(), plan_flags(measure));
        }) {
    for (std::size_t k = 0; k < turns_.size(); ++k) {
      const double angle = std::numbers::pi * static_cast<double>(k) / static_cast<double>(2 * half);
      turns_[k] = {std::cos(angle), std::sin(angle)};
    }
  }

  // x: N − 1 numbers. S of odd k go to out[k · stride − 1]. Returns the M − 1 numbers whose sines are those of even k.
  const double* apply(const double* x, double* out, Index stride) const {
    fold(x - 1, turns_.data(), half_, spectrum_.get(), differences_.get());
    fftw_execute(plan_.get());
    scatter(odd_.get(), half_, stride, out - 1);
    return differences_.get() + 1;
  }

 private:
  struct Turn {
    double cosine, sine;
  };

  // x[1] … x[N − 1]
  SEICHE_MULTIVERSION static void fold(const double* x, const Turn* turns, Index half, double* __restrict spectrum,
                                       double* __restrict differences) {
    const double* mirrored = x + 2 * half;
    spectrum[0] = 2 * x[half];
    spectrum[1] = 0;
    const Index quarter = half / 2;
    for (Index k = 1; k < quarter; ++k) {
      const double near = x[k] + mirrored[-k];
      const double far = x[half - k] + x[half + k];
      spectrum[2 * k] = turns[k].cosine * far + turns[k].sine * near;
      spectrum[2 * k + 1] = turns[k].sine * far - turns[k].cosine * near;
      differences[k] = x[k] - mirrored[-k];
      differences[half - k] = x[half - k] - x[half + k];
    }
    spectrum[half] = std::numbers::sqrt2 * (x[quarter] + mirrored[-quarter]);
    spectrum[half + 1] = 0;
    differences[quarter] = x[quarter] - mirrored[-quarter];
  }

  SEICHE_MULTIVERSION static void scatter(const double* odd, Index half, Index stride, double* __restrict out) {
    for (Index n = 0; n < half / 2; ++n) {
      out[(4 * n + 1) * stride] = odd[n];
      out[(4 * n + 3) * stride] = -odd[half - 1 - n];
    }
  }

  Index half_;
  std::vector<Turn> turns_;  // e^{iπk/2M}
  FftwBuffer spectrum_, odd_, differences_;
  FftwPlan plan_;
};

// Half of the numbers leave with each split; the sines of what is left are the Fourier transform of its odd
// continuation, of twice the length. On the whole line that would take twice the time, and FFTW's own sine transform
// still more, except on the longest lines (docs/decisions/0013).
class SineRows final : public RowTransform {
 public:
  SineRows(Index intervals, bool measure) : intervals_(intervals), rest_(intervals) {
    constexpr Index short_enough = 128;
    for (; rest_ % 4 == 0 && rest_ > short_enough; rest_ /= 2) splits_.emplace_back(rest_ / 2, measure);
    values_ = fftw_buffer(static_cast<std::size_t>(2 * rest_));
    slots_ = fftw_buffer(static_cast<std::size_t>(2 * rest_ + 2));
    plan_ = FftwPlan([&] {
      return fftw_plan_dft_r2c_1d(static_cast<int>(2 * rest_), values_.get(), pairs(slots_.get()), plan_flags(measure));
    });
  }

  Index values() const override { return intervals_ - 1; }
  Index slots() const override { return intervals_ - 1; }
  void to_slots(const double* values, double* slots, Index) const override { sines(values, slots); }
  void to_values(double* slots, double* values, Index) const override { sines(slots, values); }

 private:
  // 2 Σ_j u_j sin(πjk/N), its own inverse but for a factor.
  void sines(const double* in, double* out) const {
    Index stride = 1;
    for (const Split& split : splits_) {
      in = split.apply(in, out, stride);
      stride *= 2;
    }
    double* odd = values_.get();
    odd[0] = odd[rest_] = 0;
    for (Index j = 1; j < rest_; ++j) {
      odd[j] = in[j - 1];
      odd[2 * rest_ - j] = -in[j - 1];
    }
    fftw_execute(plan_.get());
    for (Index k = 1; k < rest_; ++k) out[k * stride - 1] = -slots_[static_cast<std::size_t>(2 * k + 1)];
  }

  Index intervals_, rest_;  // rest_: intervals after all splits
  std::vector<Split> splits_;
  FftwBuffer values_, slots_;
  FftwPlan plan_;
};

}  // namespace

std::unique_ptr<RowTransform> sine_row(Index intervals, bool measure) {
  return std::make_unique<SineRows>(intervals, measure);
}

}  // namespace seiche
