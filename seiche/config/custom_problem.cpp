#include <seiche/config/case_parameters.hpp>
#include <seiche/config/custom_problem.hpp>
#include <seiche/config/energy_split.hpp>
#include <seiche/config/field_potential.hpp>
#include <seiche/config/finite_force.hpp>
#include <seiche/config/initial_formulas.hpp>
#include <seiche/config/operator_formula.hpp>
#include <seiche/core/definiteness.hpp>
#include <seiche/core/error.hpp>
#include <seiche/core/number_text.hpp>
#include <seiche/core/operator_findings.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/potential/sum.hpp>
#include <seiche/problem/second_order.hpp>

#include <fmt/ranges.h>

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
    constants_.insert(custom.parameters.begin(), custom.parameters.end());
  }

  Problem build() {
    p_.S = custom_.S.empty() ? canonical_structure() : table("S", custom_.S);
    set_damping();
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
    FormulaConstants constants;
    constexpr std::array names = {"dx", "dy", "dz"};
    for (Index a = 0; a < axes_; ++a) constants[names[static_cast<std::size_t>(a)]] = p_.grid.axis(a).dx();
    return constants;
  }

  BlockStencil canonical_structure() const {
    if (fields() % 2 != 0)
      throw Error(
          "problem.S is not given, and [[0, I], [−I, 0]] needs coordinates and as many momenta, but the fields are {}",
          fmt::join(p_.fields, ", "));
    BlockStencil S(fields());
    const Index half = fields() / 2;
    for (Index i = 0; i < half; ++i) {
      S(i, half + i) = Stencil::identity();
      S(half + i, i) = Stencil::identity(-1);
    }
    return S;
  }

  std::string entry_key(const char* name, Index row, Index column) const {
    return fields() == 1 ? fmt::format("problem.{}", name)
                         : fmt::format("problem.{}, row {}, column {}", name, row + 1, column + 1);
  }

  void require_shape(const char* name, const FormulaTable& entries) const {
    const auto n = static_cast<std::size_t>(fields());
    const bool fits = entries.size() == n &&
                      std::all_of(entries.begin(), entries.end(), [n](const auto& row) { return row.size() == n; });
    if (!fits)
      throw Error("problem.{} must have {} rows of {} entries, one for each of the fields {}", name, n, n,
                  fmt::join(p_.fields, ", "));
  }

  template <class Take>
  void for_entries(const char* name, const FormulaTable& entries, bool may_vary, const Take& take) const {
    require_shape(name, entries);
    for (Index i = 0; i < fields(); ++i)
      for (Index j = 0; j < fields(); ++j) {
        const std::string& text = entries[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
        take(i, j,
             compile_operator(entry_key(name, i, j), text, p_.grid, axes_, discretisation(), constants_, may_vary,
                              advice(may_vary ? FormulaContext::Kind::damping_entry
                                              : FormulaContext::Kind::constant_entry)));
      }
  }

  BlockStencil table(const char* name, const FormulaTable& entries) const {
    BlockStencil block(fields());
    for_entries(name, entries, false,
                [&](Index i, Index j, const OperatorFormula& entry) { block(i, j) = entry.stencil; });
    return block;
  }

  void set_damping() {
    p_.damping.constant = BlockStencil(fields());
    p_.damping.rate_fields.assign(static_cast<std::size_t>(fields()), false);
    if (custom_.D.empty()) return;
    std::string rate;
    for_entries("D", custom_.D, true, [&](Index i, Index j, const OperatorFormula& entry) {
      p_.damping.constant(i, j) = entry.stencil;
      if (entry.rate.empty()) return;
      if (i != j) throw Error("{} = {}: off the diagonal D is constant", entry_key("D", i, j), entry.rate);
      if (!rate.empty() && rate != entry.rate)
        throw Error("problem.D has two rates that change, {} and {}; one is possible, of as many fields as wanted",
                    rate, entry.rate);
      rate = entry.rate;
      p_.damping.rate_fields[static_cast<std::size_t>(i)] = true;
    });
    if (rate.empty()) {
      set_constant_rate();
    } else {
      const DampingRate changing = compile_damping_rate("problem.D", rate, constants_);
      p_.damping.rate = changing.uniform;
      if (changing.varying) p_.damping.field_rate = changing.varying->on(p_.grid);
      require_finite_rate(rate);
    }
  }

  void require_finite_rate(const std::string& text) const {
    std::vector<double> gamma(static_cast<std::size_t>(p_.grid.unknowns()));
    if (p_.damping.field_rate) p_.damping.field_rate->values(0, gamma);
    if (p_.damping.rate) gamma.assign(1, p_.damping.rate->value(0));
    for (std::size_t j = 0; j < gamma.size(); ++j)
      if (!std::isfinite(gamma[j]))
        throw Error("problem.D: the rate {} is {} at t = 0{}", text, number_text(gamma[j]),
                    p_.damping.rate ? "" : place_text(p_.grid, static_cast<Index>(j)));
  }

  // γ on the diagonal of some fields acts exactly on them and apart from derivatives.
  void set_constant_rate() {
    double rate = 0;
    std::vector<double> diagonal;
    for (Index i = 0; i < fields(); ++i) {
      const double gamma = p_.damping.constant(i, i).identity_part();
      diagonal.push_back(gamma);
      if (gamma == 0) continue;
      if (rate != 0 && gamma != rate) return;
      rate = gamma;
    }
    if (rate == 0) return;
    p_.damping.rate = constant_rate(rate);
    for (Index i = 0; i < fields(); ++i) {
      const double gamma = diagonal[static_cast<std::size_t>(i)];
      p_.damping.constant(i, i) += Stencil::identity(-gamma);
      p_.damping.rate_fields[static_cast<std::size_t>(i)] = gamma != 0;
    }
  }

  NameAdvice advice(FormulaContext::Kind kind) const { return advice_in({kind, p_.fields, axes_, true}); }
  EnergyNames energy_names() const {
    return {.fields = p_.fields, .axes = axes_, .advice = advice(FormulaContext::Kind::energy)};
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
          custom_.H, whole);
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
    for (const QuadraticTerm& term : split.quadratic) add_quadratic(term);
    set_potential(split);
    return split;
  }

  void set_energy_given() {
    if (custom_.M.empty() && custom_.V.empty())
      throw Error("[problem] has no energy; write H = \"…\", as in H = \"{1}^2/2 + {0}^4/4\", or M and V",
                  p_.fields.front(), p_.fields.back());
    p_.M = custom_.M.empty() ? BlockStencil(fields()) : table("M", custom_.M);
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
            throw Error("{} = \"{}\" is not symmetric, as odd derivatives are not", entry_key("M", i, i), text(i, i));
          throw Error(
              "problem.M must be symmetric, but row {0}, column {1} is \"{2}\" and row {1}, column {0} is \"{3}\"{4}",
              i + 1, j + 1, text(i, j), text(j, i),
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

  // c (∂ᵃu)·(∂ᵇv) = c u·(−1)ᵃ∂ᵃ⁺ᵇv, once for each of the two rows.
  void add_quadratic(const QuadraticTerm& term) {
    p_.M(term.a.field, term.b.field) += term.coefficient * product(term.a, term.b);
    p_.M(term.b.field, term.a.field) += term.coefficient * product(term.b, term.a);
  }

  Stencil product(const Factor& a, const Factor& b) const {
    using Kind = Factor::Kind;
    if (a.kind == Kind::bond || b.kind == Kind::bond) {
      if (a.kind != b.kind)
        throw Error("problem.H: a difference between neighbours stands beside what belongs to a point");
      require_bonds();
      return -square(p_.grid.axis(0).dx()) * Stencil::second_derivative(p_.grid, 0, Discretisation::fd2);
    }
    if (a.kind != Kind::value && b.kind != Kind::value && a.axis != b.axis)
      throw Error("problem.H: products of derivatives along different axes are not there");
    const Index axis = a.kind != Kind::value ? a.axis : b.axis;
    const int order = static_cast<int>(a.kind) + static_cast<int>(b.kind);  // value, first, second
    const double sign = a.kind == Kind::first ? -1 : 1;
    switch (order) {
      case 0: return Stencil::identity();
      case 1: return sign * Stencil::derivative(p_.grid, axis, discretisation());
      case 2: return sign * Stencil::second_derivative(p_.grid, axis, discretisation());
      case 3: return sign * Stencil::third_derivative(p_.grid, axis, discretisation());
      default: return Stencil::fourth_derivative(p_.grid, axis, discretisation());
    }
  }

  void require_bonds() const {
    if (p_.grid.axis(0).boundary == Boundary::neumann)
      throw Error("differences between neighbours (d{}) need a ring (periodic) or fixed ends (dirichlet), not neumann",
                  p_.fields.front());
  }

  void set_potential(const EnergySplit& split) {
    std::vector<PlacedPotential> parts;
    for (const FieldFormula& f : split.per_point) parts.push_back({point_potential(f, p_.grid), f.field});
    for (const FieldFormula& f : split.per_bond) {
      require_bonds();
      parts.push_back({bond_potential(f, p_.grid), f.field});
    }
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
