// solution.xdmf: the times, the points and the fields of solution.h5 in the words of XDMF 2, which ParaView and VisIt
// read.
#pragma once

#include <seiche/output/file/folder.hpp>
#include <seiche/output/solution_layout.hpp>

#include <atomic>
#include <string>

namespace seiche {

// Beside the file `solution` of the folder, which is read for its times; nothing where `stop` is set meanwhile. One
// dimension is a uniform grid (3DCoRectMesh). Of two and three the points are listed (2DSMesh, 3DSMesh), since XDMF
// wants the first axis of a uniform grid to run fastest, and here the last one does; points without a grid are a
// Polyvertex.
void write_xdmf(const Folder& folder, const std::string& solution, const SolutionLayout& layout,
                bool has_modified_energy, const std::atomic<bool>* stop = nullptr);

}  // namespace seiche
