// final.txt: the last good state in physical values, in the order of z, one number per line. The same form that
// initial = { file = … } reads, so one run can start where another ended.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/output/file/folder.hpp>

#include <span>

namespace seiche {

// `join` passes on all values, piece by piece, and is called whatever comes of the file.
void write_final_state(const Folder& folder, FunctionRef<void(FunctionRef<void(std::span<const double> piece)>)> join);

}  // namespace seiche
