// Sparse matrices most of whose rows are one row shifted, as differences on a grid give.
#pragma once

#include <seiche/core/grid/sparse_operators.hpp>
#include <seiche/core/kicks.hpp>
#include <seiche/core/potential.hpp>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace seiche {

// Each kind of row once, and which rows are of that kind: products then read nothing but vectors.
class EqualRows {
 public:
  struct Kind {
    std::vector<Index> offsets;  // column − row, ascending
    std::vector<double> coefficients;
  };
  struct Run {  // rows begin … end − 1
    Index begin, end;
    const Kind* kind;
  };

  struct Operands {  // x and y point to component 0, g to component g_begin; g null: zero
    const double* x = nullptr;
    const double* g = nullptr;
    const double* y = nullptr;
    Index g_begin = 0;
  };

  enum class Limit { none, of_gain };
  // Nothing, with a limit, where rows differ so much that a product with the matrix costs less.
  static std::optional<EqualRows> of(const SparseMatrix& A, Limit limit = Limit::of_gain);

  Index size() const { return size_; }
  std::span<const Run> runs() const { return runs_; }
  // The row that all others are, shifted around a ring of all unknowns; null where they are not.
  const Kind* ring() const;
  void cut_runs(Index length);  // at every multiple of it

  void apply(const Vector& x, Vector& out) const;               // out ← Ax, not x itself
  double form(const Vector& x) const;                           // xᵀAx
  ValueAndMagnitude form_and_magnitude(const Vector& x) const;  // xᵀAx and |x|ᵀ|A||x|

 private:
  Index size_ = 0;
  std::vector<std::shared_ptr<const Kind>> kinds_;
  std::vector<Run> runs_;
};

// With F = Ax + g in the rows of the runs: out ← y − cF; out may be y.
void subtract_rows(std::span<const EqualRows::Run> runs, double c, const EqualRows::Operands& in, double* out);

// y ← y − kick · F, then x_after ← x + length · y and y_after ← decay · y; returns |y|² from before the last. y_after
// may be y, x_after is not x. The squares are added up one after the other: for runs of some hundreds of rows.
double kick_and_drift(std::span<const EqualRows::Run> runs, const Kicks::KickAndDrift& factors,
                      const EqualRows::Operands& in, double* x_after, double* y_after);

}  // namespace seiche
