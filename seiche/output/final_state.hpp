// final.txt: the last good state in physical values, in the order of z, one number per line. The same form that
// initial = { file = … } reads, so one run can start where another ended.
#pragma once

#include <seiche/core/vector.hpp>

#include <filesystem>

namespace seiche {

void write_final_state(const std::filesystem::path& path, const Vector& physical_values);

}  // namespace seiche
