#include <seiche/backend/fft/crossing.hpp>
#include <seiche/core/simd/parallel.hpp>

#include <algorithm>
#include <numeric>
#include <span>

namespace seiche {
namespace {

std::size_t sum_of(const std::vector<Index>& counts) {
  return static_cast<std::size_t>(std::accumulate(counts.begin(), counts.end(), Index{0}));
}

}  // namespace

Crossing::Crossing(const Ranks& ranks, const Grid& grid, const Modes& modes, Index size_of_rows, int threads)
    : ranks_(ranks),
      threads_(threads),
      here_(static_cast<std::size_t>(grid.here.index)),
      first_plane_(grid.slab().first),
      planes_(grid.slab().planes) {
  const Index middle = modes.plane() / grid.axis(0).unknowns();  // numbers of one k along axis 1 in a plane of rows
  length_ = grid.axis(0).unknowns();
  column_ = modes.units().planes * middle;
  for (int rank = 0; rank < grid.here.count; ++rank) {
    const Slab theirs = modes.slab_of_rank(rank);
    first_.push_back(theirs.first * middle);
    piece_.push_back(theirs.planes * middle);
    of_rows_.push_back(planes_ * piece_.back());
    of_columns_.push_back(slab_of({length_}, {rank, grid.here.count}).planes * column_);
  }
  row_ = planes_ > 0 ? size_of_rows / planes_ : 0;
  packed_ = fftw_buffer(static_cast<std::size_t>(size_of_rows));
  constexpr Index gap = 16, power_of_two = 128;
  stride_ = column_ + (column_ > 0 && column_ % power_of_two == 0 ? gap : 0);
  columns_ = fftw_buffer(static_cast<std::size_t>(length_ * stride_));
  if (stride_ != column_) dense_ = fftw_buffer(sum_of(of_columns_));
}

template <class Visit>
void Crossing::for_pieces(const Visit& visit) const {
  for_blocks(planes_, threads_, [&](Index plane) {
    Index at = 0;  // of what goes to each process
    for (std::size_t rank = 0; rank < piece_.size(); ++rank) {
      double* const to =
          rank == here_ ? columns_.get() + (first_plane_ + plane) * stride_ : packed_.get() + at + plane * piece_[rank];
      visit(to, plane * row_ + first_[rank], piece_[rank]);
      at += planes_ * piece_[rank];
    }
  });
}

template <class Copy>
void Crossing::for_columns(const Copy& copy) const {
  if (stride_ == column_) return;
  for_blocks(length_, threads_, [&](Index plane) {
    if (plane < first_plane_ || plane >= first_plane_ + planes_)
      copy(columns_.get() + plane * stride_, dense_.get() + plane * column_);
  });
}

double* Crossing::to_modes(const double* rows) const {
  for_pieces([&](double* packed, Index in_rows, Index count) { std::copy_n(rows + in_rows, count, packed); });
  ranks_.exchange({packed_.get(), sum_of(of_rows_)}, of_rows_, {received(), sum_of(of_columns_)}, of_columns_);
  for_columns([this](double* column, double* dense) { std::copy_n(dense, column_, column); });
  return columns_.get();
}

void Crossing::to_values(double* rows) const {
  for_columns([this](double* column, double* dense) { std::copy_n(column, column_, dense); });
  ranks_.exchange({received(), sum_of(of_columns_)}, of_columns_, {packed_.get(), sum_of(of_rows_)}, of_rows_);
  for_pieces([&](const double* packed, Index in_rows, Index count) { std::copy_n(packed, count, rows + in_rows); });
}

}  // namespace seiche
