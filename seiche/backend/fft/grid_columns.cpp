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

// Arrays for FFTW to plan upon, one where lines are transformed in place.
struct Planned {
  FftwBuffer first, second;

  Planned(const Places& places, Index numbers)  // 2: of pairs
      : first(fftw_buffer(static_cast<std::size_t>(numbers * places.size_of_values()))) {
    if (!places.in_place) second = fftw_buffer(static_cast<std::size_t>(numbers * places.size()));
  }
  double* values() const { return first.get(); }
  double* slots() const { return second ? second.get() : first.get(); }
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
        forward_(plans(Planned(places, 2), true, measure)),
        inverse_(plans(Planned(places, 2), false, measure)) {}

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
  BatchPlans plans(const Planned& on, bool forward, bool measure) const {
    const Strides &in = forward ? places_.values : places_.slots, &out = forward ? places_.slots : places_.values;
    FftwComplex* const from = pairs(forward ? on.values() : on.slots());
    FftwComplex* const to = pairs(forward ? on.slots() : on.values());
    const int n = static_cast<int>(places_.length), sign = forward ? FFTW_FORWARD : FFTW_BACKWARD;
    return {blocks_.width(), blocks_.rest(), measure, [&](int count, unsigned flags) {
              return fftw_plan_many_dft(1, &n, count, from, nullptr, static_cast<int>(in.along),
                                        static_cast<int>(in.across), to, nullptr, static_cast<int>(out.along),
                                        static_cast<int>(out.across), sign, flags);
            }};
  }
  void execute(const BatchPlans& plans, double* from, double* to, Index block) const {
    fftw_execute_dft((blocks_.is_full(block) ? plans.full : plans.rest).of(from, to), pairs(from), pairs(to));
  }

  Places places_;
  Blocks blocks_;
  BatchPlans forward_, inverse_;
};

class RealColumns final : public ColumnTransform {
 public:
  RealColumns(const Places& places, const GridAxis& axis, bool measure)
      : places_(places),
        blocks_(places.outer, places.count),
        alone_(modes_alone(axis)),
        forward_(plans(Planned(places, 1), axis.boundary, true, measure)),
        inverse_(plans(Planned(places, 1), axis.boundary, false, measure)) {}

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
  BatchPlans plans(const Planned& on, Boundary boundary, bool forward, bool measure) const {
    const Strides &in = forward ? places_.values : places_.slots, &out = forward ? places_.slots : places_.values;
    double* const from = forward ? on.values() : on.slots();
    double* const to = forward ? on.slots() : on.values();
    const int n = static_cast<int>(places_.length);
    const LineKinds kinds = kinds_of(boundary);
    const auto kind = static_cast<fftw_r2r_kind>(forward ? kinds.forward : kinds.inverse);
    return {blocks_.width(), blocks_.rest(), measure, [&](int count, unsigned flags) {
              return fftw_plan_many_r2r(1, &n, count, from, nullptr, static_cast<int>(in.along),
                                        static_cast<int>(in.across), to, nullptr, static_cast<int>(out.along),
                                        static_cast<int>(out.across), &kind, flags);
            }};
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
  return std::make_unique<Columns>(places, arguments...);
}

}  // namespace

std::unique_ptr<ColumnTransform> fourier_columns(const Lines& lines, bool measure) {
  return columns<FourierColumns>(in_place(lines), measure);
}

std::unique_ptr<ColumnTransform> real_columns(const GridAxis& axis, const Lines& lines, bool measure) {
  return columns<RealColumns>(in_place(lines), axis, measure);
}

std::unique_ptr<ColumnTransform> turned_fourier_columns(const Turned& lines, bool measure) {
  return columns<FourierColumns>(turned(lines), measure);
}

std::unique_ptr<ColumnTransform> turned_real_columns(const GridAxis& axis, const Turned& lines, bool measure) {
  return columns<RealColumns>(turned(lines), axis, measure);
}

}  // namespace seiche
