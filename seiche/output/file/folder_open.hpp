// What a Folder holds open, and by what files are told apart whatever they are called.
#pragma once

#include <seiche/output/file/folder.hpp>

#include <cstdint>
#include <memory>
#include <string>

struct stat;

namespace seiche {

inline constexpr const char* lock_name = ".seiche.lock";

struct Folder::Open {
  std::filesystem::path path;
  int descriptor = -1;
  int lock = -1;                           // the file that FolderLock holds, as long as it does
  std::shared_ptr<Open> around = nullptr;  // the folder in which it is, whose lock counts
  Open() = default;
  ~Open();
  Open(const Open&) = delete;
  Open& operator=(const Open&) = delete;
};

// Device and number; 0 and 0 where there is no such file.
struct FileIdentity {
  std::uint64_t device = 0, number = 0;

  FileIdentity() = default;
  explicit FileIdentity(int file);
  FileIdentity(int folder, const std::string& name);  // links are not followed
  explicit FileIdentity(const struct stat& status);
  bool operator==(const FileIdentity&) const = default;
};

// Opens a regular file of a folder, with these flags of open(2); the descriptor is the caller's. Throws Error for
// anything else: a pipe would be waited for, a device has no end, and a link leads elsewhere.
int open_file(const Folder& folder, const std::string& name, int flags);

}  // namespace seiche
