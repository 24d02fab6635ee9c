// A RunSpec as the text of a case file, and case files to start from.
#pragma once

#include <seiche/config/case/run_spec.hpp>

#include <string>

namespace seiche {

// The case as run, every default filled in; parse_case reads the same RunSpec from it.
std::string write_case(const RunSpec& spec);
// The same without what depends on where it is run: the output directory is ".", and files have no folders.
std::string case_in_any_folder(RunSpec spec);

// What `seiche new` prints: every key with its default, its meaning and its bounds.
std::string example_case(const std::string& problem);

}  // namespace seiche
