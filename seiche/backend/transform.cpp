#include <seiche/backend/transform.hpp>

#include <fftw3.h>

#include <algorithm>
#include <mutex>
#include <numbers>

namespace seiche {
namespace {

std::mutex& planner_mutex() {  // FFTW's planner keeps global tables
  static std::mutex mutex;
  return mutex;
}

struct FreeBuffer {
  void operator()(double* p) const { fftw_free(p); }
};
using Buffer = std::unique_ptr<double[], FreeBuffer>;

Buffer buffer(Index size) { return Buffer(fftw_alloc_real(static_cast<std::size_t>(size))); }

class Plan {
 public:
  template <class Make>
  explicit Plan(const Make& make) {
    const std::scoped_lock lock(planner_mutex());
    plan_ = make();
  }
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;
  ~Plan() {
    const std::scoped_lock lock(planner_mutex());
    fftw_destroy_plan(plan_);
  }
  void execute() const { fftw_execute(plan_); }

 private:
  fftw_plan plan_ = nullptr;
};

unsigned flag(bool measure) { return measure ? FFTW_MEASURE : FFTW_ESTIMATE; }

class IdentityTransform final : public FieldTransform {
 public:
  explicit IdentityTransform(Index n) : n_(n) {}
  Index unknowns() const override { return n_; }
  Index slots() const override { return n_; }
  void forward(std::span<const double> values, std::span<double> slots) const override {
    std::copy(values.begin(), values.end(), slots.begin());
  }
  void inverse(std::span<const double> slots, std::span<double> values) const override {
    std::copy(slots.begin(), slots.end(), values.begin());
  }

 private:
  Index n_;
};

// â_k = w_k Σ_j u_j e^{−2πijk/N} with w = 1/√N for the modes that stand alone (0 and, N even, N/2) and √(2/N) for those
// that stand for k and −k: then Σ|â_k|² = Σ u_j².
class FourierTransform final : public FieldTransform {
 public:
  FourierTransform(Index n, bool measure)
      : n_(n),
        slots_(2 * (n / 2 + 1)),
        values_(buffer(n)),
        modes_(buffer(slots_)),
        to_modes_([&] { return fftw_plan_dft_r2c_1d(size(), values_.get(), complex_modes(), flag(measure)); }),
        to_values_([&] { return fftw_plan_dft_c2r_1d(size(), complex_modes(), values_.get(), flag(measure)); }) {}

  Index unknowns() const override { return n_; }
  Index slots() const override { return slots_; }

  void forward(std::span<const double> values, std::span<double> slots) const override {
    std::copy(values.begin(), values.end(), values_.get());
    to_modes_.execute();
    const double alone = 1 / std::sqrt(static_cast<double>(n_));
    scale(modes_.get(), slots.data(), alone, std::numbers::sqrt2 * alone);
  }

  void inverse(std::span<const double> slots, std::span<double> values) const override {
    const double alone = 1 / std::sqrt(static_cast<double>(n_));
    scale(slots.data(), modes_.get(), alone, alone / std::numbers::sqrt2);
    to_values_.execute();
    std::copy(values_.get(), values_.get() + n_, values.begin());
  }

 private:
  int size() const { return static_cast<int>(n_); }
  fftw_complex* complex_modes() const { return reinterpret_cast<fftw_complex*>(modes_.get()); }

  void scale(const double* in, double* out, double alone, double paired) const {
    for (Index i = 0; i < slots_; ++i) out[i] = paired * in[i];
    out[0] = alone * in[0];
    out[1] = 0;  // the mean is real
    if (n_ % 2 == 0) {
      out[slots_ - 2] = alone * in[slots_ - 2];
      out[slots_ - 1] = 0;
    }
  }

  Index n_;
  Index slots_;
  Buffer values_;
  Buffer modes_;
  Plan to_modes_;
  Plan to_values_;
};

// DST-I, its own inverse when scaled by √(2/N).
class SineTransform final : public FieldTransform {
 public:
  SineTransform(Index intervals, bool measure)
      : n_(intervals - 1),
        factor_(1 / std::sqrt(2.0 * static_cast<double>(intervals))),  // FFTW's sum carries a 2
        in_(buffer(n_)),
        out_(buffer(n_)),
        plan_([&] {
          return fftw_plan_r2r_1d(static_cast<int>(n_), in_.get(), out_.get(), FFTW_RODFT00, flag(measure));
        }) {}

  Index unknowns() const override { return n_; }
  Index slots() const override { return n_; }
  void forward(std::span<const double> values, std::span<double> slots) const override { sines(values, slots); }
  void inverse(std::span<const double> slots, std::span<double> values) const override { sines(slots, values); }

 private:
  void sines(std::span<const double> in, std::span<double> out) const {
    std::copy(in.begin(), in.end(), in_.get());
    plan_.execute();
    for (Index i = 0; i < n_; ++i) out[static_cast<std::size_t>(i)] = factor_ * out_[static_cast<std::size_t>(i)];
  }

  Index n_;
  double factor_;
  Buffer in_;
  Buffer out_;
  Plan plan_;
};

}  // namespace

std::unique_ptr<FieldTransform> identity_transform(Index unknowns) {
  return std::make_unique<IdentityTransform>(unknowns);
}

std::unique_ptr<FieldTransform> modal_transform(const Grid& grid, bool measure_plan) {
  if (grid.boundary == Boundary::periodic) return std::make_unique<FourierTransform>(grid.intervals, measure_plan);
  return std::make_unique<SineTransform>(grid.intervals, measure_plan);
}

}  // namespace seiche
