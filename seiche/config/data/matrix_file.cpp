#include <seiche/config/data/matrix_file.hpp>
#include <seiche/config/data/matrix_market.hpp>
#include <seiche/config/data/petsc_binary.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/memory_limit.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/input_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace seiche {

SparseMatrix read_matrix(const std::filesystem::path& file, bool* repeats) {
  return is_petsc_binary(file) ? read_petsc_binary(file, repeats) : read_matrix_market(file, repeats);
}

MatrixSizes matrix_sizes(const std::filesystem::path& file) {
  return is_petsc_binary(file) ? petsc_binary_sizes(file) : matrix_market_sizes(file);
}

std::ifstream open_matrix_file(const std::filesystem::path& file) {
  const std::string name = shortened_path(file.string()), complaint = complaint_about_file(file);
  if (!complaint.empty()) throw Error("{} {}", name, complaint);
  std::ifstream input(file, std::ios::binary);
  if (!input) throw Error("{} cannot be read", name);
  return input;
}

std::string complaint_about_sizes(Index rows, Index columns) {
  constexpr Index most = std::numeric_limits<int>::max();
  if (rows < 1 || columns < 1 || rows > most || columns > most)
    return fmt::format("a matrix of {} × {} is not possible", rows, columns);
  constexpr double bytes_per_row = 3 * 90;  // of S, M, D and what is made of them, however few entries: measured
  const double needed = bytes_per_row * static_cast<double>(std::max(rows, columns));
  if (needed <= memory_limit()) return "";
  return fmt::format("a matrix of {} × {} needs at least {:.3g} bytes, but only {:.3g} are available", rows, columns,
                     needed, memory_limit());
}

}  // namespace seiche
