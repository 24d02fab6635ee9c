#include <seiche/backend/modal/modal_propagator.hpp>
#include <seiche/backend/modal/mode_kernels.hpp>
#include <seiche/backend/modal/unit_blocks.hpp>
#include <seiche/core/simd/parallel.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace seiche {
namespace {

using namespace mode_kernels;

constexpr Index block_slots = 8192;  // of one thread's share

template <class S>
class FusedPropagator final : public Propagator {
 public:
  FusedPropagator(const Space& space, const ModalExtent& extent, const ModalMetric& metric, ModalForceMaps maps)
      : space_(space),
        slots_(extent.slots()),
        blocks_((slots_ + block_slots - 1) / block_slots),
        threads_(extent.threads),
        metric_(metric),
        maps_(std::move(maps)),
        step_(with_maps(maps_.F)),
        middle_(with_maps(maps_.Q)),
        of_units_(space.slots(), block_slots) {}

  void increment(const Vector& z, Vector& dz) const override {
    Operands<S> o = step_;
    point(o, z, nullptr, &dz, {});
    run_over<Increment>(o);
  }
  void force(const Vector& f, Vector& q) const override {
    Operands<S> o = step_;
    point(o, f, nullptr, &q, {});
    run_over<Force>(o);
  }

  void predict(const Vector& z, const Vector& gradient, Vector& z_mid, FieldFactors before) const override {
    point(middle_, z, &gradient, &z_mid, before);
    run_over<Predict>(middle_);
  }

  bool recall(const Vector& z, const Gradients& g, Vector& z_mid, FieldFactors before,
              Recalled& recalled) const override {
    point(middle_, z, &g.g0, &z_mid, before);
    for (int i = 0; i < S::fields; ++i) {
      const auto at = static_cast<std::size_t>(i);
      middle_.f1[at] = g.g1.data() + i * slots_;
      middle_.f2[at] = g.g2.data() + i * slots_;
    }
    middle_.weight = g.weight;
    middle_.ratio = g.ratio;
    std::array<double, 2> sums{};
    add_up<RecallLanes>(middle_, sums);
    recalled = {.missed = sums[0], .moved = sums[1]};
    return true;
  }

  Powers powers(const Vector& z, const Vector& f, FieldFactors before) const override {
    point(step_, z, &f, nullptr, before);
    std::array<double, 3> sums{};
    add_up<PowerLanes>(step_, sums);
    return {.of_increment = sums[0], .of_force = sums[1], .quadratic_energy = sums[2] / 2};
  }
  void update(Vector& z, const Vector& f, double c, FieldFactors before, FieldFactors after) const override {
    point(step_, z, &f, &z, before);
    set(step_.after, after);
    step_.factor = c;
    run_over<Update>(step_);
  }

 private:
  Index begin(Index block) const { return block * block_slots; }
  Index end(Index block) const { return std::min(slots_, begin(block) + block_slots); }

  Operands<S> with_maps(const ModeArrays& F) const {
    Operands<S> o;
    for (int i = 0; i < S::fields; ++i) {
      const auto at = static_cast<std::size_t>(i);
      o.M[at] = metric_.factors.data(i, 0);
      for (int j = 0; j < S::fields; ++j) o.F[at][static_cast<std::size_t>(j)] = F.data(i, j);
    }
    return o;
  }
  void point(Operands<S>& o, const Vector& z, const Vector* f, Vector* out, FieldFactors before) const {
    for (int i = 0; i < S::fields; ++i) {
      const auto at = static_cast<std::size_t>(i);
      o.z[at] = z.data() + i * slots_;
      if (f != nullptr) o.f[at] = f->data() + i * slots_;
      if (out != nullptr) o.out[at] = out->data() + i * slots_;
    }
    set(o.before, before);
  }
  static void set(std::array<double, S::fields>& factors, FieldFactors given) {
    for (std::size_t i = 0; i < factors.size(); ++i) factors[i] = given.empty() ? 1.0 : given[i];
  }

  template <template <class, class> class LanesOf>
  void add_up(const Operands<S>& o, std::span<double> totals) const {
    of_units_.add(space_, threads_, totals, [&](Index begin, Index end, std::span<double> sums) {
      mode_kernels::sums_of<LanesOf, S>(o, begin, end).write_to(sums);
    });
  }
  template <class Verb>
  void run_over(const Operands<S>& o) const {
    for_blocks(blocks_, threads_, [&](Index block) { run<Verb, S>(o, begin(block), end(block)); });
  }

  const Space& space_;
  Index slots_, blocks_;
  int threads_;
  const ModalMetric& metric_;
  ModalForceMaps maps_;
  mutable Operands<S> step_, middle_;  // with F, and with Q
  UnitBlocks of_units_;
};

using Make = std::unique_ptr<Propagator> (*)(const Space&, const ModalExtent&, const ModalMetric&, ModalForceMaps);

template <ModeLayout layout, int fields, int first, int count, unsigned unit>
std::unique_ptr<Propagator> make(const Space& space, const ModalExtent& extent, const ModalMetric& metric,
                                 ModalForceMaps maps) {
  using S = Shape<layout, fields, first, count, unit>;
  return std::make_unique<FusedPropagator<S>>(space, extent, metric, std::move(maps));
}

// One field; second-order equations (u, v), with V of u and M the identity on v or not; pairs of fields, with V of
// both.
template <ModeLayout layout>
Make find_in(Index fields, Index first, Index count, unsigned unit) {
  if (first != 0) return nullptr;
  if (fields == 1 && count == 1 && unit == 0) return make<layout, 1, 0, 1, 0>;
  if (fields == 2 && count == 1 && unit == 0b10) return make<layout, 2, 0, 1, 0b10>;
  if (fields == 2 && count == 1 && unit == 0) return make<layout, 2, 0, 1, 0>;
  if (fields == 2 && count == 2 && unit == 0) return make<layout, 2, 0, 2, 0>;
  return nullptr;
}

Make find(const ModalExtent& e, unsigned unit) {
  switch (e.layout) {
    case ModeLayout::real_pairs: return find_in<ModeLayout::real_pairs>(e.fields, e.first, e.count, unit);
    case ModeLayout::complex_pairs: return find_in<ModeLayout::complex_pairs>(e.fields, e.first, e.count, unit);
    case ModeLayout::singles: return find_in<ModeLayout::singles>(e.fields, e.first, e.count, unit);
  }
  return nullptr;
}

template <ModeLayout layout, class V>
[[gnu::always_inline]] inline double weighted_square_of(const double* M, const double* z, Index slots) {
  constexpr Index per_mode = slots_per_mode(layout);
  using LastV = std::conditional_t<layout == ModeLayout::singles, double, Pair>;
  const auto term = [&](Index slot) __attribute__((always_inline)) {
    const V x = load<V>(z + slot);
    return M == nullptr ? x * x : times<layout, V>(M, slot, x) * x;
  };
  V lanes{}, others{};  // sums that do not wait for one another
  LastV last{};
  Index slot = 0;
  for (; slot + 2 * lane_count <= slots; slot += 2 * lane_count) {
    lanes += term(slot);
    others += term(slot + lane_count);
  }
  for (; slot + lane_count <= slots; slot += lane_count) lanes += term(slot);
  lanes += others;
  for (; slot < slots; slot += per_mode) {
    const LastV x = load<LastV>(z + slot);
    last += M == nullptr ? x * x : times<layout, LastV>(M, slot, x) * x;
  }
  return sum(lanes) + sum(last);
}

template <ModeLayout layout, class V>
[[gnu::always_inline]] inline void multiply_modes_of(const double* M, const double* z, Index slots, double* out) {
  for_slots<layout, V>(
      slots, [=]<class X>(Index slot, const X&) __attribute__((always_inline)) {
        store<X>(out + slot, times<layout, X>(M, slot, load<X>(z + slot)));
      });
}

}  // namespace

bool has_fused_propagator(const ModalExtent& extent, unsigned unit) { return find(extent, unit) != nullptr; }

std::unique_ptr<Propagator> fused_propagator(const Space& space, const ModalExtent& extent, const ModalMetric& metric,
                                             ModalForceMaps maps) {
  return find(extent, metric.unit)(space, extent, metric, std::move(maps));
}

double weighted_square(ModeLayout layout, const double* M, const double* z, Index slots) {
  return with_lanes([=]<class V>() __attribute__((always_inline)) {
    return layout == ModeLayout::singles ? weighted_square_of<ModeLayout::singles, V>(M, z, slots)
                                         : weighted_square_of<ModeLayout::real_pairs, V>(M, z, slots);
  });
}

void multiply_modes(ModeLayout layout, const double* M, const double* z, Index slots, double* out) {
  with_lanes([=]<class V>() __attribute__((always_inline)) {
    if (layout == ModeLayout::singles)
      multiply_modes_of<ModeLayout::singles, V>(M, z, slots, out);
    else
      multiply_modes_of<ModeLayout::real_pairs, V>(M, z, slots, out);
  });
}

}  // namespace seiche
