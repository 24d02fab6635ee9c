// α(1 − cos u) over the rows of panels, with an α for each member.
#pragma once

#include <seiche/potential/cosine.hpp>
#include <seiche/potential/panel_loops.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace seiche {

// By blocks of rows with α = 1, whose numbers are then multiplied by the α of their members.
struct CosineRows {
  static constexpr Index rows_of_block = 32;
  static constexpr std::size_t in_block = rows_of_block * panel_members;
  using Block = std::array<double, in_block>;
  using Scratch = std::array<double, 2 * in_block>;

  // visit(first number, how many) for each block.
  template <class Visit>
  [[gnu::always_inline]] static void for_blocks(Index rows, const Visit& visit) {
    for (Index row = 0; row < rows; row += rows_of_block)
      visit(row * panel_members, static_cast<std::size_t>(std::min(rows_of_block, rows - row) * panel_members));
  }
  [[gnu::always_inline]] static void scale(const double* alpha, double* numbers, std::size_t n) {
    for (std::size_t i = 0; i < n; i += panel_members)
      for (std::size_t l = 0; l < panel_members; ++l) numbers[i + l] *= alpha[l];
  }
  [[gnu::always_inline]] static void add(const double* numbers, std::size_t n, double* sums) {
    for (std::size_t i = 0; i < n; i += panel_members)
      for (std::size_t l = 0; l < panel_members; ++l) sums[l] += numbers[i + l];
  }

  SEICHE_MULTIVERSION static void values_and_slopes(const double* alpha, const double* u, double* slopes, Index rows,
                                                    double* values) {
    Block w;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
    for_blocks(
        rows, [&](Index at, std::size_t n) __attribute__((always_inline)) {
          Cosine{}.values_and_slopes(u + at, w.data(), slopes + at, n);
          scale(alpha, slopes + at, n);
          add(w.data(), n, values);
        });
    for (std::size_t l = 0; l < panel_members; ++l) values[l] *= alpha[l];
  }
  SEICHE_MULTIVERSION static void values_and_sizes(const double* u, Index rows, double* values, double* sizes) {
    Block w, size;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before they are read
    for_blocks(
        rows, [&](Index at, std::size_t n) __attribute__((always_inline)) {
          Cosine{}.values_and_sizes(u + at, w.data(), size.data(), n);
          add(w.data(), n, values);
          add(size.data(), n, sizes);
        });
  }
  SEICHE_MULTIVERSION static void mean_slopes(const double* alpha, const double* a, const double* b, double* mean,
                                              Index rows) {
    Scratch scratch;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before it is read
    for_blocks(
        rows, [&](Index at, std::size_t n) __attribute__((always_inline)) {
          Cosine{}.mean_slopes(a + at, b + at, mean + at, scratch.data(), n);
          scale(alpha, mean + at, n);
        });
  }
};

template <>
class PanelW<Cosine> {
 public:
  explicit PanelW(const std::vector<Cosine>& w) {
    for (std::size_t l = 0; l < panel_members; ++l) alpha_[l] = w[l].alpha;
  }

  void slopes(const double* u, double* slopes, Index rows) const {
    PanelValues unused{};
    CosineRows::values_and_slopes(alpha_.data(), u, slopes, rows, unused.data());
  }
  void values_and_slopes(const double* u, double* slopes, Index rows, PanelValues& values) const {
    values.fill(0);
    CosineRows::values_and_slopes(alpha_.data(), u, slopes, rows, values.data());
  }
  void values_and_magnitudes(const double* u, Index rows, PanelValues& values, PanelValues& magnitudes) const {
    values.fill(0);
    magnitudes.fill(0);
    CosineRows::values_and_sizes(u, rows, values.data(), magnitudes.data());
    for (std::size_t l = 0; l < panel_members; ++l) {
      values[l] *= alpha_[l];
      magnitudes[l] *= std::abs(alpha_[l]);
    }
  }
  void mean_slopes(const double* a, const double* b, double* mean, Index rows) const {
    CosineRows::mean_slopes(alpha_.data(), a, b, mean, rows);
  }

 private:
  PanelValues alpha_{};
};

}  // namespace seiche
