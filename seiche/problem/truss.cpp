#include <seiche/core/base/error.hpp>
#include <seiche/potential/bars.hpp>
#include <seiche/problem/common/problem_rows.hpp>
#include <seiche/problem/common/second_order.hpp>
#include <seiche/problem/common/wave.hpp>
#include <seiche/problem/truss.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace seiche {
namespace {

struct Node {
  double x, y;
};

struct Frame {
  std::vector<Node> nodes;  // those that move
  std::vector<Bar> bars;
  std::vector<std::array<Index, 2>> ends;  // of the bars; behind the nodes the two supports
  std::vector<double> lengths;
};

Frame pratt(Index panels, double side) {
  Frame frame;
  const Index moving = 2 * (panels - 1);
  const auto lower = [=](Index i) { return i == 0 ? moving : i == panels ? moving + 1 : i - 1; };
  const auto upper = [panels](Index i) { return panels - 1 + i - 1; };
  for (Index i = 1; i < panels; ++i) frame.nodes.push_back({static_cast<double>(i) * side, 0});
  for (Index i = 1; i < panels; ++i) frame.nodes.push_back({static_cast<double>(i) * side, side});
  const auto join = [&](Index a, Index b, double dx, double dy) {
    const double length = std::hypot(dx, dy);
    const auto node = [moving](Index end) { return end < moving ? end : Index(-1); };
    frame.bars.push_back({node(a), node(b), dx / length, dy / length});
    frame.ends.push_back({a, b});
    frame.lengths.push_back(length * side);
  };
  for (Index i = 0; i < panels; ++i) join(lower(i), lower(i + 1), 1, 0);
  for (Index i = 1; i + 1 < panels; ++i) join(upper(i), upper(i + 1), 1, 0);
  for (Index i = 1; i < panels; ++i) join(lower(i), upper(i), 0, 1);
  join(lower(0), upper(1), 1, 1);  // the ends
  join(upper(panels - 1), lower(panels), 1, -1);
  for (Index i = 1; i + 1 < panels; ++i)
    2 * i < panels ? join(upper(i), lower(i + 1), 1, -1) : join(lower(i), upper(i + 1), 1, 1);
  return frame;
}

// Σ c_bar b bᵀ, where bᵀu is the elongation of the bar.
template <class Constant>
SparseMatrix sum_over_bars(const Frame& frame, const Constant& constant) {
  const Index n = static_cast<Index>(frame.nodes.size());
  std::vector<Entry> entries;
  for (std::size_t k = 0; k < frame.bars.size(); ++k) {
    const Bar& bar = frame.bars[k];
    std::vector<Entry> b;  // row, –, entry of b
    for (const auto& [node, sign] : {std::pair{bar.a, -1.0}, std::pair{bar.b, 1.0}}) {
      if (node < 0) continue;
      b.push_back({node, 0, sign * bar.nx});
      b.push_back({n + node, 0, sign * bar.ny});
    }
    for (const Entry& i : b)
      for (const Entry& j : b) entries.push_back({i.row, j.row, constant(k) * (i.value * j.value)});
  }
  return assembled(2 * n, entries);
}

}  // namespace

Problem truss(const Truss& options) {
  if (options.panels < 2) throw Error("a truss of {} panels has no node that moves; at least 2", options.panels);
  const Frame frame = pratt(options.panels, options.side);
  const Index n = static_cast<Index>(frame.nodes.size());
  const SparseMatrix stiffness =
      sum_over_bars(frame, [&](std::size_t k) { return options.stiffness / frame.lengths[k]; });
  const SparseMatrix dashpots = sum_over_bars(frame, [&](std::size_t) { return options.dashpot; });
  Grid grid = points_without_place(n);
  for (const Node& node : frame.nodes) grid.nodes.push_back({node.x, node.y, 0});
  const double span = static_cast<double>(options.panels) * options.side;
  grid.supports = {{0, 0, 0}, {span, 0, 0}};
  grid.bars = frame.ends;
  Problem p = second_order_problem("truss", grid, stiffness,
                                   {.fields = {"x", "y", "px", "py"},
                                    .inverse_mass = 1 / options.mass,
                                    .dashpots = options.dashpot != 0 ? dashpots : SparseMatrix(2 * n, 2 * n)});
  const LinearDamping drag = rate_damping(options.gamma, grid, {false, false, true, true});
  p.damping.rate = drag.rate;
  p.damping.rate_fields = drag.rate_fields;
  p.potential =
      std::make_shared<BarPotential<Polynomial<4>>>(Polynomial<4>{{0, 0, 0, options.cubic / 3, options.quartic / 4}},
                                                    frame.bars);
  for (Index i = 0; i < n; ++i)
    p.initial[n + i] =
        -options.amplitude * std::sin(std::numbers::pi * frame.nodes[static_cast<std::size_t>(i)].x / span);
  return p;
}

ProblemEntry truss_entry() {
  using P = Truss;
  return ProblemRows<P>({.name = "truss",
                         .title = "Truss",
                         .equation = "m ü = −Σ_bars n (EA/ℓ e + a₃e² + a₄e³ + c ė) − γ m u̇,  e = n·(u_b − u_a)",
                         .reference = "Argyris and Mlejnek, Dynamics of Structures (1991)",
                         .fields = {"x", "y", "px", "py"},
                         .meanings = {"horizontal displacement", "vertical displacement", "horizontal momentum",
                                      "vertical momentum"},
                         .default_h = "1/64",
                         .default_end = 20.0},
                        truss)
      .row(&P::panels,
           {.name = "panels", .meaning = "squares between the two supports", .minimum = 2, .maximum = 1 << 22})
      .row(&P::side, {.name = "side", .meaning = "of a square, length", .minimum = 0, .minimum_excluded = true})
      .row(&P::mass, {.name = "mass", .meaning = "m, of every node", .minimum = 0, .minimum_excluded = true})
      .row(&P::stiffness, {.name = "stiffness",
                           .meaning = "EA: a bar of length ℓ is a spring of EA/ℓ",
                           .minimum = 0,
                           .minimum_excluded = true})
      .row(&P::cubic, {.name = "cubic", .meaning = "a₃ of the force −a₃e² of a bar"})
      .row(&P::quartic, {.name = "quartic", .meaning = "a₄ of the force −a₄e³ of a bar"})
      .row(&P::dashpot, {.name = "dashpot", .meaning = "c, force per rate of elongation", .minimum = 0})
      .row(&P::gamma, {.name = "gamma", .default_value = "0.05", .meaning = "γ, drag of the air, 1/time"})
      .row(&P::amplitude, {.name = "amplitude", .meaning = "of the initial deflection, length"})
      .preset("deflected");
}

}  // namespace seiche
