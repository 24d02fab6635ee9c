#include <seiche/backend/modal/mode_kernels.hpp>
#include <seiche/backend/modal/mode_table.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/simd/parallel.hpp>
#include <seiche/core/simd/with_lanes.hpp>

#include <algorithm>
#include <array>
#include <type_traits>

namespace seiche {
namespace {

constexpr Index chunks_per_block = 1024;  // of one thread's share
constexpr Index max_columns = 40;         // the inputs of eight slots wait in the first-level cache
constexpr int unrolled_columns = 8;
constexpr std::size_t max_forms = 4;

// The first `count` lanes, 0 < count < those of V, from memory, and zeros; and into memory. By halves, which stay in
// registers.
template <class V>
[[gnu::always_inline]] inline V load_first(const double* from, Index count) {
  if constexpr (std::is_same_v<V, Pair>) {
    return Pair{from[0], 0};
  } else {
    using Half = typename HalfOf<V>::type;
    constexpr Index half = sizeof(Half) / sizeof(double);
    if (count == half) return joined<V>(load<Half>(from), Half{});
    if (count < half) return joined<V>(load_first<Half>(from, count), Half{});
    return joined<V>(load<Half>(from), load_first<Half>(from + half, count - half));
  }
}

template <class V>
[[gnu::always_inline]] inline void store_first(double* to, Index count, const V& x) {
  if constexpr (std::is_same_v<V, Pair>) {
    *to = x[0];
  } else {
    using Half = typename HalfOf<V>::type;
    constexpr Index half = sizeof(Half) / sizeof(double);
    if (count < half) return store_first<Half>(to, count, low_half(x));
    store<Half>(to, low_half(x));
    if (count > half) store_first<Half>(to + half, count - half, high_half(x));
  }
}

// The inputs of eight slots. `known` of them, or, for 0, any number up to max_columns.
template <class V, ModeLayout layout, int known>
struct Inputs {
  static constexpr bool are_turned = layout == ModeLayout::complex_pairs;
  static constexpr std::size_t capacity = known == 0 ? max_columns : known;
  std::array<V, capacity> x;
  std::array<V, are_turned ? capacity : 0> turned;  // ix, once for all rows
  int count;

  [[gnu::always_inline]] inline explicit Inputs(std::span<const double* const> in)
      : count(known == 0 ? static_cast<int>(in.size()) : known) {}

  // `left`: slots from `begin` to the end of a field
  [[gnu::always_inline]] inline void load_from(const double* const* in, Index begin, Index left) {
    if (left >= lane_count) {
      for (int j = 0; j < size(); ++j) x[j] = load<V>(in[j] + begin);
    } else {
      for (int j = 0; j < size(); ++j) x[j] = load_first<V>(in[j] + begin, left);
    }
    if constexpr (are_turned)
      for (int j = 0; j < size(); ++j) turned[j] = with_first_negated(with_pairs_turned(x[j]));
  }
  // factors of the modes of these slots × input j
  [[gnu::always_inline]] inline V times(const double* factors, int j) const {
    if constexpr (are_turned) {
      const V c = load<V>(factors);
      return of_pairs<0>(c) * x[j] + of_pairs<1>(c) * turned[j];
    } else {
      return mode_kernels::times<layout, V>(factors, 0, x[j]);
    }
  }
  [[gnu::always_inline]] inline int size() const { return known == 0 ? count : known; }
};

template <class V, ModeLayout layout, int known>
[[gnu::always_inline]] inline void sum_rows(const ModeFactors& factors, std::span<const double* const> in,
                                            std::span<double* const> out, Index first, Index last) {
  constexpr Index stride = lane_count / slots_per_mode(layout) * factors_per_mode(layout);
  const Index slots = factors.slots();
  const double* factor = factors.of_chunk(first);
  const double* const* const inputs = in.data();
  double* const* const rows = out.data();
  const std::size_t row_count = out.size();
  Inputs<V, layout, known> x(in);
  for (Index chunk = first; chunk < last; ++chunk) {
    const Index begin = chunk * lane_count;
    const Index left = slots - begin;
    x.load_from(inputs, begin, left);
    for (std::size_t i = 0; i < row_count; ++i) {
      V sum = x.times(factor, 0);
      for (int j = 1; j < x.size(); ++j) sum += x.times(factor + j * stride, j);
      factor += x.size() * stride;
      if (left >= lane_count)
        store<V>(rows[i] + begin, sum);
      else
        store_first<V>(rows[i] + begin, left, sum);
    }
  }
}

template <class V, ModeLayout layout, int known>
[[gnu::always_inline]] inline void sum_forms(const ModeFactors& factors, std::span<const double* const> in, Index first,
                                             Index last, std::span<double> values) {
  constexpr Index stride = lane_count / slots_per_mode(layout) * factors_per_mode(layout);
  const Index slots = factors.slots();
  const double* factor = factors.of_chunk(first);
  const double* const* const inputs = in.data();
  const std::size_t forms = values.size();
  Inputs<V, layout, known> x(in);
  std::array<V, max_forms> totals{};
  for (Index chunk = first; chunk < last; ++chunk) {
    x.load_from(inputs, chunk * lane_count, slots - chunk * lane_count);
    for (std::size_t l = 0; l < forms; ++l) {
      V total = totals[l];
      for (int i = 0; i < x.size(); ++i) {
        V row = x.times(factor, i);
        factor += stride;
        for (int j = i + 1; j < x.size(); ++j, factor += stride) row += x.times(factor, j);
        total += x.x[i] * row;
      }
      totals[l] = total;
    }
  }
  for (std::size_t l = 0; l < forms; ++l) values[l] = sum(totals[l]);
}

template <class Body>
void with_layout(ModeLayout layout, const Body& body) {
  switch (layout) {
    case ModeLayout::real_pairs: return body.template operator()<ModeLayout::real_pairs>();
    case ModeLayout::complex_pairs: return body.template operator()<ModeLayout::complex_pairs>();
    case ModeLayout::singles: return body.template operator()<ModeLayout::singles>();
  }
}

Index blocks_of(const ModeFactors& factors) { return (factors.chunks() + chunks_per_block - 1) / chunks_per_block; }

// body<known>() with the number of columns, where its loops are unrolled: one or two fields of state and those of up to
// four forces, or of eight forces alone.
template <int known = unrolled_columns, class Body>
void with_columns(Index columns, const Body& body) {
  if (columns == known) return body.template operator()<known>();
  if constexpr (known > 1)
    with_columns<known - 1>(columns, body);
  else
    body.template operator()<0>();
}

template <ModeLayout layout, int known>
void sum_rows_in_lanes(const ModeFactors& factors, std::span<const double* const> in, std::span<double* const> out,
                       Index first, Index last) {
  with_lanes([&]<class V>()
                 __attribute__((always_inline)) { sum_rows<V, layout, known>(factors, in, out, first, last); });
}

Index checked_columns(Index columns) {
  if (columns > max_columns)
    throw Error("an exponential method takes sums of up to {} fields of state and forces, and here there are {}",
                max_columns, columns);
  return columns;
}

}  // namespace

ModeFactors::ModeFactors(ModeLayout layout, Index modes, Index per_mode)
    : layout_(layout), slots_(modes * slots_per_mode(layout)), per_mode_(per_mode) {
  factors_ = CacheLines(static_cast<std::size_t>(chunks() * per_mode * stride()));
}

void ModeFactors::set(Index mode, Index which, std::complex<double> factor) {
  const Index modes_per_chunk = lane_count / slots_per_mode(layout_);
  const Index chunk = mode / modes_per_chunk;
  const Index lane = mode % modes_per_chunk * factors_per_mode(layout_);
  double* at = factors_.data() + (chunk * per_mode_ + which) * stride() + lane;
  at[0] = factor.real();
  if (layout_ == ModeLayout::complex_pairs) at[1] = factor.imag();
}

ModeTable::ModeTable(ModeLayout layout, Index modes, Index rows, Index columns)
    : columns_(checked_columns(columns)), factors_(layout, modes, rows * columns) {
  with_layout(layout, [&]<ModeLayout of>() {
    with_columns(columns, [&]<int known>() { sum_rows_ = sum_rows_in_lanes<of, known>; });
  });
}

void ModeTable::apply(std::span<const double* const> in, std::span<double* const> out, int threads) const {
  if (columns_ == 0) {  // of forces alone, where V = 0
    for (double* const row : out) std::fill_n(row, factors_.slots(), 0.0);
    return;
  }
  for_blocks(blocks_of(factors_), threads, [&](Index block) {
    const Index first = block * chunks_per_block;
    sum_rows_(factors_, in, out, first, std::min(factors_.chunks(), first + chunks_per_block));
  });
}

ModeForms::ModeForms(ModeLayout layout, Index modes, Index forms, Index columns, const Space& space)
    : columns_(checked_columns(columns)),
      forms_(forms),
      factors_(layout, modes, forms * columns * (columns + 1) / 2),
      space_(space),
      blocks_(space.slots(), chunks_per_block * lane_count) {
  if (static_cast<std::size_t>(forms) > max_forms)
    throw Error("up to {} forms are taken at a time, and here there are {}", max_forms, forms);
}

void ModeForms::set(Index mode, Index form, Index i, Index j, std::complex<double> factor) {
  factors_.set(mode, entry(form, i, j), i == j ? factor : 2.0 * factor);  // once for both sides
}

// Units begin at whole chunks (units_in_eights).
void ModeForms::apply(std::span<const double* const> in, std::span<double> values, int threads) const {
  blocks_.add(space_, threads, values.first(static_cast<std::size_t>(forms_)),
              [&](Index begin, Index end, std::span<double> sums) {
                const Index first = begin / lane_count, last = groups_of_lanes(end);
                with_layout(factors_.layout(), [&]<ModeLayout layout>() {
                  with_columns(columns_, [&]<int known>() {
                    with_lanes([&]<class V>() __attribute__((always_inline)) {
                      sum_forms<V, layout, known>(factors_, in, first, last, sums);
                    });
                  });
                });
              });
}

}  // namespace seiche
