// report.html: what was measured and which claims of the paper hold, in one page that needs nothing beside it.
#pragma once

#include <paper/results.hpp>

#include <filesystem>
#include <map>
#include <string>

namespace seiche {

// Embeds the pictures that draw_paper left in directory/figures; where one is missing the page says so, and why, if
// `no_figures_because` tells. Links to the PDF and CSV files that are there.
void write_report(const PaperResults& results, const std::filesystem::path& directory,
                  const std::map<std::string, std::string>& versions = {}, const std::string& no_figures_because = {});

}  // namespace seiche
