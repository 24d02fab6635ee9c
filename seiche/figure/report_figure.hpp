// A picture on a report's page, in itself and beside its files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

struct ReportFigure {
  std::string stem;
  std::string title, caption;            // plain text
  std::vector<std::string> formats;      // linked where <stem>.<format> is there
  std::string number = {}, anchor = {};  // "Figure 1, left", before the caption; what links to it name
};

// <figure> with <stem>.png on a light ground and <stem>_dark.png on a dark one, both in the page, from
// `folder`/figures; where one is missing, with words in its place.
std::string report_figure(const std::filesystem::path& folder, const ReportFigure& figure);

}  // namespace seiche
