// The pictures of an ensemble, drawn into its folder.
#pragma once

#include <seiche/figure/curve_picture.hpp>
#include <seiche/figure/run_pictures.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

// Whether case.toml in `directory` is that of an ensemble. Throws Error where it is there and cannot be read.
bool holds_ensemble(const std::filesystem::path& directory);

struct EnsemblePictures {
  std::vector<CurvePicture> list;
  std::string warning;  // "2 of 5 members failed", "still running, up to t = 3", or ""
  bool is_running = false, has_ended = true;
};

// energy: the mean of H over time, what 90 % of the members have, and all of them; members_<parameter> for each
// parameter that varies: what a member keeps of its energy, where the ensemble has ended. Throws Error where tables are
// missing or damaged.
EnsemblePictures ensemble_pictures(const std::filesystem::path& directory);

// Into figures/. What an earlier call drew goes where everything is drawn. Throws Error as draw_curves does.
void draw_ensemble(EnsemblePictures& pictures, const std::filesystem::path& directory, const PictureOptions& options);

}  // namespace seiche
