// All of an HDF5 file, read from its beginning to its end.
#pragma once

#include <seiche/output/hdf5/hdf5.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace seiche {

// Hdf5File::require_whole; `path` is how errors call the file.
void require_whole_file(const Hdf5File& file, const std::filesystem::path& path,
                        const std::vector<std::string>& elsewhere);

}  // namespace seiche
