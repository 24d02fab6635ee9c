// Runs gnuplot 5.4 as a child process. Scripts go to it by way of an unnamed file, never through a shell.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

// One process per script, all at the same time, with `directory` as working directory. Throws Error with gnuplot's own
// message if one fails, and with the name of the package to install if there is no gnuplot.
void run_gnuplot(const std::vector<std::string>& scripts, const std::filesystem::path& directory);

// A literal for text that is drawn, whatever it holds: gnuplot neither runs it nor reads mark-up in it.
std::string gnuplot_text(std::string_view text);
// The same for a file name, which has no mark-up.
std::string gnuplot_file(std::string_view name);

}  // namespace seiche
