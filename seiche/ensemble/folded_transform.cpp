#include <seiche/ensemble/folded_transform.hpp>
#include <seiche/ensemble/pack.hpp>

#include <algorithm>
#include <utility>

namespace seiche {
namespace {

using Matrix = Eigen::MatrixXd;
using Pairs = std::vector<std::pair<Index, Index>>;

constexpr double round_off = 1e-13;  // of entries that are at most 1
constexpr Index sum_cost = 6;        // of a sum and a difference, in products: they pass through memory

// B ← BP⁻¹ for one fold: (a, b) now stand for a + b and a − b.
void fold_columns(Matrix& B, const Pairs& pairs) {
  for (const auto& [a, b] : pairs) {
    const Vector sum = (B.col(a) + B.col(b)) / 2;
    const Vector difference = (B.col(a) - B.col(b)) / 2;
    B.col(a) = (sum.array().abs() < round_off).select(0.0, sum);
    B.col(b) = (difference.array().abs() < round_off).select(0.0, difference);
  }
}

// The products that a matrix costs once it has fallen into blocks.
Index cost(const Matrix& B) {
  Index products = 0;
  for (const Connected& block : connected_blocks({&B, 1}))
    products += static_cast<Index>(block.rows.size() * block.columns.size());
  return products;
}

bool are_equal(const Vector& a, const Vector& b) { return (a - b).lpNorm<Eigen::Infinity>() < round_off; }

// The pairs of columns that are each other's image where the rows with sign −1 are negated; empty if some column has no
// image among the columns.
Pairs mirrored_columns(const Matrix& block, const Vector& signs) {
  Pairs pairs;
  std::vector<bool> taken(static_cast<std::size_t>(block.cols()), false);
  for (Index a = 0; a < block.cols(); ++a) {
    if (taken[static_cast<std::size_t>(a)]) continue;
    const Vector image = signs.cwiseProduct(block.col(a));
    Index b = a;
    while (b < block.cols() && (taken[static_cast<std::size_t>(b)] ||
                                !(are_equal(block.col(b), image) || are_equal(block.col(b), -image)))) {
      ++b;
    }
    if (b == block.cols()) return {};
    taken[static_cast<std::size_t>(b)] = true;
    if (b != a) pairs.emplace_back(a, b);
  }
  return pairs;
}

// The mirror of the columns of one block after which it costs least; empty if none saves what its sums cost. The column
// with the fewest zeros, laid on each other one, says which rows are even and which odd.
Pairs best_fold(const Matrix& block) {
  Index fullest = 0;
  (block.array() != 0).colwise().count().maxCoeff(&fullest);
  Pairs best;
  Index least = cost(block);
  for (Index b = 0; b < block.cols(); ++b) {
    if (b == fullest || !are_equal(block.col(b).cwiseAbs(), block.col(fullest).cwiseAbs())) continue;
    const Vector signs =
        (block.col(b).array() * block.col(fullest).array() < 0).select(Vector::Constant(block.rows(), -1.0), 1.0);
    const Pairs pairs = mirrored_columns(block, signs);
    Matrix folded = block;
    fold_columns(folded, pairs);
    const Index products = cost(folded) + sum_cost * static_cast<Index>(pairs.size());
    if (products < least) {
      least = products;
      best = pairs;
    }
  }
  return best;
}

// A fold for every block that has a mirror.
Pairs find_fold(const Matrix& B) {
  Pairs folds;
  for (const Connected& block : connected_blocks({&B, 1})) {
    const Matrix part = B(block.rows, block.columns);
    for (const auto& [a, b] : best_fold(part))
      folds.emplace_back(block.columns[static_cast<std::size_t>(a)], block.columns[static_cast<std::size_t>(b)]);
  }
  return folds;
}

Index partner(const Pairs& pairs, Index row) {
  for (const auto& [a, b] : pairs)
    if (a == row) return b;
  return -1;
}

// Turns round the pairs of differences of the second fold that do not follow those of their sums: which of two rows
// holds their sum is free, and rows that are folded alike can be folded together.
void align(const Pairs& one, Pairs& two) {
  for (const auto& [a, c] : Pairs(two)) {
    const auto crossed = std::find(two.begin(), two.end(), std::pair(partner(one, c), partner(one, a)));
    if (crossed != two.end()) std::swap(crossed->first, crossed->second);
  }
}

using Mirror = std::array<std::size_t, 2>;
using MirrorPair = std::array<std::size_t, 4>;

[[gnu::always_inline]] inline void butterfly(Pack& a, Pack& b) {
  const Pack difference = a - b;
  a += b;
  b = difference;
}

SEICHE_MULTIVERSION void fold_mirrors(const std::vector<Mirror>& mirrors, double* values) {
  for (const Mirror& mirror : mirrors) {
    Pack* a = packs_of(values + mirror[0]);
    Pack* b = packs_of(values + mirror[1]);
#pragma GCC unroll 8
    for (int q = 0; q < packs; ++q) butterfly(a[q], b[q]);
  }
}

// Two folds of four rows: (a, b) and (c, d), then (a, c) and (b, d).
SEICHE_MULTIVERSION void fold_twice(const std::vector<MirrorPair>& mirrors, double* values) {
  for (const MirrorPair& mirror : mirrors) {
    Pack* at[4];
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) at[i] = packs_of(values + mirror[static_cast<std::size_t>(i)]);
#pragma GCC unroll 8
    for (int q = 0; q < packs; ++q) {
      Pack a = at[0][q], b = at[1][q], c = at[2][q], d = at[3][q];
      butterfly(a, b);
      butterfly(c, d);
      butterfly(a, c);
      butterfly(b, d);
      at[0][q] = a;
      at[1][q] = b;
      at[2][q] = c;
      at[3][q] = d;
    }
  }
}

Mirror offsets(const std::pair<Index, Index>& pair) {
  return {static_cast<std::size_t>(pair.first * panel_members), static_cast<std::size_t>(pair.second * panel_members)};
}

}  // namespace

// Takes out of two folds what can be done in one pass. Order matters in none of them: the rows of a fold are disjoint.
FoldedTransform::TwoFolds::TwoFolds(Pairs one, Pairs two) {
  const auto remove = [](Pairs& from, std::pair<Index, Index> pair) { return std::erase(from, pair) > 0; };
  for (const auto& [a, c] : Pairs(two)) {
    const Index b = partner(one, a);
    const Index d = partner(one, c);
    if (b < 0 || d < 0 || !remove(two, {b, d})) continue;
    remove(two, {a, c});
    remove(one, {a, b});
    remove(one, {c, d});
    const Mirror left = offsets({a, b});
    const Mirror right = offsets({c, d});
    both.push_back({left[0], left[1], right[0], right[1]});
  }
  for (const auto& pair : one) first.push_back(offsets(pair));
  for (const auto& pair : two) second.push_back(offsets(pair));
}

FoldedTransform::FoldedTransform(const Matrix& T) {
  Matrix B = (T.array().abs() < round_off).select(0.0, T);
  for (Pairs one = find_fold(B); !one.empty(); one = find_fold(B)) {
    fold_columns(B, one);
    Pairs two = find_fold(B);
    align(one, two);
    fold_columns(B, two);
    folds_.emplace_back(one, two);
  }
  forward_ = BlockMap(B);
  inverse_ = BlockMap(Matrix(B.transpose()));
}

void FoldedTransform::forward(double* values, double* coordinates) const {
  for (const TwoFolds& folds : folds_) {
    fold_mirrors(folds.first, values);
    fold_twice(folds.both, values);
    fold_mirrors(folds.second, values);
  }
  forward_.apply(values, coordinates);
}

// A fold is symmetric, and so are two of them on the same four rows: their order is all that turns round.
void FoldedTransform::inverse(const double* coordinates, double* values) const {
  inverse_.apply(coordinates, values);
  for (std::size_t i = folds_.size(); i-- > 0;) {
    fold_mirrors(folds_[i].second, values);
    fold_twice(folds_[i].both, values);
    fold_mirrors(folds_[i].first, values);
  }
}

}  // namespace seiche
