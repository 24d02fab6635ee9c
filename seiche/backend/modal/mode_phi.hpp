// φ-functions of one small block per mode, eight modes at a time.
#pragma once

#include <seiche/backend/modal/mode_table.hpp>
#include <seiche/core/phi.hpp>

#include <algorithm>
#include <complex>
#include <span>
#include <vector>

namespace seiche {

// S, L = SM − D₀, Q and M of every mode, entry by entry, filled up with zeros to a multiple of eight modes.
class ModeBlockArrays {
 public:
  ModeBlockArrays(Index modes, Index fields, bool are_real);

  enum Which { S, L, Q, M };
  void set(Index mode, Which which, Index i, Index j, std::complex<double> value);
  // ‖Lᵏ‖^{1/k} for a k or two: what its φ-functions are scaled by.
  void set_size(Index mode, double size) { sizes_[static_cast<std::size_t>(mode)] = size; }

  Index padded_modes() const { return padded_; }
  Index fields() const { return fields_; }
  bool are_real() const { return parts_ == 1; }
  const double* at(Which which, Index i, Index j, Index part) const {
    return entries_.data() + (((which * fields_ + i) * fields_ + j) * parts_ + part) * padded_;
  }
  const double* sizes() const { return sizes_.data(); }
  double largest_size() const { return *std::max_element(sizes_.begin(), sizes_.end()); }

 private:
  Index fields_, parts_, padded_;  // parts: real, or real and imaginary
  std::vector<double> entries_, sizes_;
};

struct PhiColumn {
  Index block;  // 0 for z, 1 for the first force, …
  Index field;
};

// True if the sums can be filled so: blocks of up to 2 × 2, and φ-functions of orders that are in use; complex 2 × 2
// blocks where hL is not large, since the moduli of two eigenvalues are not known from the determinant.
bool fits_lanes(const ModeBlockArrays& blocks, const PhiRows& rows, double h);

// Row i · count + f of the table: component first + f of rows.rows[i].
void fill_sums(const ModeBlockArrays& blocks, const PhiRows& rows, double h, std::span<const PhiColumn> columns,
               Index first, Index count, ModeTable& table);
void fill_forms(const ModeBlockArrays& blocks, std::span<const PhiEvaluator::Form> forms, double h,
                std::span<const PhiColumn> columns, ModeForms& table);

}  // namespace seiche
