#include <seiche/backend/modal/lane_phi.hpp>
#include <seiche/backend/modal/mode_phi.hpp>
#include <seiche/core/simd/multiversion.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace seiche {
namespace {

using Arrays = ModeBlockArrays;

template <class Scalar, int m>
[[gnu::always_inline]] inline ModeBlock<Scalar, m> load_block(const Arrays& blocks, Arrays::Which which, Index first) {
  ModeBlock<Scalar, m> block;
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < m; ++j) {
      if constexpr (std::is_same_v<Scalar, Lanes>)
        block(i, j) = load<Lanes>(blocks.at(which, i, j, 0) + first);
      else
        block(i, j) = {load<Lanes>(blocks.at(which, i, j, 0) + first), load<Lanes>(blocks.at(which, i, j, 1) + first)};
    }
  }
  return block;
}

[[gnu::always_inline]] inline const Lanes& real_part(const Lanes& x) { return x; }
[[gnu::always_inline]] inline const Lanes& real_part(const ComplexLanes& x) { return x.re; }
[[gnu::always_inline]] inline Lanes imaginary_part(const Lanes&) { return Lanes{}; }
[[gnu::always_inline]] inline const Lanes& imaginary_part(const ComplexLanes& x) { return x.im; }

constexpr Index max_blocks = 20;  // z and the forces
constexpr std::size_t max_lane_columns = 40;

// Compiled once for all that asks for it, unlike what is inlined.
template <class Block>
SEICHE_MULTIVERSION void phi_of(const Block& A, const Lanes& size, int order, Block* phi) {
  lane_phi_functions(A, size, order, phi);
}

// The blocks of one row for eight modes: of z, then of each force.
template <class Scalar, int m>
struct RowOfBlocks {
  using Block = ModeBlock<Scalar, m>;
  Block L, S;
  Lanes size;
  std::array<Block, max_blocks> blocks;
  std::array<Block, max_lane_phi_order + 1> phi;

  [[gnu::always_inline]] inline RowOfBlocks(const Arrays& arrays, double h, Index first)
      : L(all_lanes(h) * load_block<Scalar, m>(arrays, Arrays::L, first)),
        S(load_block<Scalar, m>(arrays, Arrays::S, first)),
        size(h * load<Lanes>(arrays.sizes() + first)) {}

  [[gnu::always_inline]] inline void compute(const PhiRows& rows, const PhiRow& row, double h) {
    const int order = static_cast<int>(rows.order);
    phi_of(all_lanes(row.theta) * L, row.theta * size, order, phi.data());
    blocks[0] = phi[0];
    const Block* times = rows.kind == PhiRows::Forces::gradients ? &S : nullptr;
    for (Index j = 0; j < rows.forces; ++j)
      lane_force_block(phi.data(), row.weights.data() + j * order, order, h, times, blocks[j + 1]);
  }
};

template <class Scalar, int m>
SEICHE_MULTIVERSION void fill_sums_of(const Arrays& arrays, const PhiRows& rows, double h,
                                      std::span<const PhiColumn> columns, Index first_field, Index count,
                                      ModeTable& table) {
  for (Index first = 0; first < arrays.padded_modes(); first += lane_count) {
    RowOfBlocks<Scalar, m> row(arrays, h, first);
    for (std::size_t i = 0; i < rows.rows.size(); ++i) {
      row.compute(rows, rows.rows[i], h);
      for (Index f = 0; f < count; ++f) {
        for (std::size_t j = 0; j < columns.size(); ++j) {
          const Scalar& x =
              row.blocks[columns[j].block](static_cast<int>(first_field + f), static_cast<int>(columns[j].field));
          table.set_eight(first, static_cast<Index>(i) * count + f, static_cast<Index>(j), real_part(x),
                          imaginary_part(x));
        }
      }
    }
  }
}

// Of eight modes: what a flow ẋ = Lx + Σn_j makes of z, block 0, and of each n_j, block 1.
template <class Scalar, int m>
struct FlowBlocks {
  using Block = ModeBlock<Scalar, m>;
  Block M;
  std::array<Block, 2> start{}, force{}, end, integral;  // x(0), n, x(h), ∫₀ʰ x dt

  [[gnu::always_inline]] inline FlowBlocks(const Arrays& arrays, const PhiRows& rows, double h, Index first,
                                           RowOfBlocks<Scalar, m>& row)
      : M(load_block<Scalar, m>(arrays, Arrays::M, first)) {
    phi_of(row.L, row.size, 2, row.phi.data());
    start[0].add_to_diagonal(all_lanes(1.0));
    end[0] = row.phi[0];
    integral[0] = all_lanes(h) * row.phi[1];
    const bool gradients = rows.kind == PhiRows::Forces::gradients;
    if (gradients)
      force[1] = row.S;
    else
      force[1].add_to_diagonal(all_lanes(1.0));
    end[1] = all_lanes(h) * row.phi[1] * force[1];
    integral[1] = all_lanes(h * h) * row.phi[2] * force[1];
  }

  // The factor of columns a and b in ∫₀ʰ Q dt = ½zᴴMz − ½x(h)ᴴMx(h) + Re nᴴM∫x.
  [[gnu::always_inline]] inline Scalar dissipated(const PhiColumn& a, const PhiColumn& b) const {
    const int i = a.block > 0, j = b.block > 0;
    const int p = static_cast<int>(a.field), q = static_cast<int>(b.field);
    const Scalar twice = product(start[i], p, start[j], q) - product(end[i], p, end[j], q) +
                         product(force[i], p, integral[j], q) + product(integral[i], p, force[j], q);
    return all_lanes(0.5) * twice;
  }

 private:
  [[gnu::always_inline]] inline Scalar product(const Block& x, int p, const Block& y, int q) const {
    Scalar sum{};
    for (int k = 0; k < m; ++k)
      for (int f = 0; f < m; ++f) sum = sum + conjugate(x(f, p)) * M(f, k) * y(k, q);
    return sum;
  }
};

// Σ_i c_i B_iᴴ Q B_i, with B_i the columns of the blocks of row i.
template <class Scalar, int m>
SEICHE_MULTIVERSION void fill_forms_of(const Arrays& arrays, std::span<const PhiEvaluator::Form> forms, double h,
                                       std::span<const PhiColumn> columns, ModeForms& table) {
  std::array<Scalar, max_lane_columns*(max_lane_columns + 1) / 2> gram{};
  for (Index first = 0; first < arrays.padded_modes(); first += lane_count) {
    RowOfBlocks<Scalar, m> row(arrays, h, first);
    const ModeBlock<Scalar, m> Q = load_block<Scalar, m>(arrays, Arrays::Q, first);
    for (std::size_t l = 0; l < forms.size(); ++l) {
      const PhiRows& rows = forms[l].rows;
      const std::size_t triangle = columns.size() * (columns.size() + 1) / 2;
      for (std::size_t e = 0; e < triangle; ++e) gram[e] = Scalar{};
      for (std::size_t i = 0; i < rows.rows.size(); ++i) {
        row.compute(rows, rows.rows[i], h);
        const Lanes weight = all_lanes(forms[l].coefficients[i]);
        std::size_t e = 0;
        for (std::size_t a = 0; a < columns.size(); ++a) {
          // c bᴴ Q of column a
          const ModeBlock<Scalar, m>& of_a = row.blocks[columns[a].block];
          std::array<Scalar, m> left{};
          for (int k = 0; k < m; ++k) {
            for (int f = 0; f < m; ++f)
              left[k] = left[k] + conjugate(of_a(f, static_cast<int>(columns[a].field))) * Q(f, k);
            left[k] = weight * left[k];
          }
          for (std::size_t b = a; b < columns.size(); ++b, ++e) {
            const ModeBlock<Scalar, m>& of_b = row.blocks[columns[b].block];
            for (int k = 0; k < m; ++k) gram[e] = gram[e] + left[k] * of_b(k, static_cast<int>(columns[b].field));
          }
        }
      }
      if (forms[l].minus_integral) {
        const FlowBlocks<Scalar, m> flow(arrays, rows, h, first, row);
        std::size_t e = 0;
        for (std::size_t a = 0; a < columns.size(); ++a)
          for (std::size_t b = a; b < columns.size(); ++b, ++e)
            gram[e] = gram[e] - flow.dissipated(columns[a], columns[b]);
      }
      std::size_t e = 0;
      for (std::size_t a = 0; a < columns.size(); ++a)
        for (std::size_t b = a; b < columns.size(); ++b, ++e)
          table.set_eight(first, static_cast<Index>(l), static_cast<Index>(a), static_cast<Index>(b),
                          real_part(gram[e]), imaginary_part(gram[e]));
    }
  }
}

}  // namespace

ModeBlockArrays::ModeBlockArrays(Index modes, Index fields, bool are_real)
    : fields_(fields), parts_(are_real ? 1 : 2), padded_(whole_lanes(modes)) {
  entries_.resize(static_cast<std::size_t>(4 * fields * fields * parts_ * padded_));
  sizes_.resize(static_cast<std::size_t>(padded_));
}

void ModeBlockArrays::set(Index mode, Which which, Index i, Index j, std::complex<double> value) {
  double* entry = entries_.data() + ((which * fields_ + i) * fields_ + j) * parts_ * padded_ + mode;
  entry[0] = value.real();
  if (parts_ == 2) entry[padded_] = value.imag();
}

bool fits_lanes(const ModeBlockArrays& blocks, const PhiRows& rows, double h) {
  constexpr double largest = 128;
  if (blocks.fields() == 2 && !blocks.are_real() && std::abs(h) * blocks.largest_size() > largest) return false;
  return blocks.fields() <= 2 && rows.order <= max_lane_phi_order && rows.forces < max_blocks;
}

void fill_sums(const ModeBlockArrays& blocks, const PhiRows& rows, double h, std::span<const PhiColumn> columns,
               Index first, Index count, ModeTable& table) {
  const bool one = blocks.fields() == 1;
  if (blocks.are_real())
    (one ? fill_sums_of<Lanes, 1> : fill_sums_of<Lanes, 2>)(blocks, rows, h, columns, first, count, table);
  else
    (one ? fill_sums_of<ComplexLanes, 1> : fill_sums_of<ComplexLanes, 2>)(blocks, rows, h, columns, first, count,
                                                                          table);
}

void fill_forms(const ModeBlockArrays& blocks, std::span<const PhiEvaluator::Form> forms, double h,
                std::span<const PhiColumn> columns, ModeForms& table) {
  const bool one = blocks.fields() == 1;
  if (blocks.are_real())
    (one ? fill_forms_of<Lanes, 1> : fill_forms_of<Lanes, 2>)(blocks, forms, h, columns, table);
  else
    (one ? fill_forms_of<ComplexLanes, 1> : fill_forms_of<ComplexLanes, 2>)(blocks, forms, h, columns, table);
}

}  // namespace seiche
