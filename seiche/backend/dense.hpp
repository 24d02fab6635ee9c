// The reference backend: full matrices, physical coordinates. Slow, short, right.
#pragma once

#include <seiche/core/system.hpp>

namespace seiche {

System dense_system(const Problem& problem, const BackendOptions& options = {});

}  // namespace seiche
