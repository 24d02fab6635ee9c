// The pictures of a finished ensemble, drawn into its folder.
#pragma once

#include <seiche/figure/run_pictures.hpp>

#include <cstddef>
#include <filesystem>

namespace seiche {

// Whether case.toml in `directory` is that of an ensemble. Throws Error where it is there and cannot be read.
bool holds_ensemble(const std::filesystem::path& directory);

// figures/energy: the mean of H over time, what 90 % of the members have, and all of them; figures/members_<parameter>
// for each parameter that varies: what a member keeps of its energy. Returns how many pictures these are. Throws Error
// where the tables are missing or damaged, and where draw_curves does.
std::size_t draw_ensemble(const std::filesystem::path& directory, const PictureOptions& options);

}  // namespace seiche
