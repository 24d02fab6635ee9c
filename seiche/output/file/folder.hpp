// A folder held open. What is written goes into the folder that was opened, wherever its path leads by then: a run
// whose folder was removed, renamed or replaced by a link touches no file of another one.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

namespace seiche {

class Folder {
 public:
  explicit Folder(const std::filesystem::path& path);  // throws Error where it is not a folder, or cannot be opened

  // A folder in this one, under its lock. Throws Error where it is missing, and where the name is that of a file or a
  // link.
  Folder inside(const std::string& name) const;
  // The same, made if it is missing. Throws Error where the lock is no longer ours, too.
  Folder make_inside(const std::string& name) const;

  const std::filesystem::path& path() const;  // by which it was opened
  int descriptor() const;
  bool is_at_its_path() const;  // false: the path leads elsewhere by now
  // Throws Error where the folder is gone, or the lock that was taken in it (FolderLock) is no longer there: then
  // another run may have taken the names.
  void require_lock() const;
  bool has_lock() const;  // false where that would throw

 private:
  friend class FolderLock;
  struct Open;
  explicit Folder(std::shared_ptr<Open> open) : open_(std::move(open)) {}
  const Open& locked() const;

  std::shared_ptr<Open> open_;  // copies share it
};

}  // namespace seiche
