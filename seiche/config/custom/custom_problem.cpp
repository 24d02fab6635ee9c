#include <seiche/config/custom/custom_names.hpp>
#include <seiche/config/custom/custom_problem.hpp>
#include <seiche/config/custom/energy_split.hpp>
#include <seiche/config/custom/field_potential.hpp>
#include <seiche/config/custom/metric_terms.hpp>
#include <seiche/config/data/initial_formulas.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/numerics/definiteness.hpp>
#include <seiche/core/text/axis_names.hpp>
#include <seiche/law/operator_findings.hpp>
#include <seiche/potential/sum.hpp>
#include <seiche/problem/common/second_order.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <set>

namespace seiche {
namespace {

using Factor = QuadraticTerm::Factor;

bool depends_on(const PointFormula& w, Index field) {
  const std::span<const Instruction> slope = w.gradient[static_cast<std::size_t>(field)]->program();
  return slope.size() != 1 || slope[0].kind != Instruction::Kind::number || slope[0].number != 0;
}

class Builder {
 public:
  explicit Builder(const CustomProblem& custom) : custom_(custom), axes_(0) {
    p_.name = "custom";
    p_.fields = field_names(custom);
    if (custom.grid) {
      p_.grid = make_grid(*custom.grid);
      axes_ = p_.grid.dimension();
      constants_ = grid_constants();
    } else {
      p_.grid = points_without_place(1);
    }
    for (const auto& [name, value] : custom.parameters) constants_[name] = value;
  }

  Problem build() {
    p_.S = custom_.S.empty() ? canonical_structure() : tables().block("S", custom_.S);
    p_.damping = tables().damping(custom_.D);
    if (!custom_.is_trial) tables().require_finite_rates(p_.damping);
    if (!custom_.H.empty()) {
      if (!custom_.V.empty() || !custom_.M.empty())
        throw Error("problem.H is the whole energy: leave out M and V, or write these two without H");
      set_energy_found();
    } else {
      set_energy_given();
    }
    note_what_energy_forgets();
    p_.initial = custom_.initial.empty() ? Vector(Vector::Zero(p_.size()))
                                         : initial_from_formulas(custom_.initial, constants_, p_);
    if (!custom_.initial.empty()) require_finite_force(p_);
    return std::move(p_);
  }

 private:
  Index fields() const { return p_.field_count(); }
  Discretisation discretisation() const { return custom_.grid ? custom_.grid->discretisation : Discretisation::fd2; }

  FormulaConstants grid_constants() const {
    const GridAxis& first = p_.grid.axis(0);
    FormulaConstants constants = {{"length", first.length}, {"points", static_cast<double>(first.intervals)}};
    if (axes_ == 1) constants[index_before_line] = index_at_origin(first.boundary);
    for (Index a = 0; a < axes_; ++a) constants[spacing_names[static_cast<std::size_t>(a)]] = p_.grid.axis(a).dx();
    return constants;
  }

  BlockStencil canonical_structure() const {
    require_structure(custom_);
    BlockStencil S(fields());
    const Index half = fields() / 2;
    for (Index i = 0; i < half; ++i) {
      S(i, half + i) = Stencil::identity();
      S(half + i, i) = Stencil::identity(-1);
    }
    return S;
  }

  CustomTables tables() const { return {p_, axes_, discretisation(), constants_}; }
  EnergyNames energy_names() const {
    return {.fields = p_.fields,
            .axes = axes_,
            .advice = advice_in({FormulaContext::Kind::energy, p_.fields, axes_, true})};
  }

  // What has no M ⪰ 0 goes to V: negative squares of fields, then products of two, then the squares of these, then all.
  void set_energy_found() {
    QuadraticTerms terms;
    EnergySplit split = take_energy(terms);
    const std::string whole = split.quadratic_text;
    const std::vector<ProductOfFields> products = products_of_fields(split);
    std::set<Index> coupled;
    for (const ProductOfFields& p : products)
      if (p.i != p.j) coupled.insert({p.i, p.j});
    using Leaves = bool (*)(const ProductOfFields& p, const std::set<Index>& coupled);
    constexpr std::array<Leaves, 4> attempts = {
        [](const ProductOfFields& p, const std::set<Index>&) { return p.i == p.j && p.coefficient < 0; },
        [](const ProductOfFields& p, const std::set<Index>&) { return p.i != p.j; },
        [](const ProductOfFields& p, const std::set<Index>& fields) { return fields.contains(p.i); },
        [](const ProductOfFields&, const std::set<Index>&) { return true; }};
    const auto is_metric = [this] { return look_at_operators(p_).M.holds(); };  // looks at every mode
    bool found = is_metric();
    for (const Leaves leaves : attempts) {
      if (found) break;
      for (const ProductOfFields& p : products)
        if (leaves(p, coupled)) terms.left_in_V.insert({p.i, p.j});
      split = take_energy(terms);
      found = is_metric();
    }
    if (!found)
      throw Error(
          "problem.H = \"{}\": its quadratic part, {}, is not ≥ 0 in any of the ways tried to put products of fields into V, and ½zᵀMz has to be",
          shortened(custom_.H), shortened(whole));
    p_.notes.push_back(fmt::format("H = ½zᵀMz + V with ½zᵀMz = {} and V = {}", split.quadratic_text, split.rest_text));
    note_left_out(split);
  }

  void note_left_out(const EnergySplit& split) {
    if (!split.left_out_text.empty())
      p_.notes.push_back(fmt::format("{} moves nothing, and H is counted without it", split.left_out_text));
  }

  struct ProductOfFields {
    Index i, j;  // i ≤ j
    double coefficient;
  };
  static std::vector<ProductOfFields> products_of_fields(const EnergySplit& split) {
    std::vector<ProductOfFields> products;
    for (const QuadraticTerm& term : split.quadratic)
      if (term.a.kind == Factor::Kind::value && term.b.kind == Factor::Kind::value)
        products.push_back(
            {std::min(term.a.field, term.b.field), std::max(term.a.field, term.b.field), term.coefficient});
    return products;
  }

  EnergySplit take_energy(const QuadraticTerms& terms) {
    EnergySplit split = split_energy("problem.H", custom_.H, energy_names(), constants_, terms);
    p_.M = BlockStencil(fields());
    try {
      for (const QuadraticTerm& term : split.quadratic) add_quadratic(term, p_.grid, discretisation(), p_.M);
    } catch (const Error& error) {
      throw Error("problem.H = \"{}\": {}", shortened(custom_.H), error.what());
    }
    set_potential(split);
    return split;
  }

  void set_energy_given() {
    if (custom_.M.empty() && custom_.V.empty())
      throw Error("[problem] has no energy; write H = \"…\", as in H = \"{1}^2/2 + {0}^4/4\", or M and V",
                  p_.fields.front(), p_.fields.back());
    p_.M = custom_.M.empty() ? BlockStencil(fields()) : tables().block("M", custom_.M);
    require_symmetric_M();
    if (custom_.V.empty()) return;
    const EnergySplit split = split_energy("problem.V", custom_.V, energy_names(), constants_, {.found = false});
    set_potential(split);
    note_left_out(split);
  }

  // ½zᵀMz sees only the symmetric part, and ∇H = Mz would not.
  void require_symmetric_M() const {
    const Modes modes(p_.grid);
    for (Index k = 0; k < modes.count(); ++k)
      for (Index i = 0; i < fields(); ++i)
        for (Index j = 0; j <= i; ++j) {
          const std::complex<double> below = p_.M(i, j).symbol(modes[k]), above = p_.M(j, i).symbol(modes[k]);
          if (std::abs(below - std::conj(above)) <= matrix_round_off * (std::abs(below) + std::abs(above))) continue;
          const auto text = [this](Index row, Index column) {
            return custom_.M[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
          };
          if (i == j)
            throw Error("{} = \"{}\" is not symmetric, as odd derivatives are not", tables().entry_key("M", i, i),
                        shortened(text(i, i)));
          throw Error(
              "problem.M must be symmetric, but row {0}, column {1} is \"{2}\" and row {1}, column {0} is \"{3}\"{4}",
              i + 1, j + 1, shortened(text(i, j)), shortened(text(j, i)),
              p_.M.has_real_symbol() ? "" : "; an odd derivative changes its sign there");
        }
  }

  void note_what_energy_forgets() {
    const Index half = fields() / 2;
    for (Index i = 0; i < fields(); ++i) {
      bool in_M = false;
      for (Index j = 0; j < fields(); ++j) in_M = in_M || !p_.M(i, j).is_zero();
      if (in_M || fields_of_V_.contains(i)) continue;
      const std::string& name = p_.fields[static_cast<std::size_t>(i)];
      // Of [[0, I], [−I, 0]]: ∂H/∂p is the velocity of q, and −∂H/∂q the force on p.
      const std::string& other = p_.fields[static_cast<std::size_t>((i + half) % fields())];
      p_.notes.push_back(
          custom_.S.empty()
              ? fmt::format("the energy does not name {0}: S gives {1} {2}", name, other,
                            i < half ? "no force" : fmt::format("no velocity, and H does not move {}", other))
              : fmt::format("the energy does not name {0}: ∂H/∂{0} = 0", name));
    }
  }

  void set_potential(const EnergySplit& split) {
    std::vector<PlacedPotential> parts;
    for (const FieldFormula& f : split.per_point) parts.push_back({point_potential(f, p_.grid), f.field});
    for (const FieldFormula& f : split.per_bond) parts.push_back({bond_potential(f, p_.grid), f.field});
    p_.potential = nullptr;
    p_.potential_field = 0;
    fields_of_V_.clear();
    for (const std::vector<FieldFormula>& formulas : {split.per_point, split.per_bond})
      for (const FieldFormula& f : formulas)
        for (Index i = 0; i < f.count; ++i)
          if (f.count == 1 || depends_on(f.w, i)) fields_of_V_.insert(f.field + i);
    if (parts.empty()) return;
    Index first = fields(), end = 0;
    for (const PlacedPotential& part : parts) {
      first = std::min(first, part.first_field);
      end = std::max(end, part.first_field + part.potential->fields());
    }
    for (PlacedPotential& part : parts) part.first_field -= first;
    p_.potential_field = first;
    p_.potential = sum_of(parts, end - first);
    if (custom_.grid) p_.potential = on_grid(p_.potential, p_.grid, *custom_.grid);
  }

  const CustomProblem& custom_;
  Index axes_;  // 0: no place
  FormulaConstants constants_;
  std::set<Index> fields_of_V_;
  Problem p_;
};

}  // namespace

Problem custom_problem(const CustomProblem& custom) { return Builder(custom).build(); }

}  // namespace seiche
