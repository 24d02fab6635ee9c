// HDF5 through its C interface: files, data sets that grow along their first axis, attributes, dimension scales.
// Handles close themselves, and what fails throws Error with the reason that HDF5 gives.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/output/file/folder.hpp>
#include <seiche/output/hdf5/hdf5_attributes.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

class Hdf5Handle {
 public:
  using Id = std::int64_t;  // hid_t, without the header of HDF5
  using Close = int (*)(Id);

  Hdf5Handle() = default;
  Hdf5Handle(Id id, Close closing) : id_(id), close_(closing) {}
  ~Hdf5Handle() { close(); }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept;
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;

  Id id() const { return id_; }
  bool close();  // false where HDF5 could not; the handle is gone in any case

 private:
  Id id_ = -1;
  Close close_ = nullptr;
};

using Hdf5Shape = std::vector<std::uint64_t>;

inline constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";  // with which every file begins

// Rows of a virtual data set, which lie in another data set.
struct Hdf5Source {
  std::string file;  // from the folder of the one that names it; "": the same one
  std::string dataset;
  std::uint64_t rows = 0;  // all that it has
};

// A chunk as the bytes that it is in a file.
struct Hdf5Chunk {
  Hdf5Shape corner = {};      // where it begins, along each axis
  std::uint32_t filters = 0;  // those that were left out
  std::vector<char> bytes = {};
};

// An array of doubles (or of whole numbers, which are shown as doubles too), in the order of C: the last axis runs
// fastest.
class Hdf5Dataset {
 public:
  Hdf5Dataset(Hdf5Handle handle, std::string name);

  const std::string& name() const { return name_; }
  Hdf5Handle::Id id() const { return handle_.id(); }
  const Hdf5Shape& shape() const { return shape_; }
  std::uint64_t rows() const { return shape_.front(); }
  std::uint64_t row_size() const;  // values in one row, which is what belongs to one index of the first axis

  void append(std::span<const double> rows);  // whole rows, behind the last one
  // A row behind the last one, from its first planes along the second axis on.
  void begin_row();
  void continue_row(std::uint64_t first_plane, std::span<const double> planes);
  // visit(corner) of the chunks of a row that begin between these planes along the second axis, in their order.
  void for_chunks(std::uint64_t row, std::uint64_t begin_plane, std::uint64_t end_plane,
                  FunctionRef<void(const Hdf5Shape& corner)> visit) const;
  Hdf5Chunk read_chunk(const Hdf5Shape& corner) const;
  void write_chunk(const Hdf5Chunk& chunk, std::uint64_t row);  // of a data set with the same chunks, in this row
  // Rows of a data set of the same layout, behind the last one, as the bytes that they are there, compressed or not.
  // They fill chunks, there and here.
  void append_chunks(const Hdf5Dataset& from, std::uint64_t first, std::uint64_t rows);
  // Where its rows lie, in their order, if it is virtual.
  std::vector<Hdf5Source> sources() const;
  // Whole rows from `first` on, as many as `values` holds.
  void read(std::uint64_t first, std::span<double> values) const;

 private:
  Hdf5Shape chunk() const;

  Hdf5Handle handle_;
  std::string name_;
  Hdf5Shape shape_;
};

struct Hdf5Layout {
  Hdf5Shape row = {};    // the shape of one row; empty: a number
  Hdf5Shape chunk = {};  // of rows and row: compressed as one piece
  bool compressed = true;
  bool whole_numbers = false;
  std::vector<Hdf5Source> sources = {};  // of a virtual data set, to which no row can be appended
};

class Hdf5File {
 public:
  // Into an open file, by HDF5's own driver: it can be read once it is closed. What fills a chunk goes there at once,
  // so that the same calls leave the same bytes.
  static Hdf5File create(int file, const std::filesystem::path& path);
  static Hdf5File in_memory();                              // which is gone with it
  static Hdf5File open(const std::filesystem::path& path);  // to be read
  static Hdf5File open(const Folder& folder, const std::string& name);

  void make_group(const std::string& name);
  Hdf5Dataset make_dataset(const std::string& name, const Hdf5Layout& layout);  // has no row; "group/name" works
  // Throws Error where it is not there, or its rows are not in this file.
  Hdf5Dataset dataset(const std::string& name) const;
  Hdf5Dataset dataset_or_virtual(const std::string& name) const;
  bool has(const std::string& name) const;  // a data set or a group
  // Reads every attribute, and the data sets but those in `elsewhere`, which others read. Throws Error where something
  // cannot be read, or is a link or stored outside, so that the file is not all there is.
  void require_whole(const std::vector<std::string>& elsewhere) const;

  Hdf5Handle::Id id() const { return handle_.id(); }
  void flush();
  void close();  // after all of its data sets

 private:
  explicit Hdf5File(std::filesystem::path path, Hdf5Handle handle);
  void refuse_link(const std::string& name) const;

  std::filesystem::path path_;
  Hdf5Handle handle_;
};

std::string hdf5_version();  // of the library in use

// For programs, before anything else of HDF5: when a disk is full and a file cannot be closed, HDF5 1.10 tries it again
// when the program ends, and crashes. Files must be closed then; those here are.
void hdf5_without_cleanup_at_exit();

}  // namespace seiche
