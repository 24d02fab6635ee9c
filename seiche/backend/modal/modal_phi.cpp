#include <seiche/backend/modal/modal_phi.hpp>
#include <seiche/backend/modal/modal_propagator.hpp>
#include <seiche/backend/modal/mode_phi.hpp>
#include <seiche/backend/modal/mode_table.hpp>
#include <seiche/backend/phi/force_map.hpp>
#include <seiche/backend/phi/phi_functions.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <array>
#include <complex>
#include <type_traits>

namespace seiche {
namespace {

using Block = Eigen::MatrixXcd;

struct Symbols {
  Modes modes;
  BlockStencil S, M, D0;

  template <class Matrix>
  static Matrix block_of(const BlockStencil& stencil, const Mode& mode) {
    const Index m = stencil.fields();
    Matrix block(m, m);
    for (Index i = 0; i < m; ++i) {
      for (Index j = 0; j < m; ++j) {
        const std::complex<double> c = stencil(i, j).symbol(mode);
        if constexpr (std::is_same_v<typename Matrix::Scalar, double>) {
          block(i, j) = c.real();
        } else {
          block(i, j) = c;
        }
      }
    }
    return block;
  }

  template <class Matrix>
  LinearBlocks<Matrix> blocks(Index k) const {  // real where they can be
    const Mode mode = modes[k];
    return {block_of<Matrix>(S, mode), block_of<Matrix>(M, mode), block_of<Matrix>(D0, mode)};
  }

  bool are_real() const { return S.has_real_symbol() && M.has_real_symbol() && D0.has_real_symbol(); }
};

// The columns that the sums of a map take: the fields of z, then those of each force.
class Columns {
 public:
  Columns(const PhiRows& rows, const ModalExtent& extent) : slots_(extent.slots()) {
    const bool gradients = rows.kind == PhiRows::Forces::gradients;
    if (rows.of_state)
      for (Index f = 0; f < extent.fields; ++f) columns_.push_back({0, f});
    for (Index j = 0; j < rows.forces; ++j)
      for (Index f = gradients ? extent.first : 0; f < (gradients ? extent.first + extent.count : extent.fields); ++f)
        columns_.push_back({j + 1, f});
    pointers_.resize(columns_.size());
  }

  Index size() const { return static_cast<Index>(columns_.size()); }
  std::span<const PhiColumn> all() const { return columns_; }
  const PhiColumn& operator[](Index j) const { return columns_[static_cast<std::size_t>(j)]; }

  std::span<const double* const> of(const Vector& z, std::span<const Vector> forces) const {
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      const auto& [block, field] = columns_[j];
      const Vector& v = block == 0 ? z : forces[static_cast<std::size_t>(block) - 1];
      pointers_[j] = v.data() + field * slots_;
    }
    return pointers_;
  }

 private:
  Index slots_;
  std::vector<PhiColumn> columns_;
  mutable std::vector<const double*> pointers_;
};

class ModalPhiMap final : public PhiMap {
 public:
  ModalPhiMap(const PhiRows& rows, const ModalExtent& extent)
      : columns_(rows, extent),
        first_(rows.outputs == PhiRows::Outputs::support ? extent.first : 0),
        count_(rows.outputs == PhiRows::Outputs::support ? extent.count : extent.fields),
        slots_(extent.slots()),
        threads_(extent.threads),
        table_(extent.layout, extent.modes, static_cast<Index>(rows.rows.size()) * count_, columns_.size()) {
    out_.resize(rows.rows.size() * static_cast<std::size_t>(count_));
  }

  void fill(const PhiRows& rows, const ModeBlockArrays& blocks, double h) {
    fill_sums(blocks, rows, h, columns_.all(), first_, count_, table_);
  }

  template <class Matrix>
  void fill(const PhiRows& rows, const Symbols& symbols, double h) {
    for (Index k = 0; k < symbols.modes.count(); ++k) {
      const LinearBlocks<Matrix> mode = symbols.blocks<Matrix>(k);
      PhiRowBlocks<Matrix> blocks(rows, mode, h);
      for (std::size_t i = 0; i < rows.rows.size(); ++i) {
        const std::vector<Matrix>& row = blocks.of(rows.rows[i]);
        for (Index f = 0; f < count_; ++f)
          for (Index j = 0; j < columns_.size(); ++j)
            table_.set(k, static_cast<Index>(i) * count_ + f, j,
                       row[static_cast<std::size_t>(columns_[j].block)](first_ + f, columns_[j].field));
      }
    }
  }

  void apply(const Vector& z, std::span<const Vector> forces, std::span<Vector> out) const override {
    std::size_t i = 0;
    for (Vector& v : out)
      for (Index f = 0; f < count_; ++f) out_[i++] = v.data() + (first_ + f) * slots_;
    table_.apply(columns_.of(z, forces), out_, threads_);
  }

 private:
  Columns columns_;
  Index first_, count_, slots_;
  int threads_;
  ModeTable table_;
  mutable std::vector<double*> out_;
};

class ModalPhiForms final : public PhiForms {
 public:
  ModalPhiForms(std::span<const PhiEvaluator::Form> forms, const ModalExtent& extent, const Space& space)
      : columns_(forms.front().rows, extent),
        threads_(extent.threads),
        forms_(extent.layout, extent.modes, static_cast<Index>(forms.size()), columns_.size(), space) {}

  void fill(std::span<const PhiEvaluator::Form> forms, const ModeBlockArrays& blocks, double h) {
    fill_forms(blocks, forms, h, columns_.all(), forms_);
  }

  template <class Matrix>
  void fill(std::span<const PhiEvaluator::Form> forms, const Symbols& symbols, double h) {
    Matrix row(symbols.S.fields(), columns_.size());
    for (Index k = 0; k < symbols.modes.count(); ++k) {
      const LinearBlocks<Matrix> mode = symbols.blocks<Matrix>(k);
      const Matrix Q = dissipation_matrix<Matrix>(mode.S, mode.M, mode.D0);
      for (std::size_t l = 0; l < forms.size(); ++l) {
        PhiRowBlocks<Matrix> blocks(forms[l].rows, mode, h);
        Matrix gram = Matrix::Zero(columns_.size(), columns_.size());
        for (std::size_t i = 0; i < forms[l].rows.rows.size(); ++i) {
          const std::vector<Matrix>& of_row = blocks.of(forms[l].rows.rows[i]);
          for (Index j = 0; j < columns_.size(); ++j)
            row.col(j) = of_row[static_cast<std::size_t>(columns_[j].block)].col(columns_[j].field);
          gram += forms[l].coefficients[i] * congruence(Q, row);
        }
        if (forms[l].minus_integral) gram -= integral_of_dissipation<Matrix>(forms[l].rows, mode, h);
        for (Index i = 0; i < columns_.size(); ++i)
          for (Index j = i; j < columns_.size(); ++j) forms_.set(k, static_cast<Index>(l), i, j, gram(i, j));
      }
    }
  }

  void apply(const Vector& z, std::span<const Vector> forces, std::span<double> values) const override {
    forms_.apply(columns_.of(z, forces), values, threads_);
  }

 private:
  // The form of ∫Q, in the columns.
  template <class Matrix>
  Matrix integral_of_dissipation(const PhiRows& rows, const LinearBlocks<Matrix>& mode, double h) const {
    const Index m = mode.S.rows();
    Matrix z_and_n = Matrix::Zero(2 * m, columns_.size());
    for (Index j = 0; j < columns_.size(); ++j) {
      if (columns_[j].block == 0)
        z_and_n(columns_[j].field, j) = 1;
      else if (rows.kind == PhiRows::Forces::gradients)
        z_and_n.col(j).tail(m) = mode.S.col(columns_[j].field);
      else
        z_and_n(m + columns_[j].field, j) = 1;
    }
    return congruence(flow_dissipation(mode, h), z_and_n);
  }

  Columns columns_;
  int threads_;
  ModeForms forms_;
};

// body<Matrix>() with the type of the blocks, where they are not of those that are computed eight at a time.
template <class Body>
auto with_block_type(const Symbols& symbols, const Body& body) {
  return symbols.are_real() ? body.template operator()<Eigen::MatrixXd>()
                            : body.template operator()<Eigen::MatrixXcd>();
}

class ModalPhi final : public PhiEvaluator {
 public:
  bool has_tables() const override { return true; }
  double rate() const override { return rate_; }

  ModalPhi(const ModalOperators& o, const Space& space)
      : space_(space),
        symbols_{Modes(o.grid), o.S, o.M, o.D0},
        extent_{.fields = o.S.fields(),
                .modes = symbols_.modes.count(),
                .layout = layout(),
                .first = o.first,
                .count = o.count,
                .threads = o.threads} {
    with_block_type(symbols_, [&]<class Matrix>() { fill_blocks<Matrix>(); });
    judge_dissipation();
    find_casimirs();
  }

  std::unique_ptr<PhiMap> map(const PhiRows& rows, double h) const override {
    if (fits_lanes(blocks_, rows, h)) {
      auto map = std::make_unique<ModalPhiMap>(rows, extent_);
      map->fill(rows, blocks_, h);
      return map;
    }
    return with_block_type(symbols_, [&]<class Matrix>() {
      auto map = std::make_unique<ModalPhiMap>(rows, extent_);
      map->fill<Matrix>(rows, symbols_, h);
      return map;
    });
  }

  std::unique_ptr<PhiForms> forms(std::span<const Form> forms, double h) const override {
    if (fits_lanes(blocks_, forms.front().rows, h)) {
      auto made = std::make_unique<ModalPhiForms>(forms, extent_, space_);
      made->fill(forms, blocks_, h);
      return made;
    }
    return with_block_type(symbols_, [&]<class Matrix>() {
      auto made = std::make_unique<ModalPhiForms>(forms, extent_, space_);
      made->fill<Matrix>(forms, symbols_, h);
      return made;
    });
  }

  Dissipation dissipation() const override { return dissipation_; }

  bool without_casimirs(const Vector& z, Vector& d) const override {
    if (!has_casimirs_) return false;
    d = z;
    const Index slots = extent_.slots();
    const bool pairs = extent_.layout != ModeLayout::singles;
    for (const auto& [k, projector] : casimirs_) {
      for (Index i = 0; i < extent_.fields; ++i) {
        std::complex<double> part = 0;
        for (Index j = 0; j < extent_.fields; ++j) {
          const double* at = z.data() + j * slots + (pairs ? 2 * k : k);
          part += projector(i, j) * std::complex<double>(at[0], pairs ? at[1] : 0.0);
        }
        double* at = d.data() + i * slots + (pairs ? 2 * k : k);
        at[0] -= part.real();
        if (pairs) at[1] -= part.imag();
      }
    }
    return true;
  }

 private:
  ModeLayout layout() const {
    if (!symbols_.modes.are_pairs()) return ModeLayout::singles;
    return symbols_.are_real() ? ModeLayout::real_pairs : ModeLayout::complex_pairs;
  }

  template <class Matrix>
  void fill_blocks() {
    for (Index k = 0; k < extent_.modes; ++k) {
      const LinearBlocks<Matrix> mode = symbols_.blocks<Matrix>(k);
      const Matrix L = mode.L();
      const Matrix Q = dissipation_matrix<Matrix>(mode.S, mode.M, mode.D0);
      for (Index i = 0; i < extent_.fields; ++i) {
        for (Index j = 0; j < extent_.fields; ++j) {
          blocks_.set(k, ModeBlockArrays::S, i, j, mode.S(i, j));
          blocks_.set(k, ModeBlockArrays::L, i, j, L(i, j));
          blocks_.set(k, ModeBlockArrays::Q, i, j, Q(i, j));
          blocks_.set(k, ModeBlockArrays::M, i, j, mode.M(i, j));
        }
      }
      blocks_.set_size(k, scaled_norm(L));
      rate_ = std::max(rate_, spectral_bound(L));
    }
    rate_ = space_.max(rate_);
  }

  // Damping and sym(S) must leave alone what V depends on for Q to be quadratic. Q ⪰ 0 is judged mode by mode: damping
  // may differ by many orders of magnitude from one to another.
  void judge_dissipation() {
    dissipation_ = {true, true, true};
    for (Index k = 0; k < symbols_.modes.count(); ++k) {
      const Block S = symbols_.S.symbol(symbols_.modes[k]);
      const Block twice_sym = S + S.adjoint();
      const Block D0 = symbols_.D0.symbol(symbols_.modes[k]);
      for (Index f = extent_.first; f < extent_.first + extent_.count; ++f)
        dissipation_.is_quadratic = dissipation_.is_quadratic && D0.row(f).isZero(0) && twice_sym.row(f).isZero(0);
      if (D0.isZero(0) && twice_sym.isZero(0)) continue;
      dissipation_.is_zero = false;
      const Block M = symbols_.M.symbol(symbols_.modes[k]);
      const Block Q = dissipation_matrix<Block>(S, M, D0);
      const double size = (M * D0).norm() + (M * twice_sym * M).norm();
      const Eigen::VectorXd rates = Eigen::SelfAdjointEigenSolver<Block>(Q, Eigen::EigenvaluesOnly).eigenvalues();
      dissipation_.is_nonnegative = dissipation_.is_nonnegative && rates.minCoeff() >= -1e-13 * size;
    }
    dissipation_ = {.is_quadratic = space_.all(dissipation_.is_quadratic),
                    .is_nonnegative = space_.all(dissipation_.is_nonnegative),
                    .is_zero = space_.all(dissipation_.is_zero)};
  }

  void find_casimirs() {
    double size = 0;
    for (Index k = 0; k < symbols_.modes.count(); ++k)
      size = std::max(size, symbols_.S.symbol(symbols_.modes[k]).cwiseAbs().maxCoeff());
    size = space_.max(size);
    for (Index k = 0; k < symbols_.modes.count(); ++k) {
      const Block S = symbols_.S.symbol(symbols_.modes[k]);
      // |det S| ≤ σ_min · (m · size)^{m−1}: a determinant above this has no singular value below 1e-13 · size.
      const auto m = static_cast<double>(extent_.fields);
      if (std::abs(S.determinant()) > 1e-13 * size * std::pow(m * size, m - 1)) continue;
      const Eigen::JacobiSVD<Block> svd(S, Eigen::ComputeFullV);
      Block projector = Block::Zero(extent_.fields, extent_.fields);
      for (Index i = 0; i < extent_.fields; ++i)
        if (svd.singularValues()[i] <= 1e-13 * size) projector += svd.matrixV().col(i) * svd.matrixV().col(i).adjoint();
      if (!projector.isZero(0)) casimirs_.push_back({k, projector});
    }
    has_casimirs_ = space_.any(!casimirs_.empty());
  }

  struct Casimir {
    Index mode;
    Block projector;
  };
  const Space& space_;
  Symbols symbols_;
  ModalExtent extent_;
  ModeBlockArrays blocks_{extent_.modes, extent_.fields, symbols_.are_real()};
  double rate_ = 0;
  Dissipation dissipation_;
  std::vector<Casimir> casimirs_;  // those that are here
  bool has_casimirs_ = false;
};

}  // namespace

std::unique_ptr<PhiEvaluator> modal_phi(const ModalOperators& operators, const Space& space) {
  return std::make_unique<ModalPhi>(operators, space);
}

}  // namespace seiche
