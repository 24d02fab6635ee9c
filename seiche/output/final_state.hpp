// final.txt: the last good state in physical values, in the order of z, one number per line. The same form that
// initial = { file = … } reads, so one run can start where another ended.
#pragma once

#include <seiche/core/base/vector.hpp>
#include <seiche/output/file/folder.hpp>

namespace seiche {

void write_final_state(const Folder& folder, const Vector& physical_values);

}  // namespace seiche
