// One writer at a time in a folder: a second run would mix its files with those of the first.
#pragma once

#include <seiche/output/file/folder.hpp>

namespace seiche {

// Held as long as the object lives, by flock on the file .seiche.lock, which goes with it. The system lets go of the
// lock of a program that was killed. File systems without locks are not locked.
class FolderLock {
 public:
  explicit FolderLock(const Folder& folder);  // throws Error where another one holds it
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  Folder folder_;
};

bool is_locked(const Folder& folder);  // by another program

}  // namespace seiche
