#include <seiche/backend/modal/mode_map.hpp>

namespace seiche {

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
  if (entry.real) {
    for (Index i = 0; i < slots_; ++i) y[i] += c[i] * x[i];
    return;
  }
  for (Index i = 0; i < slots_; i += 2) {
    const double re = c[i] * x[i] - c[i + 1] * x[i + 1];
    const double im = c[i] * x[i + 1] + c[i + 1] * x[i];
    y[i] += re;
    y[i + 1] += im;
  }
}

void ModeMap::add(const Vector& in, Vector& out) const {
  for (const Entry& entry : entries_) add_entry(entry, in, out);
}

void ModeMap::apply(const Vector& in, Vector& out) const {
  out.setZero();
  add(in, out);
}

}  // namespace seiche
