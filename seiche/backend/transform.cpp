#include <seiche/backend/transform.hpp>

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <vector>

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

std::vector<int> sizes(const Grid& grid) {
  std::vector<int> n;
  for (const GridAxis& axis : grid.axes) n.push_back(static_cast<int>(axis.unknowns()));
  return n;
}

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

// Grids periodic along every axis. â_k = w_k Σ_j u_j e^{−2πijk/N}, where w = 1/√N for the modes whose conjugate is held
// too (k = 0 and, N even, N/2 along the last axis) and √(2/N) for those that stand for k and −k: Σ|â_k|² = Σ u_j².
class FourierTransform final : public FieldTransform {
 public:
  FourierTransform(const Grid& grid, bool measure)
      : n_(grid.unknowns()),
        last_(grid.axes.back().intervals),
        row_(2 * (last_ / 2 + 1)),
        slots_(n_ / last_ * row_),
        is_line_(grid.dimension() == 1),
        sizes_(sizes(grid)),
        values_(buffer(n_)),
        modes_(buffer(slots_)),
        to_modes_(
            [&] { return fftw_plan_dft_r2c(rank(), sizes_.data(), values_.get(), complex_modes(), flag(measure)); }),
        to_values_(
            [&] { return fftw_plan_dft_c2r(rank(), sizes_.data(), complex_modes(), values_.get(), flag(measure)); }) {}

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
  int rank() const { return static_cast<int>(sizes_.size()); }
  fftw_complex* complex_modes() const { return reinterpret_cast<fftw_complex*>(modes_.get()); }

  void scale(const double* in, double* out, double alone, double paired) const {
    for (Index row = 0; row < slots_; row += row_) {
      for (Index i = row; i < row + row_; ++i) out[i] = paired * in[i];
      scale_alone(in + row, out + row, alone);
      if (last_ % 2 == 0) scale_alone(in + row + row_ - 2, out + row + row_ - 2, alone);
    }
  }

  void scale_alone(const double* in, double* out, double alone) const {
    out[0] = alone * in[0];
    out[1] = is_line_ ? 0.0 : alone * in[1];  // in one dimension these modes are real
  }

  Index n_;
  Index last_;
  Index row_;
  Index slots_;
  bool is_line_;
  std::vector<int> sizes_;
  Buffer values_;
  Buffer modes_;
  Plan to_modes_;
  Plan to_values_;
};

// Grids with an end somewhere: sines (DST-I) along Dirichlet axes, cosines (DCT-II) along Neumann axes, half-complex
// Fourier coefficients along periodic ones. Real slots, as many as unknowns.
class RealTransform final : public FieldTransform {
 public:
  RealTransform(const Grid& grid, bool measure)
      : n_(grid.unknowns()),
        sizes_(sizes(grid)),
        in_(buffer(n_)),
        out_(buffer(n_)),
        forward_([&] { return plan(kinds(grid, FFTW_R2HC, FFTW_REDFT10), measure); }),
        inverse_([&] { return plan(kinds(grid, FFTW_HC2R, FFTW_REDFT01), measure); }),
        forward_scale_(Vector::Ones(n_)),
        inverse_scale_(Vector::Ones(n_)) {
    Index stride = n_;
    for (const GridAxis& axis : grid.axes) {
      stride /= axis.unknowns();
      for (Index i = 0; i < n_; ++i) {
        const auto [forward, inverse] = scales(axis, i / stride % axis.unknowns());
        forward_scale_[i] *= forward;
        inverse_scale_[i] *= inverse;
      }
    }
  }

  Index unknowns() const override { return n_; }
  Index slots() const override { return n_; }

  void forward(std::span<const double> values, std::span<double> slots) const override {
    std::copy(values.begin(), values.end(), in_.get());
    forward_.execute();
    for (Index i = 0; i < n_; ++i) slots[static_cast<std::size_t>(i)] = forward_scale_[i] * out_[at(i)];
  }

  void inverse(std::span<const double> slots, std::span<double> values) const override {
    for (Index i = 0; i < n_; ++i) in_[at(i)] = inverse_scale_[i] * slots[at(i)];
    inverse_.execute();
    std::copy(out_.get(), out_.get() + n_, values.begin());
  }

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  static std::vector<fftw_r2r_kind> kinds(const Grid& grid, fftw_r2r_kind periodic, fftw_r2r_kind neumann) {
    std::vector<fftw_r2r_kind> list;
    for (const GridAxis& axis : grid.axes) {
      list.push_back(axis.boundary == Boundary::periodic  ? periodic
                     : axis.boundary == Boundary::neumann ? neumann
                                                          : FFTW_RODFT00);
    }
    return list;
  }

  fftw_plan plan(const std::vector<fftw_r2r_kind>& kinds, bool measure) const {
    return fftw_plan_r2r(static_cast<int>(sizes_.size()), sizes_.data(), in_.get(), out_.get(), kinds.data(),
                         flag(measure));
  }

  // What makes FFTW's sums along one axis orthonormal: after the forward one, before the inverse one.
  static std::pair<double, double> scales(const GridAxis& axis, Index position) {
    const auto n = static_cast<double>(axis.intervals);
    switch (axis.boundary) {
      case Boundary::dirichlet: return {1 / std::sqrt(2 * n), 1 / std::sqrt(2 * n)};
      case Boundary::neumann:
        return position == 0 ? std::pair(1 / std::sqrt(4 * n), 1 / std::sqrt(n))
                             : std::pair(1 / std::sqrt(2 * n), 1 / std::sqrt(2 * n));
      case Boundary::periodic: break;
    }
    const bool alone = position == 0 || 2 * position == axis.intervals;
    return alone ? std::pair(1 / std::sqrt(n), 1 / std::sqrt(n)) : std::pair(std::sqrt(2 / n), 1 / std::sqrt(2 * n));
  }

  Index n_;
  std::vector<int> sizes_;
  Buffer in_;
  Buffer out_;
  Plan forward_;
  Plan inverse_;
  Vector forward_scale_;
  Vector inverse_scale_;
};

}  // namespace

std::unique_ptr<FieldTransform> identity_transform(Index unknowns) {
  return std::make_unique<IdentityTransform>(unknowns);
}

std::unique_ptr<FieldTransform> modal_transform(const Grid& grid, bool measure_plan) {
  if (grid.is_periodic()) return std::make_unique<FourierTransform>(grid, measure_plan);
  return std::make_unique<RealTransform>(grid, measure_plan);
}

}  // namespace seiche
