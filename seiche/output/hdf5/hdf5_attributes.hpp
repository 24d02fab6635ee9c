// Attributes of HDF5 files and data sets, and the dimension scales that are made of them. hdf5.hpp includes this file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

class Hdf5Dataset;
class Hdf5File;

// Of a file or a data set, by its id. Texts are of variable length, in UTF-8.
void set_attribute(std::int64_t object, const std::string& name, std::string_view text);
std::string text_attribute(std::int64_t object, const std::string& name);  // "" if it is missing

// Dimension scales, by which xarray and NetCDF-4 know the axes: every data set that is no scale itself, with the
// scales of its axes in their order.
struct Hdf5Axes {
  const Hdf5Dataset* data;
  std::vector<const Hdf5Dataset*> scales;
};
void attach_scales(const Hdf5File& file, const std::vector<Hdf5Axes>& all);

}  // namespace seiche
