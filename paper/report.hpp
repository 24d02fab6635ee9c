// report.html: what was measured and which claims of the paper hold, in one page that needs nothing beside it.
#pragma once

#include <paper/results.hpp>
#include <seiche/figure/curve_picture.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace seiche {

// Embeds `pictures`, those of draw_paper or paper_pictures, from directory/figures; where one is missing the page says
// so, and why, if `no_figures_because` tells. Links to the PDF and CSV files that are there, and from a verdict to the
// figure of the paper that it is about.
void write_report(const PaperResults& results, const std::vector<CurvePicture>& pictures,
                  const std::filesystem::path& directory, const std::map<std::string, std::string>& versions = {},
                  const std::string& no_figures_because = {});

}  // namespace seiche
