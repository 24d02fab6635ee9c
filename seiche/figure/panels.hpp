// Which figures there are: four panels per example, the two formulations of Example 2 side by side, and the side
// studies. One file per panel and format.
#pragma once

#include <seiche/figure/plot.hpp>
#include <seiche/study/results.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

struct Panel {
  std::string caption;  // for the report
  Plot plot;            // its stem names the files
};

// Orders, efficiency, energy, energy error. `quick` is said in the titles.
std::vector<Panel> example_panels(const ExampleResult& example, bool quick = false);
// Nothing without both formulations of Example 2.
std::optional<Panel> formulations_panel(const PaperResults& results);
Panel side_panel(const SideStudy& study, bool quick = false);
std::vector<Panel> paper_panels(const PaperResults& results);

// Draws all panels into directory/figures. Throws Error if gnuplot is missing or fails; figures of an earlier run are
// gone then, so that a report never shows them beside new numbers.
void draw_paper(const PaperResults& results, const std::filesystem::path& directory);

}  // namespace seiche
