#include <seiche/core/base/error.hpp>
#include <seiche/output/hdf5/hdf5_calls.hpp>
#include <seiche/output/hdf5/hdf5_whole.hpp>

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <string>

namespace seiche {
namespace {

struct Contents {
  std::vector<std::string> links;  // their names
  std::string strange;             // the first that is no hard link
};

herr_t list(hid_t, const char* name, const H5L_info_t* link, void* found) noexcept {
  auto& contents = *static_cast<Contents*>(found);
  try {
    contents.links.emplace_back(name);
    if (link->type != H5L_TYPE_HARD && contents.strange.empty()) contents.strange = name;
  } catch (...) {
    return -1;
  }
  return 0;
}

void read_attributes(Hdf5Handle::Id object, const std::string& what) {
  hdf5_check(H5Aiterate2(
                 object, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr,
                 [](hid_t owner, const char* name, const H5A_info_t*, void*) -> herr_t {
                   const hid_t attribute = H5Aopen(owner, name, H5P_DEFAULT);
                   if (attribute < 0) return -1;
                   const hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
                   const hssize_t count = H5Sget_simple_extent_npoints(space);
                   constexpr std::size_t most = 1U << 26U;  // bytes; ours have a few thousand
                   const std::size_t size = H5Tget_size(type) * static_cast<std::size_t>(std::max<hssize_t>(count, 0));
                   herr_t status = count < 0 || size > most ? -1 : 0;
                   if (status == 0) {
                     char* const bytes = static_cast<char*>(H5allocate_memory(size + 1, true));
                     status = bytes == nullptr ? -1 : H5Aread(attribute, type, bytes);
                     if (status >= 0) H5Dvlen_reclaim(type, space, H5P_DEFAULT, bytes);
                     H5free_memory(bytes);
                   }
                   H5Sclose(space);
                   H5Tclose(type);
                   H5Aclose(attribute);
                   return status < 0 ? -1 : 0;
                 },
                 nullptr),
             fmt::format("cannot read the attributes of {}", what));
}

void read_rows(const Hdf5Dataset& data) {
  constexpr std::uint64_t at_once = 1U << 20U, most = 1U << 28U;  // values
  if (data.row_size() > most)
    throw Error("a row of {} has {} values, and none has more than {}", data.name(), data.row_size(), most);
  const std::uint64_t step = std::max<std::uint64_t>(at_once / std::max<std::uint64_t>(data.row_size(), 1), 1);
  std::vector<double> values;
  for (std::uint64_t first = 0; first < data.rows(); first += step) {
    values.resize(static_cast<std::size_t>(std::min(step, data.rows() - first) * data.row_size()));
    data.read(first, values);
  }
}

}  // namespace

void require_whole_file(const Hdf5File& file, const std::filesystem::path& path,
                        const std::vector<std::string>& elsewhere) {
  const Hdf5Quiet quiet;
  Contents contents;
  hdf5_check(H5Lvisit(file.id(), H5_INDEX_NAME, H5_ITER_NATIVE, list, &contents),
             fmt::format("cannot read {}", path.string()));
  if (!contents.strange.empty())
    throw Error("{} in {} is a link, and no solution has one", contents.strange, path.string());
  read_attributes(file.id(), path.string());
  for (const std::string& name : contents.links) {
    const std::string what = fmt::format("{} in {}", name, path.string());
    const Hdf5Handle object =
        hdf5_handle(H5Oopen(file.id(), name.c_str(), H5P_DEFAULT), H5Oclose, fmt::format("cannot read {}", what));
    read_attributes(object.id(), what);
    const bool is_read = std::find(elsewhere.begin(), elsewhere.end(), name) != elsewhere.end();
    if (H5Iget_type(object.id()) == H5I_DATASET && !is_read) read_rows(file.dataset(name));
  }
}

}  // namespace seiche
