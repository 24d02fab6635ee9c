#include <seiche/config/data/petsc_binary.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <vector>

namespace seiche {
namespace {

constexpr std::int64_t matrix_mark = 1211216, vector_mark = 1211214;
constexpr std::int64_t dense = -1;  // in the place of the number of entries

class PetscReader {
 public:
  explicit PetscReader(const std::filesystem::path& file)
      : name_(shortened_path(file.string())),
        input_(open_matrix_file(file)),
        bytes_(static_cast<double>(std::filesystem::file_size(file))) {}

  // The number that tells what follows; 0 bytes before it are those of a wide index.
  std::int64_t mark() {
    std::int64_t number = integer();
    wide_ = number == 0;
    return wide_ ? narrow() : number;
  }

  MatrixSizes sizes() {
    if (mark() == vector_mark) throw Error("{} is a vector of PETSc, and no matrix", name_);
    rows_ = integer();
    columns_ = integer();
    const std::string complaint = complaint_about_sizes(rows_, columns_);
    if (!complaint.empty()) throw Error("{}: {}", name_, complaint);
    const std::int64_t announced = integer();
    is_dense_ = announced == dense;
    if (announced < dense) throw Error("{}: {} entries are not possible", name_, announced);
    entries_ = is_dense_ ? rows_ * columns_ : announced;
    const double of_index = wide_ ? 8 : 4, of_rows = is_dense_ ? 0 : of_index * static_cast<double>(rows_);
    const double of_entry = sizeof(double) + (is_dense_ ? 0 : of_index);
    const double expected = 4 * of_index + of_rows + of_entry * static_cast<double>(entries_);
    if (bytes_ != expected)
      throw Error(
          "{} has {:.0f} bytes, and a matrix of {} × {} real numbers with {} entries has {:.0f}: one matrix is expected, of "
          "real numbers",
          name_, bytes_, rows_, columns_, entries_, expected);
    return {rows_, columns_, entries_};
  }

  SparseMatrix read(bool* repeats) {
    sizes();
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(static_cast<std::size_t>(is_dense_ ? 0 : entries_));
    if (is_dense_) {
      for (Index row = 0; row < rows_; ++row)
        for (Index column = 0; column < columns_; ++column)
          if (const double x = value(row, column); x != 0)
            triplets.emplace_back(static_cast<int>(row), static_cast<int>(column), x);
    } else {
      read_entries(triplets);
    }
    SparseMatrix a(rows_, columns_);
    a.setFromTriplets(triplets.begin(), triplets.end());
    if (repeats != nullptr) *repeats = a.nonZeros() < std::ssize(triplets);
    return a;
  }

 private:
  // Numbers are stored with their highest byte first.
  template <int bytes>
  std::uint64_t raw() {
    char text[bytes] = {};
    if (!input_.read(text, bytes)) throw Error("{} ends too early", name_);
    std::uint64_t number = 0;
    for (const char c : text) number = number << 8U | static_cast<unsigned char>(c);
    return number;
  }
  std::int64_t narrow() { return static_cast<std::int32_t>(raw<4>()); }
  std::int64_t integer() { return wide_ ? static_cast<std::int64_t>(raw<8>()) : narrow(); }

  double value(Index row, Index column) {
    const auto x = std::bit_cast<double>(raw<8>());
    if (!std::isfinite(x)) throw Error("{}: the entry ({}, {}) is not finite", name_, row + 1, column + 1);
    return x;
  }

  void read_entries(std::vector<Eigen::Triplet<double>>& triplets) {
    std::vector<Index> lengths(static_cast<std::size_t>(rows_)), columns(static_cast<std::size_t>(entries_));
    Index sum = 0;
    for (Index& length : lengths) {
      length = integer();
      if (length < 0 || length > entries_) throw Error("{}: a row of {} entries is not possible", name_, length);
      sum += length;
    }
    if (sum != entries_) throw Error("{}: the rows have {} entries together, and {} are there", name_, sum, entries_);
    for (Index& column : columns) {
      column = integer();
      if (column < 0 || column >= columns_)
        throw Error("{}: there is no column {} in a matrix of {} × {}", name_, column + 1, rows_, columns_);
    }
    std::size_t at = 0;
    for (Index row = 0; row < rows_; ++row)
      for (Index k = 0; k < lengths[static_cast<std::size_t>(row)]; ++k, ++at)
        triplets.emplace_back(static_cast<int>(row), static_cast<int>(columns[at]), value(row, columns[at]));
  }

  std::string name_;
  std::ifstream input_;
  double bytes_;
  bool wide_ = false, is_dense_ = false;
  Index rows_ = 0, columns_ = 0, entries_ = 0;
};

}  // namespace

bool is_petsc_binary(const std::filesystem::path& file) {
  try {
    const std::int64_t mark = PetscReader(file).mark();
    return mark == matrix_mark || mark == vector_mark;
  } catch (const Error&) {
    return false;
  }
}

SparseMatrix read_petsc_binary(const std::filesystem::path& file, bool* repeats) {
  return PetscReader(file).read(repeats);
}

MatrixSizes petsc_binary_sizes(const std::filesystem::path& file) { return PetscReader(file).sizes(); }

}  // namespace seiche
