// Sparse matrices from files: of Matrix Market, or as PETSc writes them.
#pragma once

#include <seiche/core/base/sparse_matrix.hpp>

#include <filesystem>
#include <fstream>
#include <string>

namespace seiche {

struct MatrixSizes {
  Index rows = 0, columns = 0;
  Index entries = 0;  // in the file
};

// By what the file begins with. Entries at the same place add up, and `repeats` tells that there are such. Throws Error
// with the file and what is wrong with it, and before anything is allocated where its head promises more entries than
// the file can hold, or more rows than the memory.
SparseMatrix read_matrix(const std::filesystem::path& file, bool* repeats = nullptr);

// What the head of the file says; nothing behind it is read.
MatrixSizes matrix_sizes(const std::filesystem::path& file);

// Throws Error where it cannot be read to its end.
std::ifstream open_matrix_file(const std::filesystem::path& file);

// Why no matrix of so many rows and columns can be held, or "".
std::string complaint_about_sizes(Index rows, Index columns);

}  // namespace seiche
