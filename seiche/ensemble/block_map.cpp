#include <seiche/ensemble/block_map.hpp>
#include <seiche/ensemble/pack.hpp>

#include <algorithm>
#include <numeric>

namespace seiche {

std::vector<Connected> connected_blocks(std::span<const Eigen::MatrixXd> matrices) {
  const Index rows = matrices.front().rows();
  const Index columns = matrices.front().cols();
  std::vector<Index> parent(static_cast<std::size_t>(rows + columns));  // rows, then columns
  std::iota(parent.begin(), parent.end(), Index{0});
  const auto root = [&](Index i) {
    while (parent[static_cast<std::size_t>(i)] != i) i = parent[static_cast<std::size_t>(i)];
    return i;
  };
  for (const Eigen::MatrixXd& a : matrices)
    for (Index i = 0; i < rows; ++i)
      for (Index j = 0; j < columns; ++j)
        if (a(i, j) != 0) parent[static_cast<std::size_t>(root(rows + j))] = root(i);

  std::vector<Connected> blocks;
  std::vector<Index> block_of(parent.size(), -1);
  for (Index i = 0; i < rows; ++i) {
    Index& block = block_of[static_cast<std::size_t>(root(i))];
    if (block < 0) {
      block = static_cast<Index>(blocks.size());
      blocks.emplace_back();
    }
    blocks[static_cast<std::size_t>(block)].rows.push_back(i);
  }
  for (Index j = 0; j < columns; ++j) {
    const Index block = block_of[static_cast<std::size_t>(root(rows + j))];
    if (block >= 0) blocks[static_cast<std::size_t>(block)].columns.push_back(j);  // else a column of zeros
  }
  return blocks;
}

BlockMap::BlockMap(std::span<const Eigen::MatrixXd> matrices)
    : rows_(matrices.front().rows()), shared_(matrices.size() == 1) {
  std::vector<std::pair<Index, Index>> places;  // of the entries
  for (const Connected& c : connected_blocks(matrices)) {
    Block block{.rows = static_cast<int>(c.rows.size()),
                .columns = static_cast<int>(c.columns.size()),
                .row = indices_.size(),
                .column = indices_.size() + c.rows.size(),
                .entry = places.size()};
    indices_.insert(indices_.end(), c.rows.begin(), c.rows.end());
    indices_.insert(indices_.end(), c.columns.begin(), c.columns.end());
    for (const Index i : c.rows)
      for (const Index j : c.columns) places.emplace_back(i, j);
    blocks_.push_back(block);
  }
  std::stable_sort(blocks_.begin(), blocks_.end(),
                   [](const Block& a, const Block& b) { return a.columns < b.columns; });
  for (std::size_t& index : indices_) index *= static_cast<std::size_t>(panel_members);
  if (shared_) {
    for (const auto& [i, j] : places) entries_.push_back(matrices.front()(i, j));
    return;
  }
  panel_entries_ = Panel(static_cast<Index>(places.size()));
  for (std::size_t e = 0; e < places.size(); ++e)
    for (Index l = 0; l < panel_members; ++l)
      panel_entries_(static_cast<Index>(e), l) =
          matrices[static_cast<std::size_t>(l)](places[e].first, places[e].second);
}

namespace {

// What becomes of row `at` (an offset into panels) of A in.
struct Store {
  double* out;
  [[gnu::always_inline]] void operator()(std::size_t at, const Pack (&row)[packs]) const {
    Pack* to = packs_of(out + at);
#pragma GCC unroll 8
    for (int q = 0; q < packs; ++q) to[q] = row[q];
  }
};

struct StoreSum {
  const double* base;
  double* out;
  [[gnu::always_inline]] void operator()(std::size_t at, const Pack (&row)[packs]) const {
    const Pack* from = packs_of(base + at);
    Pack* to = packs_of(out + at);
#pragma GCC unroll 8
    for (int q = 0; q < packs; ++q) to[q] = from[q] + row[q];
  }
};

struct StoreDamped {
  const double* base;
  const double* const* factors;
  double* out;
  Pack lost[packs];
  [[gnu::always_inline]] void operator()(std::size_t at, const Pack (&row)[packs]) {
    const Pack* from = packs_of(base + at);
    const Pack* factor = packs_of(factors[at / static_cast<std::size_t>(panel_members)]);
    Pack* to = packs_of(out + at);
#pragma GCC unroll 8
    for (int q = 0; q < packs; ++q) {
      const Pack z = factor[q] * (from[q] + row[q]);
      to[q] = z;
      lost[q] += 0.0 * z;
    }
  }
};

struct Dot {
  const double* left;
  Pack sum[packs];
  [[gnu::always_inline]] void operator()(std::size_t at, const Pack (&row)[packs]) {
    const Pack* with = packs_of(left + at);
#pragma GCC unroll 8
    for (int q = 0; q < packs; ++q) sum[q] += with[q] * row[q];
  }
};

// An entry times a row: the same number for every member, or one for each.
template <bool shared>
[[gnu::always_inline]] inline void add_product(const double* entry, const Pack* x, Pack (&sum)[packs]) {
  if constexpr (shared) {
#pragma GCC unroll 8
    for (int q = 0; q < packs; ++q) sum[q] += *entry * x[q];
  } else {
    const Pack* c = packs_of(entry);
#pragma GCC unroll 8
    for (int q = 0; q < packs; ++q) sum[q] += c[q] * x[q];
  }
}

constexpr std::size_t stride(bool shared) { return shared ? 1 : static_cast<std::size_t>(panel_members); }

}  // namespace

// The columns of a small block stay in registers.
template <int columns, bool shared, class Sink>
[[gnu::always_inline]] inline void BlockMap::visit_small(const Block& block, const double* in, Sink& sink) const {
  const std::size_t* column = indices_.data() + block.column;
  Pack x[std::max(columns, 1)][packs];
#pragma GCC unroll 8
  for (int j = 0; j < columns; ++j) {
    const Pack* from = packs_of(in + column[j]);
#pragma GCC unroll 8
    for (int q = 0; q < packs; ++q) x[j][q] = from[q];
  }
  const double* entry = (shared ? entries_.data() : panel_entries_.row(0)) + block.entry * stride(shared);
  const std::size_t* row = indices_.data() + block.row;
  for (int i = 0; i < block.rows; ++i) {
    Pack sum[packs] = {};
#pragma GCC unroll 8
    for (int j = 0; j < columns; ++j) {
      add_product<shared>(entry, x[j], sum);
      entry += stride(shared);
    }
    sink(row[i], sum);
  }
}

template <bool shared, class Sink>
[[gnu::always_inline]] inline void BlockMap::visit_large(const Block& block, const double* in, Sink& sink) const {
  const std::size_t* column = indices_.data() + block.column;
  const std::size_t* row = indices_.data() + block.row;
  const double* entry = (shared ? entries_.data() : panel_entries_.row(0)) + block.entry * stride(shared);
  const std::size_t next_row = static_cast<std::size_t>(block.columns) * stride(shared);
  int i = 0;
  for (; i + 2 <= block.rows; i += 2, entry += 2 * next_row) {  // each column is read once for two rows
    Pack first[packs] = {};
    Pack second[packs] = {};
    for (int j = 0; j < block.columns; ++j) {
      const Pack* x = packs_of(in + column[j]);
      const double* c = entry + static_cast<std::size_t>(j) * stride(shared);
      add_product<shared>(c, x, first);
      add_product<shared>(c + next_row, x, second);
    }
    sink(row[i], first);
    sink(row[i + 1], second);
  }
  if (i < block.rows) {
    Pack sum[packs] = {};
    for (int j = 0; j < block.columns; ++j)
      add_product<shared>(entry + static_cast<std::size_t>(j) * stride(shared), packs_of(in + column[j]), sum);
    sink(row[i], sum);
  }
}

// Blocks are sorted by their number of columns.
template <bool shared, class Sink>
[[gnu::always_inline]] inline void BlockMap::visit_blocks(const double* in, Sink& sink) const {
  const Block* block = blocks_.data();
  const Block* end = block + blocks_.size();
  for (; block != end && block->columns == 0; ++block) visit_small<0, shared>(*block, in, sink);
  for (; block != end && block->columns == 1; ++block) visit_small<1, shared>(*block, in, sink);
  for (; block != end && block->columns == 2; ++block) visit_small<2, shared>(*block, in, sink);
  for (; block != end && block->columns == 3; ++block) visit_small<3, shared>(*block, in, sink);
  for (; block != end && block->columns == 4; ++block) visit_small<4, shared>(*block, in, sink);
  for (; block != end && block->columns == 5; ++block) visit_small<5, shared>(*block, in, sink);
  for (; block != end && block->columns == 6; ++block) visit_small<6, shared>(*block, in, sink);
  for (; block != end; ++block) visit_large<shared>(*block, in, sink);
}

template <class Sink>
[[gnu::always_inline]] inline void BlockMap::visit(const double* in, Sink& sink) const {
  if (shared_) {
    visit_blocks<true>(in, sink);
  } else {
    visit_blocks<false>(in, sink);
  }
}

SEICHE_MULTIVERSION void BlockMap::apply(const double* in, double* out) const {
  Store sink{};
  sink.out = out;
  visit(in, sink);
}

SEICHE_MULTIVERSION void BlockMap::add_to(const double* base, const double* in, double* out) const {
  StoreSum sink{base, nullptr};
  sink.out = out;
  visit(in, sink);
}

SEICHE_MULTIVERSION void BlockMap::finish(const double* base, const double* in, const double* const* factors,
                                          double* out, PanelValues& lost) const {
  StoreDamped sink{base, factors, nullptr, {}};
  sink.out = out;
  visit(in, sink);
  Pack* to = packs_of(lost.data());
#pragma GCC unroll 8
  for (int q = 0; q < packs; ++q) to[q] = sink.lost[q];
}

SEICHE_MULTIVERSION void BlockMap::dot(const double* left, const double* in, PanelValues& sum) const {
  Dot sink{left, {}};
  visit(in, sink);
  Pack* to = packs_of(sum.data());
#pragma GCC unroll 8
  for (int q = 0; q < packs; ++q) to[q] = sink.sum[q];
}

}  // namespace seiche
