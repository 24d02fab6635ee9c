// From planes along axis 0 to planes along axis 1, and back: the one exchange of all processes with all.
#pragma once

#include <seiche/backend/fft/fftw_plan.hpp>
#include <seiche/core/grid/modes.hpp>
#include <seiche/core/grid/ranks.hpp>

#include <vector>

namespace seiche {

// Rows lie as axis 0 here × axis 1 × the rest, columns as axis 0 × axis 1 here × the rest, but that a few numbers are
// left between planes that would lie a high power of two apart: caches hold few lines of such columns at a time.
class Crossing {
 public:
  Crossing(const Ranks& ranks, const Grid& grid, const Modes& modes, Index size_of_rows, int threads);
  double* columns() const { return columns_.get(); }
  Index stride() const { return stride_; }     // numbers from one plane along axis 0 of the columns to the next
  double* to_modes(const double* rows) const;  // the columns, of these rows
  void to_values(double* rows) const;          // the rows, of the columns

 private:
  // visit(where in packed_, at which number of the rows, how many numbers): plane by plane what goes to each other
  // process. What stays here: visit(where in the columns, …).
  template <class Visit>
  void for_pieces(const Visit& visit) const;
  template <class Copy>
  void for_columns(const Copy& copy) const;  // copy(plane with the gap, without) of others, where there are gaps
  double* received() const { return stride_ == column_ ? columns_.get() : dense_.get(); }

  const Ranks& ranks_;
  int threads_;
  std::size_t here_;                         // rank
  Index first_plane_, planes_, row_ = 0;     // along axis 0 here; numbers of one plane of rows
  std::vector<Index> first_, piece_;         // of a plane of rows: where the part of each process begins, and its size
  std::vector<Index> of_rows_, of_columns_;  // what goes to each process, and what comes from it
  Index length_, column_, stride_;           // of the columns: planes, numbers of one, and from one to the next
  FftwBuffer packed_, columns_, dense_;      // dense_: the columns without gaps, where those have some
};

}  // namespace seiche
