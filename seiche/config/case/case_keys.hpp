// Which keys a case file may have, and what is said of others.
#pragma once

#include <seiche/core/base/error.hpp>
#include <seiche/problem/problems.hpp>

#include <string>
#include <vector>

namespace seiche {

// Of one section; `problem` has its own, and null is a problem that is not known yet.
std::vector<std::string> case_keys(const std::string& section, const ProblemEntry* problem);

// "method.h" for h, and for dt; "" for a word that is no key of every case.
std::string full_key(const std::string& word);

// Sentences for what stands where it means nothing. What a word means in other programs comes before what it looks
// like: dt is h, and rtol the tolerance.
std::string key_outside_sections(const std::string& key, const ProblemEntry* problem);
Error unknown_key(const std::string& section, const std::string& key, const ProblemEntry* problem);

}  // namespace seiche
