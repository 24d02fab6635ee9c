#include <seiche/backend/modal/mode_kernels.hpp>
#include <seiche/backend/modal/mode_map.hpp>

namespace seiche {
namespace {

// y += cx
template <ModeLayout layout, class V>
[[gnu::always_inline]] inline void add_slots(const double* c, const double* x, Index slots, double* y) {
  mode_kernels::for_slots<layout, V>(
      slots, [=]<class X>(Index i, const X&) __attribute__((always_inline)) {
        store<X>(y + i, load<X>(y + i) + mode_kernels::times<layout, X>(c, i, load<X>(x + i)));
      });
}

}  // namespace

ModeMap::ModeMap(const Modes& modes, Index fields, const Block& block) : slots_(modes.slots()) {
  const bool paired = modes.are_pairs();
  std::vector<Eigen::MatrixXcd> blocks;
  blocks.reserve(static_cast<std::size_t>(modes.count()));
  for (Index k = 0; k < modes.count(); ++k) blocks.push_back(block(k));

  for (Index i = 0; i < fields; ++i) {
    for (Index j = 0; j < fields; ++j) {
      bool zero = true;
      bool real = true;
      for (const auto& b : blocks) {
        zero = zero && b(i, j) == 0.0;
        real = real && b(i, j).imag() == 0;
      }
      if (zero) continue;
      Entry entry{i, j, real, Vector(slots_)};
      for (Index k = 0; k < modes.count(); ++k) {
        const std::complex<double> c = blocks[static_cast<std::size_t>(k)](i, j);
        if (paired) {
          entry.factors[2 * k] = c.real();
          entry.factors[2 * k + 1] = real ? c.real() : c.imag();
        } else {
          entry.factors[k] = c.real();
        }
      }
      entries_.push_back(std::move(entry));
    }
  }
}

void ModeMap::add_entry(const Entry& entry, const Vector& in, Vector& out) const {
  const double* c = entry.factors.data();
  const double* x = in.data() + entry.column * slots_;
  double* y = out.data() + entry.row * slots_;
  with_lanes(
      [ c, x, y, slots = slots_, layout = entry.real ? ModeLayout::singles : ModeLayout::complex_pairs ]<class V>()
          __attribute__((always_inline)) {
            if (layout == ModeLayout::singles)
              add_slots<ModeLayout::singles, V>(c, x, slots, y);
            else
              add_slots<ModeLayout::complex_pairs, V>(c, x, slots, y);
          });
}

void ModeMap::add(const Vector& in, Vector& out) const {
  for (const Entry& entry : entries_) add_entry(entry, in, out);
}

void ModeMap::apply(const Vector& in, Vector& out) const {
  out.setZero();
  add(in, out);
}

}  // namespace seiche
