#include <seiche/core/base/error.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/common/second_order.hpp>
#include <seiche/problem/common/wave.hpp>
#include <seiche/problem/sparse.hpp>

#include <cmath>

namespace seiche {
namespace {

SparseMatrix canonical_structure(Index size) {
  std::vector<Entry> entries;
  for (Index i = 0; i < size / 2; ++i) {
    entries.push_back({i, size / 2 + i, 1});
    entries.push_back({size / 2 + i, i, -1});
  }
  return assembled(size, entries);
}

// diag(K, I) with K = tridiag(−1, 2, −1): a chain held at its ends.
SparseMatrix chain_metric(Index count) {
  std::vector<Entry> entries;
  for (Index i = 0; i < count; ++i) {
    entries.push_back({i, i, 2});
    entries.push_back({count + i, count + i, 1});
    if (i == 0) continue;
    entries.push_back({i, i - 1, -1});
    entries.push_back({i - 1, i, -1});
  }
  return assembled(2 * count, entries);
}

}  // namespace

Problem sparse_problem(SparseSystem options) {
  SparseOperators& matrices = options.matrices;
  const Index size = matrices.M.rows();
  if (options.fields != 1 && options.fields != 2)
    throw Error("fields = {} must be 1 or 2: z is u alone, or (u, v)", options.fields);
  if (size == 0 || size % options.fields != 0)
    throw Error("M is {} × {}, which is not {} fields of equal size", size, matrices.M.cols(), options.fields);
  if (matrices.S.size() == 0) {
    if (options.fields != 2) throw Error("S = [[0, I], [−I, 0]] needs two fields; name a file for S");
    matrices.S = canonical_structure(size);
  }
  if (matrices.D.size() == 0) matrices.D.resize(size, size);
  matrices.validate();
  const Index n = size / options.fields;
  Problem p;
  p.name = "sparse";
  p.grid = points_without_place(n);
  p.fields = options.fields == 2 ? std::vector<std::string>{"u", "v"} : std::vector<std::string>{"u"};
  p.S = p.M = BlockStencil(options.fields);
  std::vector<bool> damped(static_cast<std::size_t>(options.fields), false);
  damped.back() = true;
  p.damping = rate_damping(options.gamma, p.grid, damped);
  p.damping.constant = BlockStencil(options.fields);
  p.matrices = std::make_shared<SparseOperators>(std::move(matrices));
  if (options.cubic != 0 || options.quartic != 0)
    p.potential = nodal_polynomial({0, 0, 0, options.cubic / 3, options.quartic / 4});
  p.initial = Vector::Zero(size);
  for (Index i = 0; i < n; ++i)
    p.initial[i] = std::exp(-square((static_cast<double>(i) + 0.5) / static_cast<double>(n) - 0.5) / square(0.1));
  return p;
}

namespace {

// What a case file says: SparseSystem, with its matrices from files.
struct SparseCase {
  MatrixPointer M = nullptr, S = nullptr, D = nullptr;
  Index fields = 2;
  double cubic = 0.0, quartic = 1.0;
  DampingRate gamma = nullptr;
};

Problem from_files(const SparseCase& c) {
  if (!c.M && (c.S || c.D || c.fields != 2))
    throw Error("problem.M names no file; without it M is that of a chain of 20, and neither S, D nor fields is given");
  SparseSystem options{.fields = c.fields, .matrices = {}, .cubic = c.cubic, .quartic = c.quartic, .gamma = c.gamma};
  options.matrices.M = c.M ? *c.M : chain_metric(20);
  if (c.S) options.matrices.S = *c.S;
  if (c.D) options.matrices.D = *c.D;
  return sparse_problem(std::move(options));
}

}  // namespace

ProblemEntry sparse_entry() {
  using P = SparseCase;
  return ProblemRows<P>({.name = "sparse",
                         .title = "Sparse system",
                         .equation = "ż = S∇H(z) − Dz,  H = ½zᵀMz + a₃/3 Σu³ + a₄/4 Σu⁴",
                         .reference = "Matrix Market files: Boisvert, Pozo, Remington, NISTIR 5935 (1996)",
                         .fields = {"u", "v"},
                         .meanings = {"displacement", "momentum"},
                         .default_h = "1/64",
                         .default_end = 20.0},
                        from_files)
      .row(&P::M,
           {.name = "M",
            .meaning = "symmetric, positive semidefinite; a file of Matrix Market, or of PETSc (binary); \"\": a "
                       "chain of 20, held at its ends"})
      .row(&P::S,
           {.name = "S", .meaning = "the structure; a law is promised where S + Sᵀ ⪯ 0; \"\": [[0, I], [−I, 0]]"})
      .row(&P::D, {.name = "D", .meaning = "constant damping; \"\": none"})
      .row(&P::fields, {.name = "fields", .meaning = "z = (u, v), or u alone", .minimum = 1, .maximum = 2})
      .row(&P::cubic, {.name = "cubic", .meaning = "a₃"})
      .row(&P::quartic, {.name = "quartic", .meaning = "a₄"})
      .row(&P::gamma,
           {.name = "gamma", .default_value = "0.1", .meaning = "γ, further damping of the last field, 1/time"})
      .preset("bump");
}

}  // namespace seiche
