// A spectrum as text: for a terminal, as JSON and as CSV. spectrum.hpp includes this file.
#pragma once

#include <string>

namespace seiche {

struct Spectrum;

std::string spectrum_table(const Spectrum& spectrum);     // what was measured, at most some 50 modes, the verdict
std::string spectrum_sentence(const Spectrum& spectrum);  // the verdict, "\n"-terminated lines
std::string spectrum_json(const Spectrum& spectrum);      // one document
std::string spectrum_csv(const Spectrum& spectrum);

}  // namespace seiche
