#include <seiche/petsc/solver/petsc_matrices.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

// The same number on all processes.
template <class Operation>
double joint(Mat a, double local, Operation operation) {
  MPI_Allreduce(MPI_IN_PLACE, &local, 1, MPI_DOUBLE, operation, communicator_of(a));
  return local;
}

}  // namespace

void BorrowedVec::set_layout(MPI_Comm communicator, Index local_size) {
  require(
      VecCreateMPIWithArray(communicator, 1, static_cast<PetscInt>(local_size), PETSC_DETERMINE, nullptr, vec_.make()));
}

Vec BorrowedVec::of(std::span<const double> values) const {
  require(VecResetArray(vec_));
  require(VecPlaceArray(vec_, values.data()));
  return vec_;
}

PetscProduct::PetscProduct(Mat a) {
  a_.share(a);
  for (BorrowedVec* v : {&x_, &y_}) v->set_layout(communicator_of(a), local_rows(a));
}

void PetscProduct::apply(std::span<const double> x, std::span<double> y) const {
  require(MatMult(a_, x_.of(x), y_.of(y)));
}

MPI_Comm communicator_of(Mat a) { return PetscObjectComm(reinterpret_cast<PetscObject>(a)); }

Index local_rows(Mat a) {
  PetscInt rows = 0;
  require(MatGetLocalSize(a, &rows, nullptr));
  return rows;
}

PetscInt first_row(Mat a) {
  PetscInt first = 0;
  require(MatGetOwnershipRange(a, &first, nullptr));
  return first;
}

void multiply(Mat a, Mat b, OwnedMat& product) {
  require(MatMatMult(a, b, MAT_INITIAL_MATRIX, PETSC_DEFAULT, product.make()));
}

void add(double factor, Mat b, Mat a) { require(MatAXPY(a, factor, b, DIFFERENT_NONZERO_PATTERN)); }

void make_symmetric_part(Mat a, OwnedMat& part) {
  require(MatTranspose(a, MAT_INITIAL_MATRIX, part.make()));
  add(1, a, part);
  require(MatScale(part, 0.5));
}

void visit_rows(Mat a,
                FunctionRef<void(Index row, std::span<const PetscInt> columns, std::span<const double> values)> visit) {
  const PetscInt first = first_row(a);
  for (PetscInt row = first; row < first + local_rows(a); ++row) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    require(MatGetRow(a, row, &count, &columns, &values));
    visit(row, {columns, static_cast<std::size_t>(count)}, {values, static_cast<std::size_t>(count)});
    require(MatRestoreRow(a, row, &count, &columns, &values));
  }
}

void make_absolute(Mat a, OwnedMat& absolute) {
  require(MatDuplicate(a, MAT_COPY_VALUES, absolute.make()));
  std::vector<double> sizes;
  visit_rows(a, [&](Index row, std::span<const PetscInt> columns, std::span<const double> values) {
    sizes.assign(values.begin(), values.end());
    for (double& size : sizes) size = std::abs(size);
    const auto at = static_cast<PetscInt>(row);
    require(MatSetValues(absolute, 1, &at, static_cast<PetscInt>(columns.size()), columns.data(), sizes.data(),
                         INSERT_VALUES));
  });
  require(MatAssemblyBegin(absolute, MAT_FINAL_ASSEMBLY));
  require(MatAssemblyEnd(absolute, MAT_FINAL_ASSEMBLY));
}

bool is_zero(Mat a) {
  PetscReal norm = 0;
  require(MatNorm(a, NORM_INFINITY, &norm));
  return norm == 0;
}

bool has_entries(Mat a, Potential::Support rows) {
  const PetscInt first = first_row(a);
  bool has = false;
  visit_rows(a, [&](Index row, std::span<const PetscInt>, std::span<const double> values) {
    const Index here = row - first;
    if (here < rows.begin || here >= rows.begin + rows.size) return;
    for (const double value : values) has = has || value != 0;
  });
  return has;
}

double spectral_radius_bound(Mat a) {
  OwnedMat square, cube;
  multiply(a, a, square);
  multiply(square, a, cube);
  const auto norm = [](Mat of) {
    PetscReal value = 0;
    require(MatNorm(of, NORM_1, &value));
    return static_cast<double>(value);
  };
  return std::min({norm(a), std::sqrt(norm(square)), std::cbrt(norm(cube))});
}

// dᵢ with the sums of |aᵢⱼ| dⱼ/dᵢ over a row and a column nearly the same, all at once and by half of what is missing:
// one after the other would need those of other processes.
Vector balancing_scales(Mat a) {
  constexpr int most_sweeps = 40;
  constexpr double most_doublings = 24;  // a reducible matrix has no balance, and its scales would drift away
  OwnedMat sizes;
  make_absolute(a, sizes);
  BorrowedVec in, out;
  const Index n = local_rows(a);
  for (BorrowedVec* v : {&in, &out}) v->set_layout(communicator_of(a), n);
  Vector exponents = Vector::Zero(n), d(n), inverse(n), row(n), column(n), diagonal(n);
  require(MatGetDiagonal(sizes, out.of(span_of(diagonal))));
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    d = exponents.unaryExpr([](double x) { return std::exp2(x); });
    inverse = d.cwiseInverse();
    require(MatMult(sizes, in.of(span_of(d)), out.of(span_of(row))));
    require(MatMultTranspose(sizes, in.of(span_of(inverse)), out.of(span_of(column))));
    row = row.cwiseProduct(inverse) - diagonal;
    column = column.cwiseProduct(d) - diagonal;
    for (Index i = 0; i < n; ++i)
      if (row[i] > 0 && column[i] > 0)
        exponents[i] = std::clamp(exponents[i] + std::log2(row[i] / column[i]) / 4, -most_doublings, most_doublings);
  }
  return exponents.unaryExpr([](double x) { return std::exp2(std::round(x)); });
}

bool is_nonnegative(Mat a, double margin) {
  PetscReal size = 0;
  require(MatNorm(a, NORM_INFINITY, &size));
  const double wanted = margin * size;
  double least = std::numeric_limits<double>::infinity();  // over all rows, of the diagonal less the sizes of the rest
  double least_diagonal = least;
  visit_rows(a, [&](Index row, std::span<const PetscInt> columns, std::span<const double> values) {
    double bound = 0;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      bound += columns[k] == row ? values[k] : -std::abs(values[k]);
      if (columns[k] == row) least_diagonal = std::min(least_diagonal, values[k]);
    }
    least = std::min(least, bound);
  });
  if (joint(a, least, MPI_MIN) >= wanted) return true;
  if (joint(a, least_diagonal, MPI_MIN) < wanted) return false;
  // Sylvester's law: LDLᵀ has as many negative pivots as a has negative eigenvalues. Zero ones are moved off zero.
  OwnedMat shifted, factors;
  require(MatDuplicate(a, MAT_COPY_VALUES, shifted.make()));
  require(MatSetOption(shifted, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));  // of rows without a diagonal entry
  require(MatShift(shifted, 1e-12 * size - wanted));
  require(MatSetOption(shifted, MAT_SYMMETRIC, PETSC_TRUE));
  require(MatGetFactor(shifted, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factors.make()));
  require(MatMumpsSetIcntl(factors, 13, 1));  // no part of the factors is taken whose pivots are not counted …
  require(MatMumpsSetIcntl(factors, 24, 1));  // … and those near zero are found
  MatFactorInfo info;
  require(MatFactorInfoInitialize(&info));
  require(MatCholeskyFactorSymbolic(factors, shifted, nullptr, &info));
  require(MatCholeskyFactorNumeric(factors, shifted, &info));
  PetscInt negative = 0, zero = 0, positive = 0;
  require(MatGetInertia(factors, &negative, &zero, &positive));
  return negative == 0;
}

SparseMatrix sparse_matrix(Mat a) {
  std::vector<Eigen::Triplet<double>> entries;
  visit_rows(a, [&](Index row, std::span<const PetscInt> columns, std::span<const double> values) {
    for (std::size_t k = 0; k < columns.size(); ++k) entries.emplace_back(static_cast<int>(row), columns[k], values[k]);
  });
  SparseMatrix matrix(local_rows(a), local_rows(a));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void make_shifted(Mat B, double h, std::complex<double> p, OwnedMat& shifted) {
  const PetscInt parts = p.imag() == 0 ? 1 : 2;
  const auto rows = static_cast<PetscInt>(local_rows(B)) * parts;
  require(MatCreate(communicator_of(B), shifted.make()));
  require(MatSetSizes(shifted, rows, rows, PETSC_DETERMINE, PETSC_DETERMINE));
  require(MatSetType(shifted, MATAIJ));
  std::vector<PetscInt> widths;  // at most
  visit_rows(B, [&](Index, std::span<const PetscInt> columns, std::span<const double>) {
    widths.insert(widths.end(), static_cast<std::size_t>(parts), static_cast<PetscInt>(columns.size()) + 2);
  });
  require(MatXAIJSetPreallocation(shifted, 1, widths.data(), widths.data(), nullptr, nullptr));
  const auto set = [&](PetscInt row, PetscInt column, double value) {
    require(MatSetValues(shifted, 1, &row, 1, &column, &value, ADD_VALUES));
  };
  visit_rows(B, [&](Index index, std::span<const PetscInt> columns, std::span<const double> values) {
    for (PetscInt part = 0; part < parts; ++part) {
      const PetscInt row = static_cast<PetscInt>(index) * parts + part;
      for (std::size_t k = 0; k < columns.size(); ++k) set(row, columns[k] * parts + part, h * values[k]);
      set(row, row, -p.real());
      if (parts == 2) set(row, row + (part == 0 ? 1 : -1), part == 0 ? p.imag() : -p.imag());
    }
  });
  require(MatAssemblyBegin(shifted, MAT_FINAL_ASSEMBLY));
  require(MatAssemblyEnd(shifted, MAT_FINAL_ASSEMBLY));
}

}  // namespace seiche
