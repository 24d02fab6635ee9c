#include <seiche/core/base/error.hpp>
#include <seiche/potential/polynomials.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/common/second_order.hpp>
#include <seiche/problem/common/wave.hpp>
#include <seiche/problem/network.hpp>

#include <algorithm>

namespace seiche {
namespace {

// SplitMix64 (Steele, Lea, Flood 2014): the standard library's distributions differ from machine to machine.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed) {}
  Index below(Index count) {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return static_cast<Index>((z ^ (z >> 31U)) % static_cast<std::uint64_t>(count));
  }

 private:
  std::uint64_t state_;
};

// Σ over edges w (e_i − e_j)(e_i − e_j)ᵀ.
SparseMatrix laplacian(const SparseMatrix& adjacency) {
  if (adjacency.rows() != adjacency.cols())
    throw Error("the matrix of a graph must be square and is {} × {}", adjacency.rows(), adjacency.cols());
  std::vector<Entry> entries;
  for (Index j = 0; j < adjacency.cols(); ++j)
    for (SparseMatrix::InnerIterator entry(adjacency, j); entry; ++entry) {
      const Index i = entry.row();
      const double w = entry.value();
      if (i == j) continue;
      if (!(w >= 0)) throw Error("the weight ({}, {}) = {} of a graph must be ≥ 0", i + 1, j + 1, w);
      if (w != adjacency.coeff(j, i))
        throw Error("the weights of a graph must be symmetric, but ({}, {}) = {} and ({}, {}) = {}", i + 1, j + 1, w,
                    j + 1, i + 1, adjacency.coeff(j, i));
      entries.push_back({i, j, -w});
      entries.push_back({i, i, w});
    }
  return assembled(adjacency.rows(), entries);
}

}  // namespace

SparseMatrix small_world(Index count, Index neighbours, Index shortcuts, std::uint64_t seed) {
  if (2 * neighbours >= count)
    throw Error("{} neighbours on each side need more than {} nodes, and there are {}", neighbours, 2 * neighbours,
                count);
  const Index room = count * (count - 1) / 2 - count * neighbours;
  if (2 * shortcuts > room)
    throw Error("{} shortcuts are too many: at most half of the {} edges that are left", shortcuts, room);
  std::vector<Entry> entries;
  const auto join = [&entries](Index i, Index j) {
    entries.push_back({i, j, 1});
    entries.push_back({j, i, 1});
  };
  std::vector<std::pair<Index, Index>> chosen;
  for (Index i = 0; i < count; ++i)
    for (Index k = 1; k <= neighbours; ++k) join(i, (i + k) % count);
  Draw draw(seed);
  while (static_cast<Index>(chosen.size()) < shortcuts) {
    const Index i = draw.below(count);
    const Index j = draw.below(count);
    const Index apart = std::min((i - j + count) % count, (j - i + count) % count);
    const auto edge = std::minmax(i, j);
    const std::pair<Index, Index> key(edge.first, edge.second);
    if (apart <= neighbours || std::find(chosen.begin(), chosen.end(), key) != chosen.end()) continue;
    chosen.push_back(key);
    join(i, j);
  }
  return assembled(count, entries);
}

Problem network(const Network& options) {
  const Index n = options.adjacency.rows();
  if (n < 1) throw Error("the matrix of a graph is 0 × {} and must have at least one node", options.adjacency.cols());
  SparseMatrix stiffness(n, n);
  stiffness.setIdentity();
  stiffness = options.omega_squared * stiffness + options.coupling * laplacian(options.adjacency);
  const Grid grid = points_without_place(n);
  Problem p = second_order_problem("network", grid, stiffness, {});
  p.damping = rate_damping(options.gamma, grid, {false, true});
  p.potential = nodal_polynomial(monomial(options.alpha / 4, 4));
  p.initial[0] = 1;
  return p;
}

namespace {

// What a case file says: Network, with a graph from a file or made.
struct NetworkCase {
  MatrixPointer graph = nullptr;
  bool is_laplacian = false;
  Index nodes = 20, neighbours = 2, shortcuts = 6, seed = 1;
  double coupling = 1.0, omega_squared = 0.2, alpha = 1.0;
  DampingRate gamma = nullptr;
};

Problem from_graph(const NetworkCase& c) {
  const auto made = [&] { return small_world(c.nodes, c.neighbours, c.shortcuts, static_cast<std::uint64_t>(c.seed)); };
  // The weights of a Laplacian have the other sign.
  const auto given = [&] { return c.is_laplacian ? SparseMatrix(-1.0 * *c.graph) : *c.graph; };
  return network({.adjacency = c.graph ? given() : made(),
                  .coupling = c.coupling,
                  .omega_squared = c.omega_squared,
                  .alpha = c.alpha,
                  .gamma = c.gamma});
}

}  // namespace

ProblemEntry network_entry() {
  using P = NetworkCase;
  return ProblemRows<P>({.name = "network",
                         .title = "Oscillators on a graph",
                         .equation = "ü_i + γu̇_i + ω²u_i + κΣ_j w_ij(u_i − u_j) + αu_i³ = 0",
                         .reference = "Newman and Watts (1999) for the graph",
                         .fields = {"u", "v"},
                         .meanings = {"displacement", "velocity"},
                         .default_h = "1/64",
                         .default_end = 20.0},
                        from_graph)
      .row(&P::graph,
           {.name = "graph",
            .meaning = "w, a file of Matrix Market or of PETSc; \"\": a ring with shortcuts, by the four below"})
      .choice(&P::is_laplacian,
              {.name = "graph_matrix", .meaning = "what the file holds", .choices = {"adjacency", "laplacian"}})
      .row(&P::nodes, {.name = "nodes", .meaning = "of the ring", .minimum = 3, .maximum = 1 << 24})
      .row(&P::neighbours,
           {.name = "neighbours", .meaning = "to which a node is joined, on each side", .minimum = 1, .maximum = 1000})
      .row(&P::shortcuts, {.name = "shortcuts", .meaning = "further edges", .minimum = 0, .maximum = 10000})
      .row(&P::seed, {.name = "seed", .meaning = "of the shortcuts", .minimum = 0})
      .row(&P::coupling, {.name = "coupling", .meaning = "κ, strength of the edges", .minimum = 0})
      .row(&P::omega_squared,
           {.name = "omega_squared", .meaning = "ω², frequency squared of a node alone", .minimum = 0})
      .row(&P::alpha, {.name = "alpha", .meaning = "α, strength of the cubic force"})
      .row(&P::gamma, {.name = "gamma", .default_value = "0.1", .meaning = "γ, damping rate, 1/time"})
      .preset("one_node");
}

}  // namespace seiche
