// The pictures of a finished run, drawn into its folder.
#pragma once

#include <seiche/figure/film.hpp>
#include <seiche/study/energy_history.hpp>

#include <string>
#include <vector>

namespace seiche {

struct RunPicture {
  std::string stem;  // figures/<stem>.png for a light ground, figures/<stem>_dark.png for a dark one
  std::string title, caption;
};

struct RunPictures {
  std::vector<RunPicture> list;
  std::vector<std::string> formats;
  std::vector<Film> films;
};

struct PictureOptions {
  std::vector<std::string> formats = {"png", "pdf", "svg"};  // png is always among them: the report shows it
  bool film = true;
  std::vector<std::string> film_fields = {};  // empty: the first
};

// Throws Error where DIR/figures, or the folder of frames in it, is a link, through which pictures would get elsewhere.
void require_own_figures(const std::filesystem::path& directory);

// Throws Error where require_own_figures does, where gnuplot is missing or fails, and where solution.h5 cannot be read;
// then what an earlier call drew stays, and goes only where everything is drawn.
RunPictures draw_run(const RunFiles& run, const EnergyHistory& history, const PictureOptions& options = {});

// What draw_run left in the figures of an earlier run, so that nothing old stands beside new data; other files stay.
void remove_pictures(const std::filesystem::path& directory);

}  // namespace seiche
