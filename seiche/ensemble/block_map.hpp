// A linear map on panels, as the small dense blocks that its matrix falls into.
#pragma once

#include <seiche/core/simd/panel.hpp>

#include <Eigen/Dense>

#include <span>
#include <vector>

namespace seiche {

// Rows and columns that are connected by entries ≠ 0 form a block. In modal coordinates a block is a mode, and a dense
// matrix is one block: both cost what their entries cost.
class BlockMap {
 public:
  BlockMap() = default;
  // One matrix for all members, or one for each of them; all of one shape.
  explicit BlockMap(std::span<const Eigen::MatrixXd> matrices);
  explicit BlockMap(const Eigen::MatrixXd& matrix) : BlockMap(std::span(&matrix, 1)) {}

  Index rows() const { return rows_; }
  // Pointers to the first row of panels; `out` must not overlap `in`.
  void apply(const double* in, double* out) const;                       // out = A in
  void add_to(const double* base, const double* in, double* out) const;  // out = base + A in; base may be in
  // out = factor (base + A in) with a factor for every row and member; `lost` is NaN in members where that is no finite
  // number.
  void finish(const double* base, const double* in, const double* const* factors, double* out, PanelValues& lost) const;
  void dot(const double* left, const double* in, PanelValues& sum) const;  // leftᵀ A in, for each member

 private:
  struct Block {
    int rows, columns;
    std::size_t row, column;  // where its indices begin in indices_
    std::size_t entry;        // where its entries begin in entries_, row by row
  };
  template <class Sink>
  void visit(const double* in, Sink& sink) const;
  template <int columns, bool shared, class Sink>
  void visit_small(const Block& block, const double* in, Sink& sink) const;
  template <bool shared, class Sink>
  void visit_large(const Block& block, const double* in, Sink& sink) const;
  template <bool shared, class Sink>
  void visit_blocks(const double* in, Sink& sink) const;

  Index rows_ = 0;
  bool shared_ = true;  // one number per entry; else one for each member
  std::vector<Block> blocks_;
  std::vector<std::size_t> indices_;  // of rows and columns
  Panel panel_entries_;               // one row per entry, unless shared
  std::vector<double> entries_;       // if shared
};

// The blocks of a matrix: rows and columns connected by entries ≠ 0 in any of the matrices. A row without entries is a
// block with no columns.
struct Connected {
  std::vector<Index> rows, columns;
};
std::vector<Connected> connected_blocks(std::span<const Eigen::MatrixXd> matrices);

}  // namespace seiche
