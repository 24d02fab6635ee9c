// Two panels per problem: error, and error of the energy, against CPU time.
#pragma once

#include <bench/work_precision/reach.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace seiche::bench {

struct Panel {
  std::string stem;  // figures/<stem>.png and .pdf
  std::string title, caption;
};

// Of Seiche's methods those that are fastest at one of the wanted errors, seisav and seilm; all peers.
std::vector<Panel> panels_of(const ProblemResult& result);

// Throws Error where Python or Matplotlib is missing or fails.
void draw_figures(const std::vector<ProblemResult>& results, const std::filesystem::path& directory);

}  // namespace seiche::bench
