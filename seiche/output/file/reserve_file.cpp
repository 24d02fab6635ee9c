#include <seiche/core/error.hpp>
#include <seiche/output/file/folder_open.hpp>
#include <seiche/output/file/reserve_file.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace seiche {

ReserveFile::ReserveFile(const Folder& folder, std::uint64_t bytes) : folder_(folder) {
  ::unlinkat(folder_.descriptor(), reserve_name, 0);  // of a run that was killed
  constexpr int flags = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  file_ = ::openat(folder_.descriptor(), reserve_name, flags, 0666);
  const int failure = file_ < 0 ? errno : ::posix_fallocate(file_, 0, static_cast<::off_t>(bytes));
  // Where no room can be set aside, or no file may be so large, there may still be room.
  if (failure == 0 || failure == EOPNOTSUPP || failure == EINVAL || failure == EFBIG) return;
  release();
  throw Error("cannot write into {}: {}", folder_.path().string(), std::strerror(failure));
}

ReserveFile::~ReserveFile() { release(); }

void ReserveFile::release_most() {
  if (file_ >= 0 && ::ftruncate(file_, static_cast<::off_t>(of_a_summary)) != 0) release();
}

void ReserveFile::release() {
  if (file_ < 0) return;
  if (FileIdentity(folder_.descriptor(), reserve_name) == FileIdentity(file_))
    ::unlinkat(folder_.descriptor(), reserve_name, 0);
  ::close(std::exchange(file_, -1));
}

}  // namespace seiche
