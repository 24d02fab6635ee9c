#include <seiche/backend/fft/fftw_plan.hpp>
#include <seiche/backend/fft/grid_columns.hpp>
#include <seiche/backend/fft/line_kinds.hpp>

#include <fftw3.h>

#include <algorithm>
#include <numbers>

namespace seiche {
namespace {

using std::numbers::sqrt2;

constexpr Index most_columns = 16;  // of a block: some cache lines side by side

// Blocks of up to most_columns neighbouring columns.
class Blocks {
 public:
  explicit Blocks(const Lines& lines)
      : lines_(lines), width_(std::min(most_columns, lines.inner)), per_outer_((lines.inner + width_ - 1) / width_) {}
  Index count() const { return lines_.outer * per_outer_; }
  Index width() const { return width_; }
  Index rest() const { return lines_.inner % width_; }  // columns of a last, narrower block; 0: none
  bool is_rest(Index block) const { return rest() != 0 && block % per_outer_ == per_outer_ - 1; }
  Index begin(Index block) const {  // of its first column
    return block / per_outer_ * lines_.length * lines_.inner + block % per_outer_ * width_;
  }

 private:
  Lines lines_;
  Index width_, per_outer_;
};

class FourierColumns final : public ColumnTransform {
 public:
  FourierColumns(const Lines& lines, bool measure)
      : lines_(lines),
        blocks_(lines),
        buffer_(fftw_buffer(static_cast<std::size_t>(2 * lines.length * lines.inner))),
        forward_(blocks_.width(), blocks_.rest(), measure,
                 [&](int count, unsigned flags) { return plan(count, FFTW_FORWARD, flags); }),
        inverse_(blocks_.width(), blocks_.rest(), measure,
                 [&](int count, unsigned flags) { return plan(count, FFTW_BACKWARD, flags); }) {
    buffer_.reset();  // planned upon only
  }

  Index blocks() const override { return blocks_.count(); }
  void to_slots(double* data, Index block) const override { execute(forward_, data, block); }
  void to_values(double* data, Index block) const override { execute(inverse_, data, block); }

 private:
  fftw_plan plan(int count, int sign, unsigned flags) const {
    const int n = static_cast<int>(lines_.length);
    const int stride = static_cast<int>(lines_.inner);
    FftwComplex* data = pairs(buffer_.get());
    return fftw_plan_many_dft(1, &n, count, data, nullptr, stride, 1, data, nullptr, stride, 1, sign, flags);
  }
  void execute(const BatchPlans& plans, double* data, Index block) const {
    double* at = data + 2 * blocks_.begin(block);
    fftw_execute_dft((blocks_.is_rest(block) ? plans.rest : plans.full).of(at, at), pairs(at), pairs(at));
  }

  Lines lines_;
  Blocks blocks_;
  FftwBuffer buffer_;
  BatchPlans forward_, inverse_;
};

class RealColumns final : public ColumnTransform {
 public:
  RealColumns(const GridAxis& axis, const Lines& lines, bool measure)
      : lines_(lines),
        blocks_(lines),
        alone_(modes_alone(axis)),
        buffer_(fftw_buffer(static_cast<std::size_t>(lines.length * lines.inner))),
        forward_(blocks_.width(), blocks_.rest(), measure,
                 [&](int count, unsigned flags) { return plan(count, kinds_of(axis.boundary).forward, flags); }),
        inverse_(blocks_.width(), blocks_.rest(), measure,
                 [&](int count, unsigned flags) { return plan(count, kinds_of(axis.boundary).inverse, flags); }) {
    buffer_.reset();
  }

  Index blocks() const override { return blocks_.count(); }
  void to_slots(double* data, Index block) const override {
    execute(forward_, data, block);
    scale_alone(data, block, 1 / sqrt2);
  }
  void to_values(double* data, Index block) const override {
    scale_alone(data, block, sqrt2);
    execute(inverse_, data, block);
  }

 private:
  fftw_plan plan(int count, int kind, unsigned flags) const {
    const auto r2r_kind = static_cast<fftw_r2r_kind>(kind);
    const int n = static_cast<int>(lines_.length);
    const int stride = static_cast<int>(lines_.inner);
    double* data = buffer_.get();
    return fftw_plan_many_r2r(1, &n, count, data, nullptr, stride, 1, data, nullptr, stride, 1, &r2r_kind, flags);
  }
  void execute(const BatchPlans& plans, double* data, Index block) const {
    double* at = data + blocks_.begin(block);
    fftw_execute_r2r((blocks_.is_rest(block) ? plans.rest : plans.full).of(at, at), at, at);
  }
  void scale_alone(double* data, Index block, double factor) const {
    const Index width = blocks_.is_rest(block) ? blocks_.rest() : blocks_.width();
    for (const Index position : alone_) {
      double* line = data + blocks_.begin(block) + position * lines_.inner;
      for (Index i = 0; i < width; ++i) line[i] *= factor;
    }
  }

  Lines lines_;
  Blocks blocks_;
  std::vector<Index> alone_;
  FftwBuffer buffer_;
  BatchPlans forward_, inverse_;
};

}  // namespace

std::unique_ptr<ColumnTransform> fourier_columns(const Lines& lines, bool measure) {
  return std::make_unique<FourierColumns>(lines, measure);
}

std::unique_ptr<ColumnTransform> real_columns(const GridAxis& axis, const Lines& lines, bool measure) {
  return std::make_unique<RealColumns>(axis, lines, measure);
}

}  // namespace seiche
