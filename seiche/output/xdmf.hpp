// solution.xdmf: the times, the points and the fields of solution.h5 in the words of XDMF 2, which ParaView and VisIt
// read.
#pragma once

#include <seiche/output/file/folder.hpp>
#include <seiche/output/solution_layout.hpp>

#include <atomic>
#include <cstdint>
#include <string>

namespace seiche {

struct XdmfOptions {
  bool all_times = false;  // however large that makes it
  const std::atomic<bool>* stop = nullptr;
};

// Beside the file `solution` of the folder, which is read for its times; nothing where `stop` is set meanwhile. One
// dimension is a uniform grid (3DCoRectMesh). Of two and three the points are listed (2DSMesh, 3DSMesh), since XDMF
// wants the first axis of a uniform grid to run fastest, and here the last one does; points without a grid are a
// Polyvertex.
//
// XDMF takes some hundred bytes for every time and has no shorter way to say that the next is like the one before. Of
// more than a thousand times only so many are shown that the file has about a tenth of the size of the solution: every
// n-th, and the last. Returns n, which is 1 where all are.
std::uint64_t write_xdmf(const Folder& folder, const std::string& solution, const SolutionLayout& layout,
                         const XdmfOptions& options = {});

}  // namespace seiche
