// solution.h5, read back one time after the other.
#pragma once

#include <seiche/core/grid/grid.hpp>
#include <seiche/output/hdf5/hdf5.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

struct CoordinateAxis {
  std::string name;  // "x", "y", "z", or "point"
  std::vector<double> values;
};

class SolutionReader {
 public:
  // Another process reads first: damage of a kind that HDF5 does not expect, such as a text of endless length or a
  // heap that leads into itself, ends the program that reads it, or never ends. Throws Error where that happened,
  // where the file cannot be read, or is no solution; and where it shows other files than solution/000001.h5,
  // 000002.h5, …, beside it, or one that is not there, or has other rows.
  explicit SolutionReader(const std::filesystem::path& path);

  Index count() const { return count_; }  // of times
  std::vector<double> times() const { return first_of(t_); }
  std::vector<double> energies() const { return first_of(H_); }
  std::vector<double> modified_energies() const;  // none where the method has none
  // Throws Error where something else in the file than times, energies and fields cannot be read, or leads out of it.
  void require_whole() const;
  // Where the fields lie, if not in this file.
  const std::vector<std::filesystem::path>& parts() const { return parts_; }
  const std::vector<std::string>& fields() const { return fields_; }
  const std::string& meaning(Index field) const { return meanings_[static_cast<std::size_t>(field)]; }
  const std::vector<CoordinateAxis>& axes() const { return axes_; }  // of space; none for a single point
  Index points() const { return points_; }
  bool on_points() const { return !axes_.empty() && axes_.front().name == "point"; }
  std::vector<Place> nodes() const;     // of numbered points that lie somewhere
  std::vector<Place> supports() const;  // what stands between them, as in Grid
  std::vector<std::array<Index, 2>> bars() const;

  double time(Index k) const;
  // Physical values at time k; all fields one after the other, in the order of z, or one of them.
  void state(Index k, Vector& values) const;
  void field(Index field, Index k, Vector& values) const;

  std::string text(const std::string& attribute) const { return text_attribute(file_.id(), attribute); }

 private:
  struct Unguarded {};
  SolutionReader(const std::filesystem::path& path, Unguarded);
  static std::string what_another_process_finds(const std::filesystem::path& solution);
  friend void require_readable(const std::filesystem::path& solution);

  void add_field(const std::string& name, const std::filesystem::path& path);
  void require_own_parts(const std::filesystem::path& path) const;
  void count_times(const std::filesystem::path& path);
  std::vector<double> first_of(const Hdf5Dataset& data) const;  // as many as there are times
  std::vector<Place> places(const std::string& name) const;

  Hdf5File file_;
  Hdf5Dataset t_, H_;
  std::optional<Hdf5Dataset> modified_;
  std::vector<std::string> fields_, meanings_;
  std::vector<Hdf5Dataset> data_;
  std::vector<std::filesystem::path> parts_;
  std::vector<CoordinateAxis> axes_;
  Index points_ = 1;
  Index count_ = 0;
};

// Throws Error with what another process finds damaged anywhere in the file: in this one, HDF5 would leave objects open
// and complain about them when the program ends.
void require_readable(const std::filesystem::path& solution);

}  // namespace seiche
