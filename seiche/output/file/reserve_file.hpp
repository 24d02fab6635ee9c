// Room on the disk that is kept for what a run has to say at its end, also where its solution has filled the disk.
#pragma once

#include <seiche/output/file/folder.hpp>

#include <cstdint>

namespace seiche {

class ReserveFile {
 public:
  // Throws Error where there is not even that room.
  ReserveFile(const Folder& folder, std::uint64_t bytes);
  ~ReserveFile();  // the file goes
  ReserveFile(const ReserveFile&) = delete;
  ReserveFile& operator=(const ReserveFile&) = delete;

  static constexpr std::uint64_t of_a_summary = 1U << 15U;
  // All but the room for one summary more, which is there to say what failed while the rest was written.
  void release_most();
  void release();

 private:
  Folder folder_;
  int file_ = -1;
};

inline constexpr const char* reserve_name = ".seiche.reserve";

}  // namespace seiche
