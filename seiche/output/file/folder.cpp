#include <seiche/core/base/error.hpp>
#include <seiche/output/file/folder.hpp>
#include <seiche/output/file/folder_open.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace seiche {

Folder::Open::~Open() {
  if (descriptor >= 0) ::close(descriptor);
}

Folder::Folder(const std::filesystem::path& path) : open_(std::make_shared<Open>()) {
  open_->path = path.empty() ? "." : path;
  open_->descriptor = ::open(open_->path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (open_->descriptor < 0) throw Error("cannot open the folder {}: {}", open_->path.string(), std::strerror(errno));
}

Folder Folder::inside(const std::string& name) const {
  const auto inner = std::make_shared<Open>();
  inner->path = path() / name;
  inner->around = open_;
  inner->descriptor = ::openat(descriptor(), name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (inner->descriptor < 0) throw Error("cannot open the folder {}: {}", inner->path.string(), std::strerror(errno));
  return Folder(inner);
}

Folder Folder::make_inside(const std::string& name) const {
  require_lock();
  const bool is_new = ::mkdirat(descriptor(), name.c_str(), 0777) == 0;
  if (is_new) ::fsync(descriptor());  // before anything vouches for what is in it
  if (!is_new && errno != EEXIST)
    throw Error("cannot make the folder {}: {}", (path() / name).string(), std::strerror(errno));
  return inside(name);
}

const Folder::Open& Folder::locked() const {
  const Open* folder = open_.get();
  while (folder->around != nullptr) folder = folder->around.get();
  return *folder;
}

const std::filesystem::path& Folder::path() const { return open_->path; }
int Folder::descriptor() const { return open_->descriptor; }

bool Folder::is_at_its_path() const {
  struct stat named = {};
  return ::stat(path().c_str(), &named) == 0 && FileIdentity(named) == FileIdentity(descriptor());
}

bool Folder::has_lock() const {
  const Open& folder = locked();
  return folder.lock < 0 || FileIdentity(folder.descriptor, lock_name) == FileIdentity(folder.lock);
}

void Folder::require_lock() const {
  if (!has_lock())
    throw Error(
        "cannot write into {}: it was removed, or its lock was, while this run went on, and its names may be those of "
        "another run",
        path().string());
}

FileIdentity::FileIdentity(int file) {
  struct stat status = {};
  if (::fstat(file, &status) == 0) *this = FileIdentity(status);
}

FileIdentity::FileIdentity(int folder, const std::string& name) {
  struct stat status = {};
  if (::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0) *this = FileIdentity(status);
}

FileIdentity::FileIdentity(const struct stat& status)
    : device(static_cast<std::uint64_t>(status.st_dev)), number(static_cast<std::uint64_t>(status.st_ino)) {}

int open_file(const Folder& folder, const std::string& name, int flags) {
  const std::string path = (folder.path() / name).string();
  const int file = ::openat(folder.descriptor(), name.c_str(), flags | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) throw Error("cannot open {}: {}", path, std::strerror(errno));
  struct stat status = {};
  if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode)) return file;
  ::close(file);
  throw Error("{} is {}", path, S_ISDIR(status.st_mode) ? "a folder" : "not a file");
}

}  // namespace seiche
