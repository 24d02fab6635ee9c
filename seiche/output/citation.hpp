// How to cite the program and the paper that it implements, in BibTeX.
#pragma once

#include <string>
#include <string_view>

namespace seiche {

// `version` and `commit` of the program that computed, and the year in which it did.
std::string software_citation(std::string_view version, std::string_view commit, std::string_view year);
std::string paper_citation();
// Of this program, today.
std::string citation();

}  // namespace seiche
