#include <seiche/core/base/error.hpp>
#include <seiche/output/hdf5/hdf5_calls.hpp>
#include <seiche/output/hdf5/hdf5_virtual.hpp>

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <limits>
#include <string>

namespace seiche {
namespace {

constexpr const char* this_file = ".";

std::vector<hsize_t> extent_of(const Hdf5Shape& shape) { return {shape.begin(), shape.end()}; }

Hdf5Handle space_of(const std::vector<hsize_t>& size) {
  return hdf5_handle(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose,
                     "no HDF5 space for rows");
}

// What HDF5 writes into a buffer, whose length it tells where it gets none.
template <class Call>
std::string told_by(const Call& call) {
  const ssize_t length = call(nullptr, 0);
  std::string text(static_cast<std::size_t>(std::max<ssize_t>(length, 0)) + 1, '\0');
  if (length < 0 || call(text.data(), text.size()) != length) throw Error("HDF5 does not tell where rows lie");
  text.pop_back();
  return text;
}

struct Rows {
  std::uint64_t first, count;
};

// Throws Error where something else than whole rows is selected. Of all of a data set that was not opened yet HDF5 does
// not know the shape: `shape` is to be it then, as readers see to.
Rows rows_of(Hdf5Handle::Id space, const Hdf5Shape& shape) {
  if (H5Sget_select_type(space) == H5S_SEL_ALL) return {0, shape[0]};
  std::vector<hsize_t> first(shape.size()), last(shape.size());
  const bool has_axes = H5Sget_simple_extent_ndims(space) == static_cast<int>(shape.size());
  if (!has_axes || H5Sget_select_bounds(space, first.data(), last.data()) < 0)
    throw Error("a virtual HDF5 data set has other axes than its rows");
  std::uint64_t numbers = last[0] - first[0] + 1;
  for (std::size_t a = 1; a < shape.size(); ++a) numbers *= shape[a];
  if (H5Sget_select_npoints(space) != static_cast<hssize_t>(numbers))
    throw Error("a virtual HDF5 data set shows parts of rows");
  return {first[0], last[0] - first[0] + 1};
}

}  // namespace

void set_sources(Hdf5Handle::Id options, const Hdf5Shape& shape, const std::vector<Hdf5Source>& sources) {
  const std::string what = "a virtual HDF5 data set cannot be made";
  const double missing = std::numeric_limits<double>::quiet_NaN();
  hdf5_check(H5Pset_fill_value(options, H5T_NATIVE_DOUBLE, &missing), what);
  const Hdf5Handle here = space_of(extent_of(shape));
  std::vector<hsize_t> start(shape.size(), 0), size = extent_of(shape);
  for (const Hdf5Source& source : sources) {
    size[0] = source.rows;
    hdf5_check(H5Sselect_hyperslab(here.id(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr), what);
    const char* const file = source.file.empty() ? this_file : source.file.c_str();
    hdf5_check(H5Pset_virtual(options, here.id(), file, source.dataset.c_str(), space_of(size).id()), what);
    start[0] += source.rows;
  }
}

std::vector<Hdf5Source> sources_of(Hdf5Handle::Id dataset, const Hdf5Shape& shape) {
  const std::string what = "HDF5 does not tell where rows lie";
  const Hdf5Handle options = hdf5_handle(H5Dget_create_plist(dataset), H5Pclose, what);
  if (H5Pget_layout(options.id()) != H5D_VIRTUAL) return {};
  std::size_t count = 0;
  hdf5_check(H5Pget_virtual_count(options.id(), &count), what);
  std::vector<Hdf5Source> sources;
  std::uint64_t rows = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Hdf5Handle space = hdf5_handle(H5Pget_virtual_vspace(options.id(), i), H5Sclose, what);
    const Hdf5Handle from = hdf5_handle(H5Pget_virtual_srcspace(options.id(), i), H5Sclose, what);
    const Rows here = rows_of(space.id(), shape);
    Hdf5Shape part = shape;
    part[0] = here.count;
    const Rows there = rows_of(from.id(), part);
    if (here.first != rows || there.first != 0 || here.count != there.count)
      throw Error("rows of a virtual HDF5 data set are not those of another in their order");
    const std::string file =
        told_by([&](char* to, std::size_t n) { return H5Pget_virtual_filename(options.id(), i, to, n); });
    sources.push_back(
        {.file = file == this_file ? "" : file,
         .dataset = told_by([&](char* to, std::size_t n) { return H5Pget_virtual_dsetname(options.id(), i, to, n); }),
         .rows = here.count});
    rows += here.count;
  }
  if (rows != shape[0])
    throw Error("a virtual HDF5 data set has {} rows, and {} of them lie somewhere", shape[0], rows);
  return sources;
}

}  // namespace seiche
