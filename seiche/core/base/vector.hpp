// Vectors of the state space, and what an index into them is.
#pragma once

#include <seiche/allocation.hpp>

#include <Eigen/Core>
#include <limits>

namespace seiche {

using Vector = Eigen::VectorXd;
using Index = Eigen::Index;

static_assert(
    EIGEN_DEFAULT_ALIGN_BYTES == vector_alignment && EIGEN_MALLOC_ALREADY_ALIGNED == vectors_by_malloc,
    "This program would free vectors of Eigen in another way than the Seiche library allocates them. Compile "
    "what includes Seiche for the same instructions as the library, without -march=native or -mavx where that "
    "had none, and with what `pkg-config --cflags seiche` prints or CMake's Seiche::seiche brings.");

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

inline double square(double x) { return x * x; }

}  // namespace seiche
