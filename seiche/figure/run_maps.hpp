// The coloured maps that a finished run gives: the solution over x and t, on planes, and on planes through boxes.
#pragma once

#include <seiche/figure/plot/map_plot.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/study/run_files.hpp>

#include <string>
#include <vector>

namespace seiche {

struct MapPicture {
  std::string caption;
  MapPlot plot;
};

// Lines and rows of points: every field over x and t. Planes: at four times. Boxes: the middle planes at the first and
// the last time.
std::vector<MapPicture> solution_maps(const RunFiles& run, const SolutionReader& solution);

// Of a plane: a field at time k as one picture of a film; `colours` are those of the whole film.
MapPlot film_frame(const RunFiles& run, const SolutionReader& solution, Index field, Index k,
                   const ColourScale& colours);
// " The scale ends at …", where it ends before the largest value; else "".
std::string scale_remark(const ColourScale& scale);
// The smallest and the largest value of a field at some times, as a scale for all of them.
ColourScale common_scale(const SolutionReader& solution, Index field, const std::vector<Index>& times);

}  // namespace seiche
