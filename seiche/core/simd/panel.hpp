// Many states of one small problem side by side: row j of a panel holds component j of sixteen of them.
#pragma once

#include <seiche/core/simd/multiversion.hpp>
#include <seiche/core/vector.hpp>

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>

namespace seiche {

// Sixteen: two AVX-512 registers, and the panels of a step on twenty points still fit into the first cache.
inline constexpr Index lanes = 16;
inline constexpr std::size_t panel_alignment = 64;

// One number for each lane.
struct alignas(panel_alignment) LaneValues : std::array<double, lanes> {};

class Panel {
 public:
  Panel() = default;
  explicit Panel(Index rows) : rows_(rows), values_(new (std::align_val_t{panel_alignment}) double[size()]()) {}
  Index rows() const { return rows_; }
  double* row(Index j) { return values_.get() + j * lanes; }
  const double* row(Index j) const { return values_.get() + j * lanes; }
  double& operator()(Index j, Index lane) { return row(j)[lane]; }
  double operator()(Index j, Index lane) const { return row(j)[lane]; }

 private:
  struct Free {
    void operator()(double* p) const { ::operator delete[](p, std::align_val_t{panel_alignment}); }
  };
  std::size_t size() const { return static_cast<std::size_t>(rows_ * lanes); }
  Index rows_ = 0;
  std::unique_ptr<double[], Free> values_;
};

}  // namespace seiche
