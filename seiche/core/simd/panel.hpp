// Many states of one small problem side by side: row j of a panel holds component j of sixteen of them.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/core/simd/multiversion.hpp>

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>

namespace seiche {

// Sixteen: two AVX-512 registers, and the panels of a step on twenty points still fit into the first cache.
inline constexpr Index panel_members = 16;
inline constexpr std::size_t panel_alignment = 64;

// One number for each member.
struct alignas(panel_alignment) PanelValues : std::array<double, panel_members> {};

class Panel {
 public:
  Panel() = default;
  explicit Panel(Index rows) : rows_(rows), values_(new (std::align_val_t{panel_alignment}) double[size()]()) {}
  Index rows() const { return rows_; }
  double* row(Index j) { return values_.get() + j * panel_members; }
  const double* row(Index j) const { return values_.get() + j * panel_members; }
  double& operator()(Index j, Index member) { return row(j)[member]; }
  double operator()(Index j, Index member) const { return row(j)[member]; }

 private:
  struct Free {
    void operator()(double* p) const { ::operator delete[](p, std::align_val_t{panel_alignment}); }
  };
  std::size_t size() const { return static_cast<std::size_t>(rows_ * panel_members); }
  Index rows_ = 0;
  std::unique_ptr<double[], Free> values_;
};

}  // namespace seiche
