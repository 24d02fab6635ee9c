#include <seiche/backend/grid/halo_potential.hpp>
#include <seiche/petsc/divided_points.hpp>

#include <algorithm>
#include <vector>

namespace seiche {

namespace {

// V of the values of all processes: its value is that of the first one alone, since values are added up.
class GatheredPotential final : public PointwisePotential {
 public:
  GatheredPotential(std::shared_ptr<const PointwisePotential> whole, const FieldPart& part, const Ranks& ranks)
      : whole_(std::move(whole)), part_(part), ranks_(ranks) {
    const int processes = ranks.here().count;
    const double here = static_cast<double>(part.size);
    std::vector<double> sizes(static_cast<std::size_t>(processes));
    ranks.gather({&here, 1}, std::vector<Index>(static_cast<std::size_t>(processes), 1), sizes);
    for (const double size : sizes) counts_.push_back(fields() * static_cast<Index>(size));
    for (Vector* v : {&received_, &a_, &b_, &slope_}) v->resize(fields() * part.of);
  }

  Index fields() const override { return whole_->fields(); }
  double value(std::span<const double> u) const override { return on_first(whole_->value(all(u, a_))); }
  ValueAndMagnitude value_and_magnitude(std::span<const double> u) const override {
    const ValueAndMagnitude v = whole_->value_and_magnitude(all(u, a_));
    return {.value = on_first(v.value), .magnitude = on_first(v.magnitude)};
  }
  double value_and_gradient(std::span<const double> u, std::span<double> gradient) const override {
    const double v = whole_->value_and_gradient(all(u, a_), span_of(slope_));
    take(gradient);
    return on_first(v);
  }
  void gradient_round_off(std::span<const double> u, std::span<double> bounds) const override {
    whole_->gradient_round_off(all(u, a_), span_of(slope_));
    take(bounds);
  }
  void mean_gradient(std::span<const double> a, std::span<const double> b, std::span<double> mean) const override {
    const std::span<const double> from = all(a, a_), to = all(b, b_);
    whole_->mean_gradient(from, to, span_of(slope_));
    take(mean);
  }
  int degree() const override { return whole_->degree(); }
  void along(std::span<const double> p, std::span<const double> q, std::span<double> coefficients) const override {
    const std::span<const double> from = all(p, a_), direction = all(q, b_);
    whole_->along(from, direction, coefficients);
    for (double& c : coefficients) c = on_first(c);
  }
  int homogeneity() const override { return whole_->homogeneity(); }
  bool grows_outward() const override { return whole_->grows_outward(); }
  bool grows_outward_from(Index first) const override { return whole_->grows_outward_from(first); }

 private:
  double on_first(double value) const { return ranks_.here().index == 0 ? value : 0.0; }

  // Field after field, as one process has them.
  std::span<const double> all(std::span<const double> u, Vector& values) const {
    ranks_.gather(u, counts_, span_of(received_));
    Index from = 0, first = 0;
    for (const Index count : counts_) {
      const Index points = count / fields();
      for (Index f = 0; f < fields(); ++f)
        values.segment(f * part_.of + first, points) = received_.segment(from + f * points, points);
      from += count;
      first += points;
    }
    return span_of(static_cast<const Vector&>(values));
  }
  void take(std::span<double> out) const {
    for (Index f = 0; f < fields(); ++f)
      std::copy_n(slope_.data() + f * part_.of + part_.first, part_.size, out.data() + f * part_.size);
  }

  std::shared_ptr<const PointwisePotential> whole_;
  FieldPart part_;
  const Ranks& ranks_;
  std::vector<Index> counts_;  // of u on each process
  mutable Vector received_, a_, b_, slope_;
};

// So large that what is added up between two sums of a process outweighs them.
Units units_of_points(Index points) {
  return {.planes = points, .size = std::max<Index>(2, points / 4096), .of = points};
}

}  // namespace

DividedPoints::DividedPoints(Index fields, Index points, const Rank& here)
    : fields_(fields), points_(points), here_(here), units_(units_of_points(points)), part_(of(here.index)) {}

FieldPart DividedPoints::of(int rank) const {
  if (here_.count == 1) return {.size = points_, .units = {}, .first = 0, .of = points_};
  const Slab slab = slab_of(units_, {rank, here_.count});
  return {.size = slab.planes,
          .units = seiche::units_of(units_, {rank, here_.count}),
          .first = slab.first,
          .of = points_};
}

PetscInt DividedPoints::row(Index component) const {
  const Index field = component / points_, point = component % points_;
  for (int rank = 0; rank < here_.count; ++rank) {
    const FieldPart part = of(rank);
    if (point < part.first + part.size)
      return static_cast<PetscInt>(fields_ * part.first + field * part.size + point - part.first);
  }
  return -1;
}

Vector DividedPoints::here(const Vector& whole) const {
  Vector part(local_size());
  for (Index f = 0; f < fields_; ++f)
    part.segment(f * part_.size, part_.size) = whole.segment(f * points_ + part_.first, part_.size);
  return part;
}

void DividedPoints::make(const SparseMatrix& whole, MPI_Comm communicator, OwnedMat& matrix) const {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = whole;
  std::vector<PetscInt> rows(static_cast<std::size_t>(whole.rows()));
  for (Index i = 0; i < whole.rows(); ++i) rows[static_cast<std::size_t>(i)] = row(i);
  const auto local = static_cast<PetscInt>(local_size());
  require(MatCreate(communicator, matrix.make()));
  require(MatSetSizes(matrix, local, local, PETSC_DETERMINE, PETSC_DETERMINE));
  require(MatSetType(matrix, MATAIJ));
  std::vector<PetscInt> widths;
  const auto visit_rows_here = [&](const auto& visit) {
    for (Index f = 0; f < fields_; ++f)
      for (Index i = part_.first; i < part_.first + part_.size; ++i) visit(f * points_ + i);
  };
  visit_rows_here([&](Index i) { widths.push_back(static_cast<PetscInt>(by_rows.row(i).nonZeros())); });
  require(MatXAIJSetPreallocation(matrix, 1, widths.data(), widths.data(), nullptr, nullptr));
  visit_rows_here([&](Index i) {
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(by_rows, i); entry; ++entry) {
      const PetscInt at = rows[static_cast<std::size_t>(i)], column = rows[static_cast<std::size_t>(entry.col())];
      const double value = entry.value();
      require(MatSetValues(matrix, 1, &at, 1, &column, &value, INSERT_VALUES));
    }
  });
  require(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  require(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
}

std::shared_ptr<const PointwisePotential> divided_potential(std::shared_ptr<const PointwisePotential> whole,
                                                            const FieldPart& part, const Ranks& ranks) {
  if (!whole || ranks.here().count == 1) return whole;
  if (!whole->is_pointwise()) {
    if (auto with_halo = halo_potential(*whole, part, ranks)) return with_halo;
    return std::make_shared<GatheredPotential>(std::move(whole), part, ranks);
  }
  auto there = whole->at_points(part.first, part.size);
  return there ? there : whole;
}

}  // namespace seiche
