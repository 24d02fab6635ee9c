// index.html: figures, and the seconds that each integrator needs for three accuracies.
#pragma once

#include <bench/work_precision/figures.hpp>
#include <bench/work_precision/manifest.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace seiche::bench {

// Embeds the pictures that draw_figures left in directory/figures; says why where they are missing.
void write_page(const std::vector<ProblemResult>& results, const Manifest& manifest,
                const std::filesystem::path& directory, const std::string& no_figures_because);

}  // namespace seiche::bench
