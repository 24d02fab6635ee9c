// How calls of HDF5 fail: with an Error that quotes the innermost reason, and with nothing printed.
#pragma once

#include <seiche/output/hdf5/hdf5.hpp>

#include <string>

namespace seiche {

// While one exists, HDF5 prints no errors of its own; what the program had chosen comes back afterwards.
class Hdf5Quiet {
 public:
  Hdf5Quiet();
  ~Hdf5Quiet();
  Hdf5Quiet(const Hdf5Quiet&) = delete;
  Hdf5Quiet& operator=(const Hdf5Quiet&) = delete;

 private:
  int (*print_)(Hdf5Handle::Id, void*) = nullptr;
  void* data_ = nullptr;
};

// Throws Error("{what}: {reason}") for a negative status.
void hdf5_check(int status, const std::string& what);
Hdf5Handle hdf5_handle(Hdf5Handle::Id id, Hdf5Handle::Close close, const std::string& what);

}  // namespace seiche
