// The fused passes of a substep over the modes: the formulas once, for any number of fields, as eight slots at a time.
#pragma once

#include <seiche/backend/modal/mode_arrays.hpp>
#include <seiche/core/simd/with_lanes.hpp>

#include <array>
#include <span>
#include <type_traits>

namespace seiche::mode_kernels {

// Which fields there are: `fields` of z, of which V depends on `count` from `first` on. M is diagonal, with one factor
// per mode and field, but for the fields of `unit` (bits) on which it is the identity.
template <ModeLayout layout_, int fields_, int first_, int count_, unsigned unit_>
struct Shape {
  static constexpr ModeLayout layout = layout_;
  static constexpr int fields = fields_, first = first_, count = count_;
  static constexpr bool in_support(int field) { return field >= first && field < first + count; }
  static constexpr bool is_unit(int field) { return (unit_ >> field & 1U) != 0; }
};

template <class S>
struct Operands {
  std::array<const double*, S::fields> z{};  // before the substep
  std::array<double*, S::fields> out{};
  std::array<const double*, S::fields> f{};  // the force: on the support only
  std::array<const double*, S::fields> M{};  // null where it is the identity
  std::array<std::array<const double*, S::fields>, S::fields> F{};
  std::array<const double*, S::fields> f1{}, f2{};  // of `recall`: the forces before f, and before that
  std::array<double, S::fields> before{}, after{};
  double factor = 1.0;
  double weight = 0.0, ratio = 1.0;  // of `recall`
};

// factor of the modes of these slots × slots
template <ModeLayout layout, class V>
[[gnu::always_inline]] inline V times(const double* factors, Index slot, const V& x) {
  if constexpr (layout == ModeLayout::singles) {
    return load<V>(factors + slot) * x;
  } else if constexpr (layout == ModeLayout::real_pairs) {
    return load_twice<V>(factors + slot / 2) * x;
  } else {
    const V c = load<V>(factors + slot);
    return of_pairs<0>(c) * x + with_first_negated(of_pairs<1>(c)) * with_pairs_turned(x);
  }
}

// body(slot, V{}) for eight slots at a time, and for the slots of one mode where fewer are left.
template <ModeLayout layout, class V, class Body>
[[gnu::always_inline]] inline void for_slots(Index slots, const Body& body) {
  using OneMode = std::conditional_t<layout == ModeLayout::singles, double, Pair>;
  Index slot = 0;
  for (; slot + lane_count <= slots; slot += lane_count) body(slot, V{});
  for (; slot < slots; slot += slots_per_mode(layout)) body(slot, OneMode{});
}

// z⁻, and M z⁻ with the real factors of a Hermitian diagonal.
template <class S, class V>
struct Point {
  std::array<V, S::fields> z, Mz;

  [[gnu::always_inline]] inline Point(const Operands<S>& o, Index slot) {
    constexpr ModeLayout real = S::layout == ModeLayout::complex_pairs ? ModeLayout::real_pairs : S::layout;
    for (int j = 0; j < S::fields; ++j) {
      z[j] = o.before[j] * load<V>(o.z[j] + slot);
      Mz[j] = S::is_unit(j) ? z[j] : times<real, V>(o.M[j], slot, z[j]);
    }
  }
};

// Row i of F w.
template <class S, class V>
[[gnu::always_inline]] inline V row(const Operands<S>& o, int i, Index slot, const std::array<V, S::fields>& w) {
  V sum = times<S::layout, V>(o.F[i][0], slot, w[0]);
  for (int j = 1; j < S::fields; ++j) sum += times<S::layout, V>(o.F[i][j], slot, w[j]);
  return sum;
}

// ẑ = z⁻ + Q(Mz⁻ + ∇V), on the support; Q is passed as F.
struct Predict {
  template <class S, class V>
  [[gnu::always_inline]] static inline void at(const Operands<S>& o, Index slot) {
    const Point<S, V> p(o, slot);
    std::array<V, S::fields> w = p.Mz;
    for (int j = S::first; j < S::first + S::count; ++j) w[j] += load<V>(o.f[j] + slot);
    for (int i = S::first; i < S::first + S::count; ++i) store<V>(o.out[i] + slot, p.z[i] + row<S, V>(o, i, slot, w));
  }
};

// z⁺ = Λ'(z⁻ + F(Mz⁻ + factor · f))
struct Update {
  template <class S, class V>
  [[gnu::always_inline]] static inline void at(const Operands<S>& o, Index slot) {
    const Point<S, V> p(o, slot);
    std::array<V, S::fields> w = p.Mz;
    for (int j = S::first; j < S::first + S::count; ++j) w[j] += o.factor * load<V>(o.f[j] + slot);
    for (int i = 0; i < S::fields; ++i) store<V>(o.out[i] + slot, o.after[i] * (p.z[i] + row<S, V>(o, i, slot, w)));
  }
};

// FMz
struct Increment {
  template <class S, class V>
  [[gnu::always_inline]] static inline void at(const Operands<S>& o, Index slot) {
    const Point<S, V> p(o, slot);
    for (int i = 0; i < S::fields; ++i) store<V>(o.out[i] + slot, row<S, V>(o, i, slot, p.Mz));
  }
};

// Fz
struct Force {
  template <class S, class V>
  [[gnu::always_inline]] static inline void at(const Operands<S>& o, Index slot) {
    std::array<V, S::fields> f{};
    for (int j = 0; j < S::fields; ++j) f[j] = load<V>(o.z[j] + slot);
    for (int i = 0; i < S::fields; ++i) store<V>(o.out[i] + slot, row<S, V>(o, i, slot, f));
  }
};

struct PowerSums {
  double of_increment = 0, of_force = 0, twice_energy = 0;
  PowerSums& operator+=(const PowerSums& other) {
    of_increment += other.of_increment;
    of_force += other.of_force;
    twice_energy += other.twice_energy;
    return *this;
  }
  void write_to(std::span<double> sums) const {
    sums[0] = of_increment;
    sums[1] = of_force;
    sums[2] = twice_energy;
  }
};

// fᵀFMz⁻, fᵀFf and z⁻ᵀMz⁻ of one chunk, lane by lane.
template <class S, class V>
struct PowerLanes {
  V of_increment{}, of_force{}, twice_energy{};

  [[gnu::always_inline]] inline void add(const Operands<S>& o, Index slot) {
    const Point<S, V> p(o, slot);
    std::array<V, S::fields> f{};
    for (int j = S::first; j < S::first + S::count; ++j) f[j] = load<V>(o.f[j] + slot);
    for (int i = S::first; i < S::first + S::count; ++i) {
      of_increment += f[i] * row<S, V>(o, i, slot, p.Mz);
      V Ff = times<S::layout, V>(o.F[i][S::first], slot, f[S::first]);
      for (int j = S::first + 1; j < S::first + S::count; ++j) Ff += times<S::layout, V>(o.F[i][j], slot, f[j]);
      of_force += f[i] * Ff;
    }
    for (int j = 0; j < S::fields; ++j) twice_energy += p.z[j] * p.Mz[j];
  }
  PowerSums sums() const { return {sum(of_increment), sum(of_force), sum(twice_energy)}; }
};

struct RecallSums {
  double missed = 0, moved = 0;
  RecallSums& operator+=(const RecallSums& other) {
    missed += other.missed;
    moved += other.moved;
    return *this;
  }
  void write_to(std::span<double> sums) const {
    sums[0] = missed;
    sums[1] = moved;
  }
};

// ẑ = z⁻ + Q(Mz⁻ + ḡ) with ḡ = f + weight·(f − f₁), on the support, and the squares of ẑ − z⁻ and of Qd with
// d = f − f₁ − ratio·(f₁ − f₂); Q is passed as F.
template <class S, class V>
struct RecallLanes {
  V missed{}, moved{};

  [[gnu::always_inline]] inline void add(const Operands<S>& o, Index slot) {
    const Point<S, V> p(o, slot);
    std::array<V, S::fields> w = p.Mz, d{};
    for (int j = S::first; j < S::first + S::count; ++j) {
      const V f = load<V>(o.f[j] + slot), f1 = load<V>(o.f1[j] + slot);
      w[j] += f + o.weight * (f - f1);
      d[j] = (f - f1) - o.ratio * (f1 - load<V>(o.f2[j] + slot));
    }
    for (int i = S::first; i < S::first + S::count; ++i) {
      const V move = row<S, V>(o, i, slot, w);
      store<V>(o.out[i] + slot, p.z[i] + move);
      V Qd = times<S::layout, V>(o.F[i][S::first], slot, d[S::first]);
      for (int j = S::first + 1; j < S::first + S::count; ++j) Qd += times<S::layout, V>(o.F[i][j], slot, d[j]);
      missed += Qd * Qd;
      moved += move * move;
    }
  }
  RecallSums sums() const { return {sum(missed), sum(moved)}; }
};

template <class S>
using Last = std::conditional_t<S::layout == ModeLayout::singles, double, Pair>;  // what is left behind full lanes

template <class Verb, class S>
void run(const Operands<S>& operands, Index begin, Index end) {
  with_lanes([&]<class V>() __attribute__((always_inline)) {
    using Half = typename HalfOf<V>::type;
    const Operands<S> o = operands;  // a copy that no store can change
    Index slot = begin;
    for (; slot + lane_count <= end; slot += lane_count) Verb::template at<S, V>(o, slot);
    if (slot + lane_count / 2 <= end) {
      Verb::template at<S, Half>(o, slot);
      slot += lane_count / 2;
    }
    for (; slot < end; slot += slots_per_mode(S::layout)) Verb::template at<S, Last<S>>(o, slot);
  });
}

// What LanesOf adds up, over these slots.
template <template <class, class> class LanesOf, class S>
auto sums_of(const Operands<S>& operands, Index begin, Index end) {
  return with_lanes([&]<class V>() __attribute__((always_inline)) {
    using Half = typename HalfOf<V>::type;
    const Operands<S> o = operands;
    LanesOf<S, V> lanes;
    LanesOf<S, Half> half;
    LanesOf<S, Last<S>> last;
    Index slot = begin;
    for (; slot + lane_count <= end; slot += lane_count) lanes.add(o, slot);
    if (slot + lane_count / 2 <= end) {
      half.add(o, slot);
      slot += lane_count / 2;
    }
    for (; slot < end; slot += slots_per_mode(S::layout)) last.add(o, slot);
    auto sums = lanes.sums();
    sums += half.sums();
    return sums += last.sums();
  });
}

}  // namespace seiche::mode_kernels
