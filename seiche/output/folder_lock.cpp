#include <seiche/core/error.hpp>
#include <seiche/output/folder_lock.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace seiche {
namespace {

// Whoever held the lock before may have removed the file between our opening and locking it.
bool is_still_there(int file, const std::filesystem::path& path) {
  struct stat opened = {}, named = {};
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& directory) : path_(directory / ".seiche.lock") {
  for (;;) {
    // Not for the programs that draw: they would hold the lock as long as they live.
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) throw Error("cannot write {}: {}", path_.string(), std::strerror(errno));
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) {
      if (is_still_there(file_, path_)) return;
    } else if (errno == EWOULDBLOCK) {
      ::close(file_);
      throw Error("another run is writing into {}: wait until it has ended, or give another folder",
                  directory.string());
    } else if (errno != EINTR) {
      return;
    }
    ::close(file_);
  }
}

FolderLock::~FolderLock() {
  ::unlink(path_.c_str());  // while it is locked, so that no other one's file goes
  ::close(file_);
}

}  // namespace seiche
