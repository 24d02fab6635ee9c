// Decay and frequency of the modes of the linear part, numerical over exact.
#pragma once

#include <seiche/study/spectrum.hpp>

#include <filesystem>

namespace seiche {

// Draws spectrum_decay and spectrum_phase, .png and .pdf each, in `directory`. Throws Error if Matplotlib is missing or
// fails.
void draw_spectrum(const Spectrum& spectrum, const std::filesystem::path& directory);

}  // namespace seiche
