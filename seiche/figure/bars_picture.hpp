// The picture of a truss.
#pragma once

#include <seiche/figure/plot/plot.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/study/run_files.hpp>

#include <optional>

namespace seiche {

// The bars of a truss at the first and the last time, where the file holds some, and no more than can be seen.
std::optional<CurvePicture> bars_picture(const RunFiles& run, const SolutionReader& solution);

}  // namespace seiche
