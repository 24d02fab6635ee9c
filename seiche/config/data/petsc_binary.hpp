// Matrices in PETSc's binary format: what MatView writes to a binary viewer, and PetscBinaryIO.py, for MATAIJ and
// MATDENSE of real numbers, with indices of 32 or 64 bits (manual page of MatLoad).
#pragma once

#include <seiche/config/data/matrix_file.hpp>

namespace seiche {

bool is_petsc_binary(const std::filesystem::path& file);  // begins like one; false where it cannot be read

// As read_matrix and matrix_sizes. A file of complex numbers, and one with more than a matrix, is refused.
SparseMatrix read_petsc_binary(const std::filesystem::path& file, bool* repeats = nullptr);
MatrixSizes petsc_binary_sizes(const std::filesystem::path& file);

}  // namespace seiche
