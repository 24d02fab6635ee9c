#include <seiche/backend/sparse/equal_rows.hpp>
#include <seiche/core/simd/long_sum.hpp>
#include <seiche/core/simd/with_lanes.hpp>

#include <algorithm>
#include <array>
#include <map>

namespace seiche {
namespace {

using Run = EqualRows::Run;
using Kind = EqualRows::Kind;
using Operands = EqualRows::Operands;
using KickAndDrift = Kicks::KickAndDrift;

// Row j of x, or rows j … j + 3 or j … j + 7.
template <class V, std::size_t taps, class Visit>
[[gnu::always_inline]] inline void visit_row(const std::array<Index, taps>& offsets, const std::array<double, taps>& a,
                                             const double* x, Index j, Visit& visit) {
  V sum{}, size{};
  for (std::size_t k = 0; k < taps; ++k) visit.add(sum, size, a[k], load<V>(x + j + offsets[k]));
  visit.row(j, sum, size);
}

// The rows of a run, eight at a time, from a row on that begins a line of the cache where the vectors do; the rest four
// at a time, and then one. Copies keep in registers what the stores of a visit might otherwise be thought to change.
template <std::size_t taps, class Visit>
[[gnu::always_inline]] inline void visit_rows(const Run& run, const double* x, Visit& all) {
  std::array<Index, taps> offsets{};
  std::array<double, taps> a{};
  std::copy_n(run.kind->offsets.begin(), taps, offsets.begin());
  std::copy_n(run.kind->coefficients.begin(), taps, a.begin());
  Visit visit = all;
  constexpr Index few = 64;  // rows, of which too many would come one at a time
  Index j = run.begin;
  if (run.end - run.begin >= few)
    for (; j % lane_count != 0; ++j) visit_row<double>(offsets, a, x, j, visit);
  for (; j + lane_count <= run.end; j += lane_count) visit_row<typename Visit::EightRows>(offsets, a, x, j, visit);
  if (j + lane_count / 2 <= run.end) {
    visit_row<typename HalfOf<typename Visit::EightRows>::type>(offsets, a, x, j, visit);
    j += lane_count / 2;
  }
  for (; j < run.end; ++j) visit_row<double>(offsets, a, x, j, visit);
  all = visit;
}

// A row with any number of taps.
template <class Visit>
void visit_any_rows(const Run& run, const double* x, Visit& visit) {
  for (Index j = run.begin; j < run.end; ++j) {
    double sum = 0, size = 0;
    for (std::size_t k = 0; k < run.kind->offsets.size(); ++k)
      visit.add(sum, size, run.kind->coefficients[k], x[j + run.kind->offsets[k]]);
    visit.row(j, sum, size);
  }
}

// Unrolled for the numbers of taps that differences of order two and four have in one, two and three dimensions, and of
// order two at ends.
template <class Visit>
[[gnu::always_inline]] inline void visit_runs(std::span<const Run> runs, const double* x, Visit& visit) {
  for (const Run& run : runs) {
    switch (run.kind->offsets.size()) {
      case 0: visit_rows<0>(run, x, visit); break;
      case 1: visit_rows<1>(run, x, visit); break;
      case 2: visit_rows<2>(run, x, visit); break;
      case 3: visit_rows<3>(run, x, visit); break;
      case 4: visit_rows<4>(run, x, visit); break;
      case 5: visit_rows<5>(run, x, visit); break;
      case 6: visit_rows<6>(run, x, visit); break;
      case 7: visit_rows<7>(run, x, visit); break;
      case 9: visit_rows<9>(run, x, visit); break;
      case 13: visit_rows<13>(run, x, visit); break;
      default: visit_any_rows(run, x, visit);
    }
  }
}

template <class L>
struct Sums {
  using Half = typename HalfOf<L>::type;
  L lanes{};
  Half half{};
  double rest = 0;
  Sums() = default;
  // One by one: a whole register read from where a single number has just been written would wait for the memory.
  // NOLINTNEXTLINE(modernize-use-equals-default): that would copy all bytes in whole registers
  [[gnu::always_inline]] inline Sums(const Sums& other) : lanes(other.lanes), half(other.half), rest(other.rest) {}
  [[gnu::always_inline]] inline Sums& operator=(const Sums& other) {  // NOLINT(modernize-use-equals-default): likewise
    lanes = other.lanes;
    half = other.half;
    rest = other.rest;
    return *this;
  }
  [[gnu::always_inline]] inline void add(const L& x) { lanes += x; }
  [[gnu::always_inline]] inline void add(const Half& x) { half += x; }
  [[gnu::always_inline]] inline void add(double x) { rest += x; }
  [[gnu::always_inline]] inline double total() const { return sum(lanes) + sum(half) + rest; }
};

template <class L>
struct RowProduct {
  using EightRows = L;
  template <class V>
  [[gnu::always_inline]] static inline void add(V& sum, V&, double a, const V& x) {
    sum += a * x;
  }
};

template <class L>
struct Store : RowProduct<L> {
  explicit Store(double* into) : out(into) {}
  double* out;
  template <class V>
  [[gnu::always_inline]] inline void row(Index j, const V& sum, const V&) const {
    store(out + j, sum);
  }
};

template <class L>
struct Form : RowProduct<L> {
  explicit Form(const double* of) : x(of) {}
  const double* x;
  Sums<L> total{};
  template <class V>
  [[gnu::always_inline]] inline void row(Index j, const V& sum, const V&) {
    total.add(V(load<V>(x + j) * sum));
  }
};

template <class L>
struct FormAndMagnitude {
  using EightRows = L;
  const double* x = nullptr;
  Sums<L> total{}, magnitude{};
  template <class V>
  [[gnu::always_inline]] static inline void add(V& sum, V& size, double a, const V& x) {
    sum += a * x;
    size += absolute(V(a * x));
  }
  template <class V>
  [[gnu::always_inline]] inline void row(Index j, const V& sum, const V& size) {
    const V here = load<V>(x + j);
    total.add(V(here * sum));
    magnitude.add(V(absolute(here) * size));
  }
};

template <class L, bool has_g>
struct Subtract : RowProduct<L> {
  Subtract(double factor, const Operands& in, double* into)
      : c(factor), g(in.g), y(in.y), g_begin(in.g_begin), out(into) {}
  double c;
  const double *g, *y;
  Index g_begin;
  double* out;
  template <class V>
  [[gnu::always_inline]] inline V after(Index j, const V& sum) const {
    V F = sum;
    if constexpr (has_g) F += load<V>(g + (j - g_begin));
    return load<V>(y + j) - c * F;
  }
  template <class V>
  [[gnu::always_inline]] inline void row(Index j, const V& sum, const V&) const {
    store(out + j, after(j, sum));
  }
};

template <class L, bool has_g>
struct SubtractAndDrift : Subtract<L, has_g> {
  // NOLINTNEXTLINE(readability-non-const-parameter): the base writes to y_into
  SubtractAndDrift(const KickAndDrift& factors, const Operands& in, double* x_into, double* y_into)
      : Subtract<L, has_g>(factors.kick, in, y_into),
        x(in.x),
        x_after(x_into),
        length(factors.length),
        decay(factors.decay) {}
  const double* x;
  double* x_after;
  double length, decay;
  Sums<L> squares{};
  template <class V>
  [[gnu::always_inline]] inline void row(Index j, const V& sum, const V&) {
    const V p = this->after(j, sum);
    squares.add(V(p * p));
    store(x_after + j, V(load<V>(x + j) + length * p));
    store(this->out + j, V(decay * p));
  }
};

// NOLINTBEGIN(readability-non-const-parameter): visits write there
void apply_rows(std::span<const Run> runs, const double* x, double* out) {
  with_lanes([&]<class L>() __attribute__((always_inline)) {
    Store<L> visit(out);
    visit_runs(runs, x, visit);
  });
}

// NOLINTEND(readability-non-const-parameter)

// visit(part) for parts of runs, each a block of a long sum: for all of them at once where they are one block.
template <class Visit>
[[gnu::always_inline]] inline void for_blocks(std::span<const Run> runs, const Visit& visit) {
  constexpr Index block = lane_count * 128;
  if (runs.empty() || runs.back().end <= block) return visit(runs);
  for (Run part : runs) {
    const Index end = part.end;
    for (; part.begin < end; part.begin = part.end) {
      part.end = std::min(end, (part.begin / block + 1) * block);
      visit(std::span<const Run>(&part, 1));
    }
  }
}

double form_of_rows(std::span<const Run> runs, const double* x) {
  return with_lanes([&]<class L>() __attribute__((always_inline)) {
    LongSum total;
    for_blocks(
        runs, [&](std::span<const Run> part) __attribute__((always_inline)) {
          Form<L> visit(x);
          visit_runs(part, x, visit);
          total.add(visit.total.total());
        });
    return total.total();
  });
}

ValueAndMagnitude form_and_magnitude_of_rows(std::span<const Run> runs, const double* x) {
  return with_lanes([&]<class L>() __attribute__((always_inline)) {
    LongSum total, magnitude;
    for_blocks(
        runs, [&](std::span<const Run> part) __attribute__((always_inline)) {
          FormAndMagnitude<L> visit{.x = x};
          visit_runs(part, x, visit);
          total.add(visit.total.total());
          magnitude.add(visit.magnitude.total());
        });
    return ValueAndMagnitude{total.total(), magnitude.total()};
  });
}

}  // namespace

// NOLINTBEGIN(readability-non-const-parameter): visits write there
void subtract_rows(std::span<const Run> runs, double c, const Operands& in, double* out) {
  with_lanes([&]<class L>() __attribute__((always_inline)) {
    if (in.g != nullptr) {
      Subtract<L, true> visit(c, in, out);
      visit_runs(runs, in.x, visit);
    } else {
      Subtract<L, false> visit(c, in, out);
      visit_runs(runs, in.x, visit);
    }
  });
}

double kick_and_drift(std::span<const Run> runs, const KickAndDrift& factors, const Operands& in, double* x_after,
                      double* y_after) {
  return with_lanes([&]<class L>() __attribute__((always_inline)) {
    const auto go = [&](auto visit) __attribute__((always_inline)) {
      visit_runs(runs, in.x, visit);
      return visit.squares.total();
    };
    if (in.g != nullptr) return go(SubtractAndDrift<L, true>(factors, in, x_after, y_after));
    return go(SubtractAndDrift<L, false>(factors, in, x_after, y_after));
  });
}

// NOLINTEND(readability-non-const-parameter)

std::optional<EqualRows> EqualRows::of(const SparseMatrix& A, Limit limit) {
  constexpr std::size_t most_kinds =
      512;  // 5³ of one periodic field in three dimensions, with differences of order four
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = A;
  EqualRows result;
  result.size_ = A.rows();
  Kind kind;
  for (Index i = 0; i < by_rows.rows(); ++i) {
    kind.offsets.clear();
    kind.coefficients.clear();
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(by_rows, i); entry; ++entry) {
      kind.offsets.push_back(entry.col() - i);
      kind.coefficients.push_back(entry.value());
    }
    const auto is_it = [&](const Kind& other) {
      return other.offsets == kind.offsets && other.coefficients == kind.coefficients;
    };
    if (!result.runs_.empty() && is_it(*result.runs_.back().kind)) {
      ++result.runs_.back().end;
      continue;
    }
    auto known =
        std::find_if(result.kinds_.begin(), result.kinds_.end(), [&](const auto& other) { return is_it(*other); });
    if (known == result.kinds_.end()) {
      if (limit == Limit::of_gain && result.kinds_.size() == most_kinds) return std::nullopt;
      result.kinds_.push_back(std::make_shared<const Kind>(kind));
      known = std::prev(result.kinds_.end());
    }
    result.runs_.push_back({i, i + 1, known->get()});
  }
  constexpr std::size_t few_runs = 16;
  const std::size_t most_runs = few_runs + static_cast<std::size_t>(A.rows()) / lane_count;
  if (limit == Limit::of_gain && result.runs_.size() > most_runs) return std::nullopt;
  return result;
}

const EqualRows::Kind* EqualRows::ring() const {
  if (runs_.empty()) return nullptr;
  const Run& longest = *std::max_element(runs_.begin(), runs_.end(),
                                         [](const Run& a, const Run& b) { return a.end - a.begin < b.end - b.begin; });
  const auto around = [&](const Kind& kind) {
    std::map<Index, double> row;
    for (std::size_t k = 0; k < kind.offsets.size(); ++k)
      row[(kind.offsets[k] + size_) % size_] += kind.coefficients[k];
    return row;
  };
  const bool is_ring = std::all_of(kinds_.begin(), kinds_.end(),
                                   [&](const auto& kind) { return around(*kind) == around(*longest.kind); });
  return is_ring ? longest.kind : nullptr;
}

void EqualRows::cut_runs(Index length) {
  std::vector<Run> cut;
  for (const Run& run : runs_)
    for (Index begin = run.begin; begin < run.end;) {
      const Index end = std::min(run.end, (begin / length + 1) * length);
      cut.push_back({begin, end, run.kind});
      begin = end;
    }
  runs_ = std::move(cut);
}

void EqualRows::apply(const Vector& x, Vector& out) const { apply_rows(runs_, x.data(), out.data()); }

double EqualRows::form(const Vector& x) const { return form_of_rows(runs_, x.data()); }

ValueAndMagnitude EqualRows::form_and_magnitude(const Vector& x) const {
  return form_and_magnitude_of_rows(runs_, x.data());
}

}  // namespace seiche
