#include <seiche/core/base/error.hpp>
#include <seiche/output/file/folder_lock.hpp>
#include <seiche/output/file/folder_open.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

namespace seiche {
namespace {

// Whoever held the lock before may have removed the file between our opening and locking it.
bool is_still_there(int file, const Folder& folder) {
  return FileIdentity(file) == FileIdentity(folder.descriptor(), lock_name);
}

}  // namespace

FolderLock::FolderLock(const Folder& folder) : folder_(folder) {
  constexpr int most_looks = 10;  // others that only ask whether it is locked hold it for a moment
  for (int looks = 1;; ++looks) {
    // Not for the programs that draw: they would hold the lock as long as they live.
    const int file = ::openat(folder.descriptor(), lock_name, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file < 0) throw Error("cannot write {}: {}", (folder.path() / lock_name).string(), std::strerror(errno));
    folder_.open_->lock = file;
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) {
      if (is_still_there(file, folder)) return;
    } else if (errno == EWOULDBLOCK) {
      folder_.open_->lock = -1;
      ::close(file);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      if (looks < most_looks) continue;
      throw Error("another run is writing into {}: wait until it has ended, or give another folder",
                  folder.path().string());
    } else if (errno != EINTR) {
      return;
    }
    ::close(file);
  }
}

bool is_locked(const Folder& folder) {
  const int file = ::openat(folder.descriptor(), lock_name, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0) return false;
  const bool is_free = ::flock(file, LOCK_SH | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  ::close(file);
  return !is_free;
}

FolderLock::~FolderLock() {
  const int file = folder_.open_->lock;
  // While it is locked, so that no other one's file goes.
  if (is_still_there(file, folder_)) ::unlinkat(folder_.descriptor(), lock_name, 0);
  folder_.open_->lock = -1;
  ::close(file);
}

}  // namespace seiche
