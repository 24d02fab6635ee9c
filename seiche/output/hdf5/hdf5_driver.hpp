// A file of HDF5 that can be read whenever its program ends, by whatever: a full disk, a signal, a crash.
#pragma once

#include <seiche/output/hdf5/hdf5.hpp>

namespace seiche {

// HDF5 overwrites in place what tells where the data are, in an order of its own. This driver lets through what
// changes nothing that can be reached – new space, and rows behind those that count – and holds the rest back to the
// next flush, when it is written in the order in which every beginning of it is a whole file: the size of the file,
// indices from the root to the leaves, then the headers of data sets with their numbers of rows, the last created
// first. So a data set never counts rows that are not there, and the first one created, t, never more than the others
// have.
//
// The first write that fails is told; from then on nothing is written, and the file stays what it was at the last
// flush, with what this one had to say in addition.
//
// A property list for H5Fcreate and H5Fopen. `file` is an open descriptor, of which the driver makes copies of its
// own; the name that HDF5 is given is for messages only.
Hdf5Handle ordered_file_access(int file);

}  // namespace seiche
