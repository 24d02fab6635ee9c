#include <seiche/core/base/error.hpp>
#include <seiche/output/file/folder_open.hpp>
#include <seiche/output/hdf5/hdf5.hpp>
#include <seiche/output/hdf5/hdf5_calls.hpp>
#include <seiche/output/hdf5/hdf5_virtual.hpp>
#include <seiche/output/hdf5/hdf5_whole.hpp>

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <type_traits>
#include <utility>

namespace seiche {

static_assert(std::is_same_v<hid_t, Hdf5Handle::Id> && std::is_same_v<herr_t, int>);

Hdf5Handle& Hdf5Handle::operator=(Hdf5Handle&& other) noexcept {
  if (this == &other) return *this;
  close();
  id_ = std::exchange(other.id_, -1);
  close_ = other.close_;
  return *this;
}

bool Hdf5Handle::close() {
  const Id id = std::exchange(id_, -1);
  if (id < 0) return true;
  const Hdf5Quiet quiet;
  return close_(id) >= 0;
}

namespace {

constexpr unsigned compression = 1;  // of 9: more takes much longer and gains little on doubles

std::vector<hsize_t> sizes(const Hdf5Shape& shape) { return {shape.begin(), shape.end()}; }

Hdf5Shape shape_of(Hdf5Handle::Id dataset) {
  const Hdf5Handle space = hdf5_handle(H5Dget_space(dataset), H5Sclose, "an HDF5 data set has no shape");
  std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space.id()), 0)));
  H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr);
  return {shape.begin(), shape.end()};
}

// The rows from `first` on, chosen in the file.
Hdf5Handle chosen_rows(Hdf5Handle::Id dataset, const Hdf5Shape& shape, std::uint64_t first, std::uint64_t count) {
  Hdf5Handle space = hdf5_handle(H5Dget_space(dataset), H5Sclose, "an HDF5 data set has no shape");
  std::vector<hsize_t> start(shape.size(), 0), size = sizes(shape);
  start[0] = first;
  size[0] = count;
  hdf5_check(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr),
             "rows of an HDF5 data set cannot be chosen");
  return space;
}

Error stored_elsewhere(const std::string& name) {
  return Error("the HDF5 data set {} is stored in another file, and those of a solution are not", name);
}

Hdf5Handle flat_space(std::size_t size) {
  const hsize_t length = size;
  return hdf5_handle(H5Screate_simple(1, &length, nullptr), H5Sclose, "no HDF5 space for values");
}

}  // namespace

Hdf5Dataset::Hdf5Dataset(Hdf5Handle handle, std::string name)
    : handle_(std::move(handle)), name_(std::move(name)), shape_(shape_of(handle_.id())) {
  if (shape_.empty()) throw Error("the HDF5 data set {} is a number and no array", name_);
  const Hdf5Handle options = hdf5_handle(H5Dget_create_plist(id()), H5Pclose, "an HDF5 data set has no layout");
  if (H5Pget_external_count(options.id()) != 0) throw stored_elsewhere(name_);
}

std::vector<Hdf5Source> Hdf5Dataset::sources() const {
  const Hdf5Quiet quiet;
  return sources_of(id(), shape_);
}

std::uint64_t Hdf5Dataset::row_size() const {
  return std::accumulate(shape_.begin() + 1, shape_.end(), std::uint64_t{1}, std::multiplies<>());
}

void Hdf5Dataset::append(std::span<const double> rows) {
  const Hdf5Quiet quiet;
  const std::uint64_t first = shape_[0];
  const std::uint64_t count = rows.size() / row_size();
  if (count == 0) return;
  shape_[0] = first + count;
  const std::string what = fmt::format("cannot write {} rows of {}", count, name_);
  hdf5_check(H5Dset_extent(id(), sizes(shape_).data()), what);
  const Hdf5Handle memory = flat_space(rows.size());
  const Hdf5Handle place = chosen_rows(id(), shape_, first, count);
  hdf5_check(H5Dwrite(id(), H5T_NATIVE_DOUBLE, memory.id(), place.id(), H5P_DEFAULT, rows.data()), what);
}

void Hdf5Dataset::begin_row() {
  const Hdf5Quiet quiet;
  ++shape_[0];
  hdf5_check(H5Dset_extent(id(), sizes(shape_).data()), fmt::format("cannot write a row of {}", name_));
}

void Hdf5Dataset::continue_row(std::uint64_t first_plane, std::span<const double> planes) {
  const Hdf5Quiet quiet;
  const std::string what = fmt::format("cannot write a row of {}", name_);
  std::vector<hsize_t> corner(shape_.size(), 0), size(sizes(shape_));
  corner[0] = shape_[0] - 1;
  corner[1] = first_plane;
  size[0] = 1;
  size[1] = planes.size() / (row_size() / shape_[1]);
  const Hdf5Handle place = hdf5_handle(H5Dget_space(id()), H5Sclose, what);
  hdf5_check(H5Sselect_hyperslab(place.id(), H5S_SELECT_SET, corner.data(), nullptr, size.data(), nullptr), what);
  const Hdf5Handle memory = flat_space(planes.size());
  hdf5_check(H5Dwrite(id(), H5T_NATIVE_DOUBLE, memory.id(), place.id(), H5P_DEFAULT, planes.data()), what);
}

Hdf5Shape Hdf5Dataset::chunk() const {
  const std::string what = fmt::format("{} has no chunks", name_);
  const Hdf5Handle options = hdf5_handle(H5Dget_create_plist(id()), H5Pclose, what);
  std::vector<hsize_t> chunk(shape_.size());
  hdf5_check(H5Pget_chunk(options.id(), static_cast<int>(chunk.size()), chunk.data()), what);
  return {chunk.begin(), chunk.end()};
}

void Hdf5Dataset::append_chunks(const Hdf5Dataset& from, std::uint64_t first, std::uint64_t rows) {
  const Hdf5Quiet quiet;
  const std::string what = fmt::format("cannot copy rows {} to {} of {}", first, first + rows, name_);
  const Hdf5Shape chunk = this->chunk();
  const std::uint64_t behind = shape_[0];
  shape_[0] += rows;
  hdf5_check(H5Dset_extent(id(), sizes(shape_).data()), what);
  for (std::uint64_t row = 0; row < rows; row += chunk[0])
    for_chunks(first + row, 0, shape_.size() > 1 ? shape_[1] : 1,
               [&](const Hdf5Shape& corner) { write_chunk(from.read_chunk(corner), behind + row); });
}

// The last axis runs fastest, as where HDF5 divides a row among its chunks.
void Hdf5Dataset::for_chunks(std::uint64_t row, std::uint64_t begin_plane, std::uint64_t end_plane,
                             FunctionRef<void(const Hdf5Shape& corner)> visit) const {
  const Hdf5Shape chunk = this->chunk();
  Hdf5Shape corner(shape_.size(), 0);
  corner[0] = row;
  if (corner.size() > 1) corner[1] = begin_plane;
  const auto next_corner = [&] {
    for (std::size_t axis = corner.size(); --axis > 0;) {
      corner[axis] += chunk[axis];
      if (corner[axis] < (axis == 1 ? end_plane : shape_[axis])) return true;
      corner[axis] = 0;
    }
    return false;
  };
  do visit(corner);
  while (next_corner());
}

Hdf5Chunk Hdf5Dataset::read_chunk(const Hdf5Shape& corner) const {
  const Hdf5Quiet quiet;
  const std::string what = fmt::format("cannot read a chunk of {}", name_);
  const std::vector<hsize_t> at = sizes(corner);
  Hdf5Chunk chunk{.corner = corner};
  hsize_t size = 0;
  hdf5_check(H5Dget_chunk_storage_size(id(), at.data(), &size), what);
  chunk.bytes.resize(size);
  hdf5_check(H5Dread_chunk(id(), H5P_DEFAULT, at.data(), &chunk.filters, chunk.bytes.data()), what);
  return chunk;
}

void Hdf5Dataset::write_chunk(const Hdf5Chunk& chunk, std::uint64_t row) {
  const Hdf5Quiet quiet;
  std::vector<hsize_t> corner = sizes(chunk.corner);
  corner[0] = row;
  hdf5_check(H5Dwrite_chunk(id(), H5P_DEFAULT, chunk.filters, corner.data(), chunk.bytes.size(), chunk.bytes.data()),
             fmt::format("cannot write a chunk of {}", name_));
}

void Hdf5Dataset::read(std::uint64_t first, std::span<double> values) const {
  const Hdf5Quiet quiet;
  const std::uint64_t count = values.size() / std::max<std::uint64_t>(row_size(), 1);
  if (count == 0) return;
  if (first + count > rows())
    throw Error("rows {} to {} of {} were asked for, and it has {}", first, first + count - 1, name_, rows());
  const Hdf5Handle memory = flat_space(values.size());
  const Hdf5Handle place = chosen_rows(id(), shape_, first, count);
  hdf5_check(H5Dread(id(), H5T_NATIVE_DOUBLE, memory.id(), place.id(), H5P_DEFAULT, values.data()),
             fmt::format("cannot read {}", name_));
}

Hdf5File::Hdf5File(std::filesystem::path path, Hdf5Handle handle)
    : path_(std::move(path)), handle_(std::move(handle)) {}

namespace {

// What is the same for every new file.
Hdf5Handle creation() {
  Hdf5Handle options = hdf5_handle(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "HDF5 does not work");
  H5Pset_obj_track_times(options.id(), false);  // the same run leaves the same bytes
  // NetCDF-4 lists what is in a file in this order.
  H5Pset_link_creation_order(options.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_attr_creation_order(options.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  // Attributes stay in the header, where one of them is changed by one write.
  constexpr unsigned many = 64;
  H5Pset_attr_phase_change(options.id(), many, many);
  return options;
}

// By the descriptor: the path of the file may lead elsewhere by now.
std::string path_of(int file) { return fmt::format("/proc/self/fd/{}", file); }

}  // namespace

Hdf5File Hdf5File::create(int file, const std::filesystem::path& path) {
  const Hdf5Quiet quiet;
  const std::string what = fmt::format("cannot write {}", path.string());
  const Hdf5Handle access = hdf5_handle(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, what);
  hdf5_check(H5Pset_cache(access.id(), 0, 0, 0, 0.0), what);
#if H5_VERSION_GE(1, 10, 7)
  H5Pset_file_locking(access.id(), false, true);  // the folder is locked
#endif
  return Hdf5File(path, hdf5_handle(H5Fcreate(path_of(file).c_str(), H5F_ACC_TRUNC, creation().id(), access.id()),
                                    H5Fclose, what));
}

Hdf5File Hdf5File::in_memory() {
  const Hdf5Quiet quiet;
  const char* what = "HDF5 has no memory for a file";
  const Hdf5Handle access = hdf5_handle(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, what);
  constexpr std::size_t grows_by = std::size_t{1} << 20U;
  hdf5_check(H5Pset_fapl_core(access.id(), grows_by, false), what);
  hdf5_check(H5Pset_cache(access.id(), 0, 0, 0, 0.0), what);
  return Hdf5File("memory", hdf5_handle(H5Fcreate("memory", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose, what));
}

Hdf5File Hdf5File::open(const std::filesystem::path& path) {
  const Hdf5Quiet quiet;
  return Hdf5File(path, hdf5_handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose,
                                    fmt::format("cannot read {}", path.string())));
}

Hdf5File Hdf5File::open(const Folder& folder, const std::string& name) {
  const Hdf5Quiet quiet;
  const std::filesystem::path path = folder.path() / name;
  const int file = open_file(folder, name, O_RDONLY);
  const Hdf5Handle::Id opened = H5Fopen(path_of(file).c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ::close(file);  // HDF5 has its own
  return Hdf5File(path, hdf5_handle(opened, H5Fclose, fmt::format("cannot read {}", path.string())));
}

void Hdf5File::make_group(const std::string& name) {
  const Hdf5Quiet quiet;
  const std::string what = fmt::format("cannot make the group {} in {}", name, path_.string());
  const Hdf5Handle options = hdf5_handle(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, what);
  H5Pset_obj_track_times(options.id(), false);
  hdf5_handle(H5Gcreate2(id(), name.c_str(), H5P_DEFAULT, options.id(), H5P_DEFAULT), H5Gclose, what);
}

Hdf5Dataset Hdf5File::make_dataset(const std::string& name, const Hdf5Layout& layout) {
  const Hdf5Quiet quiet;
  Hdf5Shape shape = {0};
  for (const Hdf5Source& source : layout.sources) shape[0] += source.rows;
  shape.insert(shape.end(), layout.row.begin(), layout.row.end());
  const std::vector<hsize_t> size = sizes(shape);
  std::vector<hsize_t> most = size;
  if (layout.sources.empty()) most[0] = H5S_UNLIMITED;
  const std::string what = fmt::format("cannot make {} in {}", name, path_.string());
  const Hdf5Handle space =
      hdf5_handle(H5Screate_simple(static_cast<int>(size.size()), size.data(), most.data()), H5Sclose, what);
  const Hdf5Handle options = hdf5_handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, what);
  if (layout.sources.empty()) {
    hdf5_check(H5Pset_chunk(options.id(), static_cast<int>(layout.chunk.size()), sizes(layout.chunk).data()), what);
  } else {
    set_sources(options.id(), shape, layout.sources);
  }
  if (layout.compressed && layout.sources.empty()) {
    hdf5_check(H5Pset_shuffle(options.id()), what);
    hdf5_check(H5Pset_deflate(options.id(), compression), what);
  }
  H5Pset_obj_track_times(options.id(), false);  // the same run leaves the same bytes
  H5Pset_attr_creation_order(options.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  return {hdf5_handle(H5Dcreate2(id(), name.c_str(), layout.whole_numbers ? H5T_STD_I64LE : H5T_NATIVE_DOUBLE,
                                 space.id(), H5P_DEFAULT, options.id(), H5P_DEFAULT),
                      H5Dclose, what),
          name};
}

// A link in a file may lead to any other one that the user may read.
void Hdf5File::refuse_link(const std::string& name) const {
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    const std::string part = name.substr(0, end);
    H5L_info_t link = {};
    if (H5Lget_info(id(), part.c_str(), &link, H5P_DEFAULT) >= 0 && link.type != H5L_TYPE_HARD)
      throw Error("{} in {} is a link, and no solution has one", part, path_.string());
    if (end == std::string::npos) return;
  }
}

Hdf5Dataset Hdf5File::dataset(const std::string& name) const {
  Hdf5Dataset found = dataset_or_virtual(name);
  if (!found.sources().empty()) throw stored_elsewhere(name);
  return found;
}

Hdf5Dataset Hdf5File::dataset_or_virtual(const std::string& name) const {
  const Hdf5Quiet quiet;
  refuse_link(name);
  return {hdf5_handle(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), H5Dclose,
                      fmt::format("there is no {} in {}", name, path_.string())),
          name};
}

bool Hdf5File::has(const std::string& name) const {
  const Hdf5Quiet quiet;
  refuse_link(name);
  return H5Lexists(id(), name.c_str(), H5P_DEFAULT) > 0;
}

void Hdf5File::require_whole(const std::vector<std::string>& elsewhere) const {
  require_whole_file(*this, path_, elsewhere);
}

void Hdf5File::flush() {
  const Hdf5Quiet quiet;
  hdf5_check(H5Fflush(id(), H5F_SCOPE_LOCAL), fmt::format("cannot write {}", path_.string()));
}

void Hdf5File::close() {
  flush();  // tells what a data set that was closed did not
  const Hdf5Quiet quiet;
  hdf5_check(handle_.close() ? 0 : -1, fmt::format("cannot write {}", path_.string()));
}

void hdf5_without_cleanup_at_exit() { H5dont_atexit(); }

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

}  // namespace seiche
