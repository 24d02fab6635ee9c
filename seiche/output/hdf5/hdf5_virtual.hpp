// Virtual data sets: their rows lie in other data sets, of the same file or of others.
#pragma once

#include <seiche/output/hdf5/hdf5.hpp>

#include <vector>

namespace seiche {

// For `options` with which a data set of this shape is made. What cannot be found when it is read is NaN. Throws Error.
void set_sources(Hdf5Handle::Id options, const Hdf5Shape& shape, const std::vector<Hdf5Source>& sources);
// In the order of the rows; none of a data set whose rows lie in itself. Throws Error where what is found there is no
// row after the other.
std::vector<Hdf5Source> sources_of(Hdf5Handle::Id dataset, const Hdf5Shape& shape);

}  // namespace seiche
