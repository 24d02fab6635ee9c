#include <seiche/backend/mode_kernels.hpp>
#include <seiche/backend/mode_table.hpp>
#include <seiche/core/error.hpp>
#include <seiche/core/parallel.hpp>

#include <algorithm>
#include <array>
#include <cstring>

namespace seiche {
namespace {

using mode_kernels::times;

constexpr Index chunks_per_block = 1024;  // of one thread's share; part of what fixes the order of sums
constexpr Index max_columns = 40;         // the inputs of eight slots wait in the first-level cache

using Inputs = std::array<Lanes, max_columns>;

// Eight slots, or what is left of them at the end of a field, filled up with zeros.
[[gnu::always_inline]] inline void load_inputs(std::span<const double* const> in, Index chunk, Index slots, Inputs& x) {
  const Index begin = chunk * lane_count;
  if (begin + lane_count <= slots) {
    for (std::size_t j = 0; j < in.size(); ++j) x[j] = load<Lanes>(in[j] + begin);
    return;
  }
  for (std::size_t j = 0; j < in.size(); ++j) {
    x[j] = Lanes{};
    std::memcpy(&x[j], in[j] + begin, static_cast<std::size_t>(slots - begin) * sizeof(double));
  }
}

template <ModeLayout layout>
SEICHE_MULTIVERSION void sum_rows(const ModeFactors& factors, std::span<const double* const> in,
                                  std::span<double* const> out, Index first, Index last) {
  const Index stride = factors.stride();
  const Index slots = factors.slots();
  const double* factor = factors.of_chunk(first);
  Inputs x;
  for (Index chunk = first; chunk < last; ++chunk) {
    const Index begin = chunk * lane_count;
    load_inputs(in, chunk, slots, x);
    for (double* row : out) {
      Lanes sum{};
      for (std::size_t j = 0; j < in.size(); ++j, factor += stride) sum += times<layout, Lanes>(factor, 0, x[j]);
      if (begin + lane_count <= slots)
        store<Lanes>(row + begin, sum);
      else
        std::memcpy(row + begin, &sum, static_cast<std::size_t>(slots - begin) * sizeof(double));
    }
  }
}

template <ModeLayout layout>
SEICHE_MULTIVERSION void sum_forms(const ModeFactors& factors, std::span<const double* const> in, Index first,
                                   Index last, std::span<double> values) {
  const Index stride = factors.stride();
  const auto triangle = static_cast<Index>(in.size() * (in.size() + 1) / 2);
  Inputs x;
  for (std::size_t l = 0; l < values.size(); ++l) {
    Lanes total{};
    for (Index chunk = first; chunk < last; ++chunk) {
      load_inputs(in, chunk, factors.slots(), x);
      const double* factor = factors.of_chunk(chunk) + static_cast<Index>(l) * triangle * stride;
      for (std::size_t i = 0; i < in.size(); ++i) {
        Lanes row{};
        for (std::size_t j = i; j < in.size(); ++j, factor += stride) row += times<layout, Lanes>(factor, 0, x[j]);
        total += x[i] * row;
      }
    }
    values[l] = sum(total);
  }
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

// body(layout, block, first chunk, last chunk)
template <class Body>
void over_blocks(const ModeFactors& factors, int threads, const Body& body) {
  for_blocks(blocks_of(factors), threads, [&](Index block) {
    const Index first = block * chunks_per_block;
    const Index last = std::min(factors.chunks(), first + chunks_per_block);
    with_layout(factors.layout(), [&]<ModeLayout layout>() { body.template operator()<layout>(block, first, last); });
  });
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
  factors_.resize(static_cast<std::size_t>(chunks() * per_mode * stride()));
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
    : columns_(checked_columns(columns)), factors_(layout, modes, rows * columns) {}

void ModeTable::apply(std::span<const double* const> in, std::span<double* const> out, int threads) const {
  over_blocks(factors_, threads, [&]<ModeLayout layout>(Index, Index first, Index last) {
    sum_rows<layout>(factors_, in, out, first, last);
  });
}

ModeForms::ModeForms(ModeLayout layout, Index modes, Index forms, Index columns)
    : columns_(checked_columns(columns)), forms_(forms), factors_(layout, modes, forms * columns * (columns + 1) / 2) {
  sums_.resize(static_cast<std::size_t>(blocks_of(factors_) * forms));
}

void ModeForms::set(Index mode, Index form, Index i, Index j, std::complex<double> factor) {
  const Index entry = form * columns_ * (columns_ + 1) / 2 + i * columns_ - i * (i - 1) / 2 + (j - i);
  factors_.set(mode, entry, i == j ? factor : 2.0 * factor);  // once for both sides
}

void ModeForms::apply(std::span<const double* const> in, std::span<double> values, int threads) const {
  const auto forms = static_cast<std::size_t>(forms_);
  over_blocks(factors_, threads, [&]<ModeLayout layout>(Index block, Index first, Index last) {
    sum_forms<layout>(factors_, in, first, last, {sums_.data() + static_cast<std::size_t>(block) * forms, forms});
  });
  std::fill(values.begin(), values.end(), 0.0);
  for (std::size_t i = 0; i < sums_.size(); ++i) values[i % forms] += sums_[i];
}

}  // namespace seiche
