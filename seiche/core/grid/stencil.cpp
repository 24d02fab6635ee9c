#include <seiche/core/base/error.hpp>
#include <seiche/core/base/memory_limit.hpp>
#include <seiche/core/grid/line_modes.hpp>
#include <seiche/core/grid/stencil.hpp>
#include <seiche/core/text/axis_names.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>

namespace seiche {
namespace {

// Coefficients of a central difference, by offset.
std::map<Index, double> taps(int order, Discretisation discretisation, double dx) {
  if (order == 4) {
    std::map<Index, double> product;
    for (const auto& [i, a] : taps(2, discretisation, dx))
      for (const auto& [j, b] : taps(2, discretisation, dx)) product[i + j] += a * b;
    for (auto& [offset, c] : product)
      if (offset < 0) c = product.at(-offset);  // symmetric to the last bit
    return product;
  }
  if (order == 3) {
    std::map<Index, double> product;
    for (const auto& [i, a] : taps(1, discretisation, dx))
      for (const auto& [j, b] : taps(2, discretisation, dx)) product[i + j] += a * b;
    std::erase_if(product, [](const auto& tap) { return tap.first == 0; });
    for (auto& [offset, c] : product)
      if (offset < 0) c = -product.at(-offset);  // antisymmetric to the last bit, as the sums need not be
    return product;
  }
  if (order == 1) {
    if (discretisation == Discretisation::fd2) return {{-1, -1 / (2 * dx)}, {1, 1 / (2 * dx)}};
    const double c = 1 / (12 * dx);
    return {{-2, c}, {-1, -8 * c}, {1, 8 * c}, {2, -c}};
  }
  if (discretisation == Discretisation::fd2) {
    const double c = 1 / (dx * dx);
    return {{-1, c}, {0, -2 * c}, {1, c}};
  }
  const double c = 1 / (12 * dx * dx);
  return {{-2, -c}, {-1, 16 * c}, {0, -30 * c}, {1, 16 * c}, {2, -c}};
}

struct Reflected {
  Index index;
  double sign;
};

// Which unknown stands for point i of the continued field, and with which sign; sign 0: an end where the field
// vanishes.
Reflected locate(Index i, const GridAxis& axis) {
  const Index n = axis.intervals;
  const auto wrap = [](Index j, Index period) { return ((j % period) + period) % period; };
  switch (axis.boundary) {
    case Boundary::periodic: return {wrap(i, n), 1.0};
    case Boundary::neumann: {
      const Index j = wrap(i, 2 * n);
      return {j < n ? j : 2 * n - 1 - j, 1.0};
    }
    case Boundary::dirichlet: break;
  }
  const Index j = wrap(i + 1, 2 * n);
  if (j % n == 0) return {0, 0.0};
  return j < n ? Reflected{j - 1, 1.0} : Reflected{2 * n - j - 1, -1.0};
}

// A SparseMatrix counts its entries by int, and is put together from triplets that stand beside it.
void require_entries(double entries) {
  constexpr double most = std::numeric_limits<int>::max();
  constexpr double bytes_per_entry = sizeof(Eigen::Triplet<double>) + sizeof(double) + sizeof(int);
  if (entries > most)
    throw Error("a sparse matrix of {:.0f} entries is not possible: at most {:.0f}; choose fewer points", entries,
                most);
  if (entries * bytes_per_entry > memory_limit())
    throw Error(
        "a sparse matrix of {:.0f} entries needs {:.3g} bytes, but only {:.3g} are available; choose fewer points",
        entries, entries * bytes_per_entry, memory_limit());
}

}  // namespace

Stencil Stencil::identity(double factor) {
  Stencil s;
  s.identity_ = factor;
  return s;
}

Stencil Stencil::laplacian(const Grid& grid, Discretisation discretisation) {
  Stencil s;
  for (Index a = 0; a < grid.dimension(); ++a) s += second_derivative(grid, a, discretisation);
  return s;
}

Stencil Stencil::second_derivative(const Grid& grid, Index axis, Discretisation discretisation) {
  Stencil s;
  s.terms_.push_back({axis, 2, discretisation, grid.axis(axis).dx(), 1.0});
  return s;
}

Stencil Stencil::fourth_derivative(const Grid& grid, Index axis, Discretisation discretisation) {
  Stencil s;
  s.terms_.push_back({axis, 4, discretisation, grid.axis(axis).dx(), 1.0});
  return s;
}

Stencil Stencil::odd_derivative(const Grid& grid, Index axis, int order, Discretisation discretisation) {
  if (grid.axis(axis).boundary != Boundary::periodic)
    throw Error("a {} derivative along {} needs periodic ends there", order == 1 ? "first" : "third",
                axis_names[static_cast<std::size_t>(axis)]);
  Stencil s;
  s.terms_.push_back({axis, order, discretisation, grid.axis(axis).dx(), 1.0});
  return s;
}

Stencil Stencil::derivative(const Grid& grid, Index axis, Discretisation discretisation) {
  return odd_derivative(grid, axis, 1, discretisation);
}

Stencil Stencil::multiplier(const Grid& grid, WaveFunction f, Parity parity) {
  Stencil s;
  s.multipliers_.push_back({std::make_shared<FourierMultiplier>(grid, std::move(f), parity), 1.0});
  return s;
}

Stencil Stencil::product(const Stencil& a, const Stencil& b) {
  Stencil s;
  s.products_.push_back({std::make_shared<Stencil>(a), std::make_shared<Stencil>(b), 1.0});
  return s;
}

Stencil Stencil::third_derivative(const Grid& grid, Index axis, Discretisation discretisation) {
  return odd_derivative(grid, axis, 3, discretisation);
}

Stencil& Stencil::operator+=(const Stencil& other) {
  identity_ += other.identity_;
  for (const Term& term : other.terms_) {
    const auto same = std::find_if(terms_.begin(), terms_.end(), [&](const Term& t) {
      return t.axis == term.axis && t.order == term.order && t.discretisation == term.discretisation && t.dx == term.dx;
    });
    if (same == terms_.end()) {
      terms_.push_back(term);
    } else {
      same->factor += term.factor;
    }
  }
  for (const Multiplier& multiplier : other.multipliers_) {
    const auto same = std::find_if(multipliers_.begin(), multipliers_.end(),
                                   [&](const Multiplier& m) { return m.function == multiplier.function; });
    if (same == multipliers_.end()) {
      multipliers_.push_back(multiplier);
    } else {
      same->factor += multiplier.factor;
    }
  }
  for (const Product& product : other.products_) {
    const auto same = std::find_if(products_.begin(), products_.end(), [&](const Product& p) {
      return p.first == product.first && p.second == product.second;
    });
    if (same == products_.end()) {
      products_.push_back(product);
    } else {
      same->factor += product.factor;
    }
  }
  drop_what_vanishes();
  return *this;
}

Stencil& Stencil::operator*=(double factor) {
  identity_ *= factor;
  for (Term& term : terms_) term.factor *= factor;
  for (Multiplier& multiplier : multipliers_) multiplier.factor *= factor;
  for (Product& product : products_) product.factor *= factor;
  drop_what_vanishes();
  return *this;
}

void Stencil::drop_what_vanishes() {
  const auto vanishes = [](const auto& term) { return term.factor == 0; };
  std::erase_if(terms_, vanishes);
  std::erase_if(multipliers_, vanishes);
  std::erase_if(products_, vanishes);
}

std::optional<double> Stencil::factor_of_identity() const {
  return terms_.empty() && multipliers_.empty() && products_.empty() ? std::optional(identity_) : std::nullopt;
}

bool Stencil::is_symmetric() const {
  return std::all_of(terms_.begin(), terms_.end(), [](const Term& t) { return t.order % 2 == 0; }) &&
         std::all_of(multipliers_.begin(), multipliers_.end(),
                     [](const Multiplier& m) { return m.function->parity() == Parity::even; }) &&
         std::all_of(products_.begin(), products_.end(), [](const Product& p) { return p.is_symmetric(); });
}

bool Stencil::is_sparse() const {
  return multipliers_.empty() &&
         std::none_of(terms_.begin(), terms_.end(),
                      [](const Term& t) { return t.discretisation == Discretisation::spectral; }) &&
         std::all_of(products_.begin(), products_.end(),
                     [](const Product& p) { return p.first->is_sparse() && p.second->is_sparse(); });
}

// With θ = 2πk/period the phase from point to point and s = sin(θ/2):
//   second derivative  −4s²/Δx²,  −4s²(1 + s²/3)/Δx²,  −κ²;      first  i sin θ/Δx,  i sin θ (1 + 2s²/3)/Δx,  iκ
// the third is their product, and the fourth the square of the second.
std::complex<double> Stencil::symbol(const Term& term, Index k, Index period) {
  if (term.order == 3) {
    const auto of_order = [&](int order) {
      return symbol({term.axis, order, term.discretisation, term.dx, 1.0}, k, period);
    };
    return term.factor * of_order(1) * of_order(2);
  }
  if (term.order == 4)
    return term.factor * square(symbol({term.axis, 2, term.discretisation, term.dx, 1.0}, k, period).real());
  if (2 * k > period) k -= period;
  const double kappa = 2 * std::numbers::pi * static_cast<double>(k) / (static_cast<double>(period) * term.dx);
  const double s2 = square(sin_pi(k, period));
  const double theta_sine = sin_pi(2 * k, period);
  if (term.order == 1) {
    switch (term.discretisation) {
      case Discretisation::fd2: return {0, term.factor * theta_sine / term.dx};
      case Discretisation::fd4: return {0, term.factor * theta_sine * (1 + 2 * s2 / 3) / term.dx};
      case Discretisation::spectral: return {0, 2 * k == period ? 0.0 : term.factor * kappa};  // no sine at Nyquist
    }
  }
  switch (term.discretisation) {
    case Discretisation::fd2: return -4 * term.factor * s2 / square(term.dx);
    case Discretisation::fd4: return -4 * term.factor * s2 * (1 + s2 / 3) / square(term.dx);
    case Discretisation::spectral: return -term.factor * square(kappa);
  }
  return 0;
}

std::complex<double> Stencil::symbol(const Mode& mode) const {
  std::complex<double> sum = identity_;
  for (const Term& term : terms_) {
    const auto a = static_cast<std::size_t>(term.axis);
    sum += symbol(term, mode.k[a], mode.period[a]);
  }
  for (const Multiplier& multiplier : multipliers_) sum += multiplier.factor * multiplier.function->symbol(mode);
  for (const Product& p : products_) sum += p.factor * p.first->symbol(mode) * p.second->symbol(mode);
  return sum;
}

Eigen::MatrixXd Stencil::line_matrix(const Term& term, const GridAxis& axis) {
  const Index n = axis.unknowns();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  if (term.discretisation != Discretisation::spectral) {
    for (Index i = 0; i < n; ++i)
      for (const auto& [offset, c] : taps(term.order, term.discretisation, term.dx)) {
        const Reflected at = locate(i + offset, axis);
        a(i, at.index) += at.sign * term.factor * c;
      }
    return a;
  }
  if (axis.boundary != Boundary::periodic) {
    const Eigen::MatrixXd modes = line_modes(axis);
    Vector values(n);
    for (Index k = 0; k < n; ++k)
      values[k] = symbol(term, k + (axis.boundary == Boundary::dirichlet ? 1 : 0), 2 * axis.intervals).real();
    return modes * values.asDiagonal() * modes.transpose();
  }
  for (Index d = 0; d < n; ++d) {  // a(i, j) depends on i − j
    double sum = 0;
    for (Index k = 0; k < n; ++k) {
      const std::complex<double> c = symbol(term, k, n);
      sum += c.real() * sin_pi(4 * k * d + n, 2 * n) - c.imag() * sin_pi(2 * k * d, n);
    }
    for (Index j = 0; j < n; ++j) a((j + d) % n, j) = sum / static_cast<double>(n);
  }
  return a;
}

Eigen::MatrixXd Stencil::matrix(const Grid& grid) const {
  const Index n = grid.unknowns();
  Eigen::MatrixXd a = identity_ * Eigen::MatrixXd::Identity(n, n);
  for (const Term& term : terms_) {
    const Eigen::MatrixXd line = line_matrix(term, grid.axis(term.axis));
    Index stride = 1;
    for (Index b = grid.dimension() - 1; b > term.axis; --b) stride *= grid.axis(b).unknowns();
    for (Index i = 0; i < n; ++i) {
      const Index here = i / stride % line.rows();
      for (Index j = 0; j < line.cols(); ++j) a(i, i + (j - here) * stride) += line(here, j);
    }
  }
  for (const Multiplier& multiplier : multipliers_) a += multiplier.factor * multiplier.function->matrix(grid);
  for (const Product& p : products_) a += p.factor * p.first->matrix(grid) * p.second->matrix(grid);
  return a;
}

// At most.
double Stencil::entries_per_row() const {
  double count = identity_ != 0 ? 1 : 0;
  for (const Term& term : terms_) count += static_cast<double>(taps(term.order, term.discretisation, term.dx).size());
  for (const Product& p : products_) count += p.first->entries_per_row() * p.second->entries_per_row();
  return count;
}

SparseMatrix Stencil::Product::sparse_matrix(const Grid& grid) const {
  const SparseMatrix product = factor * first->sparse_matrix(grid) * second->sparse_matrix(grid);
  if (!is_symmetric()) return product;
  return 0.5 * (product + SparseMatrix(product.transpose()));  // to the last bit, as the sums need not be
}

SparseMatrix Stencil::sparse_matrix(const Grid& grid) const {
  if (!is_sparse()) throw Error("spectral derivatives couple every point with every other and have no sparse matrix");
  const Index n = grid.unknowns();
  require_entries(entries_per_row() * static_cast<double>(n));
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&entries](Index i, Index j, double value) {
    entries.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
  };
  if (identity_ != 0)
    for (Index i = 0; i < n; ++i) add(i, i, identity_);
  for (const Term& term : terms_) {
    const GridAxis& axis = grid.axis(term.axis);
    Index stride = 1;
    for (Index b = grid.dimension() - 1; b > term.axis; --b) stride *= grid.axis(b).unknowns();
    for (Index i = 0; i < n; ++i) {
      const Index here = i / stride % axis.unknowns();
      for (const auto& [offset, c] : taps(term.order, term.discretisation, term.dx)) {
        const Reflected at = locate(here + offset, axis);
        if (at.sign != 0) add(i, i + (at.index - here) * stride, at.sign * term.factor * c);
      }
    }
  }
  SparseMatrix a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  for (const Product& product : products_) a += product.sparse_matrix(grid);
  return a;
}

BlockStencil::BlockStencil(Index fields) : fields_(fields), entries_(static_cast<std::size_t>(fields * fields)) {}

Stencil& BlockStencil::operator()(Index row, Index column) {
  return entries_[static_cast<std::size_t>(row * fields_ + column)];
}

const Stencil& BlockStencil::operator()(Index row, Index column) const {
  return entries_[static_cast<std::size_t>(row * fields_ + column)];
}

bool BlockStencil::is_zero() const {
  return std::all_of(entries_.begin(), entries_.end(), [](const Stencil& s) { return s.is_zero(); });
}

bool BlockStencil::is_sparse() const {
  return std::all_of(entries_.begin(), entries_.end(), [](const Stencil& s) { return s.is_sparse(); });
}

bool BlockStencil::has_real_symbol() const {
  return std::all_of(entries_.begin(), entries_.end(), [](const Stencil& s) { return s.is_symmetric(); });
}

Eigen::MatrixXcd BlockStencil::symbol(const Mode& mode) const {
  Eigen::MatrixXcd block(fields_, fields_);
  for (Index i = 0; i < fields_; ++i)
    for (Index j = 0; j < fields_; ++j) block(i, j) = (*this)(i, j).symbol(mode);
  return block;
}

Eigen::MatrixXd BlockStencil::matrix(const Grid& grid) const {
  const Index n = grid.unknowns();
  Eigen::MatrixXd a(fields_ * n, fields_ * n);
  for (Index i = 0; i < fields_; ++i)
    for (Index j = 0; j < fields_; ++j) a.block(i * n, j * n, n, n) = (*this)(i, j).matrix(grid);
  return a;
}

SparseMatrix BlockStencil::sparse_matrix(const Grid& grid) const {
  const Index n = grid.unknowns();
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < fields_; ++i)
    for (Index j = 0; j < fields_; ++j) {
      const SparseMatrix a = (*this)(i, j).sparse_matrix(grid);
      require_entries(static_cast<double>(entries.size()) + static_cast<double>(a.nonZeros()));
      for (Index column = 0; column < n; ++column)
        for (SparseMatrix::InnerIterator entry(a, column); entry; ++entry)
          entries.emplace_back(static_cast<int>(i * n + entry.row()), static_cast<int>(j * n + column), entry.value());
    }
  SparseMatrix all(fields_ * n, fields_ * n);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

}  // namespace seiche
