#include <seiche/output/citation.hpp>
#include <seiche/version.hpp>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

namespace seiche {

std::string software_citation(std::string_view version, std::string_view commit, std::string_view year) {
  return fmt::format(
      "@software{{seiche,\n"
      "  title   = {{Seiche: energy-stable integrators for damped Hamiltonian systems}},\n"
      "  author  = {{{{The Seiche authors}}}},\n"
      "  version = {{{}}},\n"
      "  year    = {{{}}},\n"
      "  note    = {{commit {}}}\n"
      "}}\n",
      version, year, commit);
}

std::string paper_citation() {
  return "@article{li_li_shang_xu,\n"
         "  title  = {A unified framework of energy-stable splitting exponential integrators for damped Hamiltonian systems},\n"
         "  author = {Li, Lu and Li, Xiaoli and Shang, Zaijiu and Xu, Quanquan}\n"
         "}\n";
}

std::string citation() {
  return software_citation(version_number, version_commit, fmt::format("{:%Y}", fmt::gmtime(std::time(nullptr)))) +
         "\n" + paper_citation();
}

}  // namespace seiche
