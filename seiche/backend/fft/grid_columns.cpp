#include <seiche/backend/fft/batches.hpp>
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

// How the numbers of lines lie in one array: distances, in numbers or pairs, along a line, from one to the next, and
// from one group of lines to the next.
struct Strides {
  Index along, across, outer;
};

// Lines of all groups, in blocks.
class Blocks {
 public:
  Blocks(Index outer, Index lines) : lines_(lines, most_columns), count_(outer * lines_.count()) {}
  Index count() const { return count_; }
  Index width() const { return lines_.width(); }
  Index rest() const { return lines_.rest(); }
  Index width_of(Index block) const { return lines_.size(block % lines_.count()); }
  bool is_full(Index block) const { return width_of(block) == width(); }
  Index begin(Index block, const Strides& at) const {  // of its first column
    return block / lines_.count() * at.outer + lines_.begin(block % lines_.count()) * at.across;
  }

 private:
  Batches lines_;
  Index count_;
};

// Where lines lie before and behind a transform, in one array or in two.
struct Places {
  Index length, outer, count;  // of a line; groups of lines, and lines of a group
  Strides values, slots;
  bool in_place;

  Index size() const { return length * outer * count; }
  Index size_of_values() const { return in_place ? size() : length * values.along; }
};

Places in_place(const Lines& l) {
  const Strides strides{.along = l.inner, .across = 1, .outer = l.length * l.inner};
  return {
      .length = l.length, .outer = l.outer, .count = l.inner, .values = strides, .slots = strides, .in_place = true};
}

// Where nothing lies behind the middle, its numbers are the lines side by side.
Places turned(const Turned& l) {
  const bool in_lines = l.inner == 1;
  return {.length = l.length,
          .outer = in_lines ? 1 : l.middle,
          .count = in_lines ? l.middle : l.inner,
          .values = {.along = l.stride, .across = 1, .outer = l.inner},
          .slots = {.along = l.inner, .across = in_lines ? l.length : 1, .outer = l.length * l.inner},
          .in_place = false};
}

class FourierColumns final : public ColumnTransform {
 public:
  FourierColumns(const Places& places, bool measure)
      : places_(places),
        blocks_(places.outer, places.count),
        values_(fftw_buffer(static_cast<std::size_t>(2 * places.size_of_values()))),
        slots_(fftw_buffer(static_cast<std::size_t>(places.in_place ? 0 : 2 * places.size()))),
        forward_(blocks_.width(), blocks_.rest(), measure,
                 [&](int count, unsigned flags) {
                   return plan(values_, places_.values, slots_, places_.slots, count, FFTW_FORWARD, flags);
                 }),
        inverse_(blocks_.width(), blocks_.rest(), measure, [&](int count, unsigned flags) {
          return plan(slots_, places_.slots, values_, places_.values, count, FFTW_BACKWARD, flags);
        }) {
    values_.reset();  // planned upon only
    slots_.reset();
  }

  Index blocks() const override { return blocks_.count(); }
  void to_slots(double* values, double* slots, Index block) const override {
    execute(forward_, values + 2 * blocks_.begin(block, places_.values),
            slots + 2 * blocks_.begin(block, places_.slots), block);
  }
  void to_values(double* slots, double* values, Index block) const override {
    execute(inverse_, slots + 2 * blocks_.begin(block, places_.slots),
            values + 2 * blocks_.begin(block, places_.values), block);
  }

 private:
  fftw_plan plan(const FftwBuffer& from, const Strides& in, const FftwBuffer& to, const Strides& out, int count,
                 int sign, unsigned flags) const {
    const int n = static_cast<int>(places_.length);
    double* const a = (places_.in_place ? values_ : from).get();
    double* const b = (places_.in_place ? values_ : to).get();
    return fftw_plan_many_dft(1, &n, count, pairs(a), nullptr, static_cast<int>(in.along), static_cast<int>(in.across),
                              pairs(b), nullptr, static_cast<int>(out.along), static_cast<int>(out.across), sign,
                              flags);
  }
  void execute(const BatchPlans& plans, double* from, double* to, Index block) const {
    fftw_execute_dft((blocks_.is_full(block) ? plans.full : plans.rest).of(from, to), pairs(from), pairs(to));
  }

  Places places_;
  Blocks blocks_;
  FftwBuffer values_, slots_;
  BatchPlans forward_, inverse_;
};

class RealColumns final : public ColumnTransform {
 public:
  RealColumns(const GridAxis& axis, const Places& places, bool measure)
      : places_(places),
        blocks_(places.outer, places.count),
        alone_(modes_alone(axis)),
        values_(fftw_buffer(static_cast<std::size_t>(places.size_of_values()))),
        slots_(fftw_buffer(static_cast<std::size_t>(places.in_place ? 0 : places.size()))),
        forward_(blocks_.width(), blocks_.rest(), measure,
                 [&](int count, unsigned flags) {
                   return plan(values_, places_.values, slots_, places_.slots, count, kinds_of(axis.boundary).forward,
                               flags);
                 }),
        inverse_(blocks_.width(), blocks_.rest(), measure, [&](int count, unsigned flags) {
          return plan(slots_, places_.slots, values_, places_.values, count, kinds_of(axis.boundary).inverse, flags);
        }) {
    values_.reset();
    slots_.reset();
  }

  Index blocks() const override { return blocks_.count(); }
  void to_slots(double* values, double* slots, Index block) const override {
    double* const to = slots + blocks_.begin(block, places_.slots);
    execute(forward_, values + blocks_.begin(block, places_.values), to, block);
    scale_alone(to, block, 1 / sqrt2);
  }
  void to_values(double* slots, double* values, Index block) const override {
    double* const from = slots + blocks_.begin(block, places_.slots);
    scale_alone(from, block, sqrt2);
    execute(inverse_, from, values + blocks_.begin(block, places_.values), block);
  }

 private:
  fftw_plan plan(const FftwBuffer& from, const Strides& in, const FftwBuffer& to, const Strides& out, int count,
                 int kind, unsigned flags) const {
    const auto r2r_kind = static_cast<fftw_r2r_kind>(kind);
    const int n = static_cast<int>(places_.length);
    double* const a = (places_.in_place ? values_ : from).get();
    double* const b = (places_.in_place ? values_ : to).get();
    return fftw_plan_many_r2r(1, &n, count, a, nullptr, static_cast<int>(in.along), static_cast<int>(in.across), b,
                              nullptr, static_cast<int>(out.along), static_cast<int>(out.across), &r2r_kind, flags);
  }
  void execute(const BatchPlans& plans, double* from, double* to, Index block) const {
    fftw_execute_r2r((blocks_.is_full(block) ? plans.full : plans.rest).of(from, to), from, to);
  }
  void scale_alone(double* first, Index block, double factor) const {
    for (const Index position : alone_)
      for (Index i = 0; i < blocks_.width_of(block); ++i)
        first[position * places_.slots.along + i * places_.slots.across] *= factor;
  }

  Places places_;
  Blocks blocks_;
  std::vector<Index> alone_;
  FftwBuffer values_, slots_;
  BatchPlans forward_, inverse_;
};

// Of a process that holds no plane; FFTW plans no lines.
class NoColumns final : public ColumnTransform {
 public:
  Index blocks() const override { return 0; }
  void to_slots(double*, double*, Index) const override {}
  void to_values(double*, double*, Index) const override {}
};

template <class Columns, class... Arguments>
std::unique_ptr<ColumnTransform> columns(const Places& places, const Arguments&... arguments) {
  if (places.size() == 0) return std::make_unique<NoColumns>();
  return std::make_unique<Columns>(arguments...);
}

}  // namespace

std::unique_ptr<ColumnTransform> fourier_columns(const Lines& lines, bool measure) {
  return columns<FourierColumns>(in_place(lines), in_place(lines), measure);
}

std::unique_ptr<ColumnTransform> real_columns(const GridAxis& axis, const Lines& lines, bool measure) {
  return columns<RealColumns>(in_place(lines), axis, in_place(lines), measure);
}

std::unique_ptr<ColumnTransform> turned_fourier_columns(const Turned& lines, bool measure) {
  return columns<FourierColumns>(turned(lines), turned(lines), measure);
}

std::unique_ptr<ColumnTransform> turned_real_columns(const GridAxis& axis, const Turned& lines, bool measure) {
  return columns<RealColumns>(turned(lines), axis, turned(lines), measure);
}

}  // namespace seiche
