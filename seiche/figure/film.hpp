// The film of a run in the plane, on light and on dark ground: one PNG per time, and an MP4 or WebM of them where
// ffmpeg is there.
#pragma once

#include <seiche/output/solution_reader.hpp>
#include <seiche/study/run_files.hpp>

#include <string>

namespace seiche {

struct Film {
  std::string field;       // its name
  std::size_t frames = 0;  // figures/film/u_0001.png and u_0001_dark.png …; none where the solution is not of the plane
  // "figures/film_u.mp4", "figures/film_u_dark.mp4" or .webm, from the folder of the run; "" without ffmpeg
  std::string file, dark_file;
  std::string remark;  // of its scale of colours, or ""
  std::string note;    // why there is no file
};

// Into `figures`, wherever that lies. Throws Error where gnuplot is missing or fails.
Film draw_film(const RunFiles& run, const SolutionReader& solution, Index field, const std::filesystem::path& figures);

}  // namespace seiche
