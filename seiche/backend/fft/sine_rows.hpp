// The sine transform of a row by Fourier transforms of its halves.
#pragma once

#include <seiche/backend/fft/grid_rows.hpp>

#include <memory>

namespace seiche {

std::unique_ptr<RowTransform> sine_row(Index intervals, bool measure);  // one row between two ends where u = 0

}  // namespace seiche
