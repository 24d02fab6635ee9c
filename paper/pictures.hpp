// Which figures there are: four pictures per example, the two formulations of Example 2 side by side, and the side
// studies. One file per picture and format.
#pragma once

#include <paper/results.hpp>
#include <seiche/figure/curve_picture.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

// Orders, efficiency, energy, energy error. `quick` is said in the titles.
std::vector<CurvePicture> example_pictures(const ExampleResult& example, bool quick = false);
// Nothing without both formulations of Example 2.
std::optional<CurvePicture> formulations_picture(const PaperResults& results);
CurvePicture side_picture(const SideStudy& study, bool quick = false);
std::vector<CurvePicture> paper_pictures(const PaperResults& results);

// Draws all pictures into directory/figures, those of a quick run as PNG alone; returns them with their captions.
// Throws Error where Python or Matplotlib is missing or fails; figures of an earlier run are gone then, so that a
// report never shows them beside new numbers.
std::vector<CurvePicture> draw_paper(const PaperResults& results, const std::filesystem::path& directory);

}  // namespace seiche
