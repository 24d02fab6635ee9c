#include <seiche/core/base/error.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/file/folder_open.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <tuple>
#include <utility>

namespace seiche {
namespace {

constexpr std::size_t buffer = 1U << 16U;

Error cannot_write(const std::filesystem::path& path, int error_number) {
  return Error("cannot write {}: {}", path.string(), std::strerror(error_number));
}

// Byte behind the last line feed of an open file.
std::uintmax_t end_of_lines(int file) {
  std::uintmax_t end = 0, read = 0;
  std::array<char, buffer> piece{};
  for (;;) {
    const ::ssize_t size = ::pread(file, piece.data(), piece.size(), static_cast<::off_t>(read));
    if (size <= 0) return end;
    const std::string_view text(piece.data(), static_cast<std::size_t>(size));
    if (const std::size_t last = text.rfind('\n'); last != std::string_view::npos) end = read + last + 1;
    read += text.size();
  }
}

// The checksum of the bytes up to `end`, from that of those up to mark.length; false where there are not as many.
bool extend(FileMark& mark, std::uint64_t end, int file) {
  std::array<char, buffer> piece{};
  while (mark.length < end) {
    const std::size_t wanted = std::min<std::uint64_t>(piece.size(), end - mark.length);
    const ::ssize_t size = ::pread(file, piece.data(), wanted, static_cast<::off_t>(mark.length));
    if (size <= 0) return false;
    mark.checksum = checksum({piece.data(), static_cast<std::size_t>(size)}, mark.checksum);
    mark.length += static_cast<std::uint64_t>(size);
  }
  return true;
}

// 0, or the number of the error, once what was written is on the disk. Some file systems cannot do that, and say so.
int failure_to_sync(int result) {
  return result == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS ? 0 : errno;
}

}  // namespace

PartialPath::PartialPath(Folder folder, std::string name)
    : folder_(std::move(folder)), name_(std::move(name)), temporary_(name_ + ".partial") {}

PartialPath::PartialPath(const std::filesystem::path& path)
    : PartialPath(Folder(path.parent_path()), path.filename().string()) {}

PartialPath::~PartialPath() {
  const bool is_ours = file_ < 0 || FileIdentity(folder_.descriptor(), temporary_) == FileIdentity(file_);
  if (!kept_ && is_ours && folder_.has_lock()) ::unlinkat(folder_.descriptor(), temporary_.c_str(), 0);
  // A library that could not write it may have it open, and keep the room that it takes.
  if (!kept_ && file_ >= 0) std::ignore = ::ftruncate(file_, 0);
  if (file_ >= 0) ::close(file_);
}

int PartialPath::open() {
  folder_.require_lock();
  const int in_the_way = ::unlinkat(folder_.descriptor(), temporary_.c_str(), 0) == 0 ? 0 : errno;
  file_ = ::openat(folder_.descriptor(), temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file_ < 0) throw cannot_write(path(), errno == EEXIST && in_the_way != 0 ? in_the_way : errno);
  return file_;
}

std::string name_left_behind(const Folder& folder, const std::string& name) {
  for (const std::string& left : {name + ".partial", name})
    if (FileIdentity(folder.descriptor(), left) != FileIdentity()) return left;
  throw Error("{} is not there", (folder.path() / name).string());
}

int PartialPath::reopen() {
  folder_.require_lock();
  const std::string left = name_left_behind(folder_, name_);
  kept_ = true;
  if (left == name_ && ::renameat(folder_.descriptor(), name_.c_str(), folder_.descriptor(), temporary_.c_str()) != 0)
    throw cannot_write(path(), errno);
  return file_ = open_file(folder_, temporary_, O_RDWR);
}

void PartialPath::sync() {
  if (const int failure = failure_to_sync(::fdatasync(file_)); failure != 0) throw cannot_write(path(), failure);
}

FileMark PartialPath::mark() const {
  FileMark mark;
  const ::off_t end = ::lseek(file_, 0, SEEK_END);
  if (end < 0 || !extend(mark, static_cast<std::uint64_t>(end), file_)) throw cannot_write(path(), errno);
  return mark;
}

void PartialPath::commit() { commit_as(folder_, name_); }

void PartialPath::commit_as(const Folder& folder, const std::string& name) {
  folder_.require_lock();
  const std::filesystem::path wanted = folder.path() / name;
  int failure = 0;
  // Written by another program, or by a run that was killed.
  if (file_ < 0)
    file_ = ::openat(folder_.descriptor(), temporary_.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
  if (file_ >= 0) {
    const FileIdentity ours(file_);
    if (ours != FileIdentity() && ours != FileIdentity(folder_.descriptor(), temporary_))
      throw Error("cannot write {}: {} was removed or replaced while it was being written", wanted.string(),
                  temporary_);
    // Before the name: after a power cut there would be a file of this name without its bytes.
    failure = failure_to_sync(::fdatasync(file_));
    // Some file systems tell only here that there was no room.
    if (::close(std::exchange(file_, -1)) != 0 && failure == 0) failure = errno;
    if (failure != 0 && !kept_) throw cannot_write(wanted, failure);
  }
  if (::renameat(folder_.descriptor(), temporary_.c_str(), folder.descriptor(), name.c_str()) != 0)
    throw cannot_write(wanted, errno);
  kept_ = true;
  if (failure == 0) failure = failure_to_sync(::fsync(folder.descriptor()));
  if (failure != 0) throw cannot_write(wanted, failure);
}

AtomicFile::AtomicFile(const Folder& folder, const std::string& name) : path_(folder, name), file_(path_.open()) {}
AtomicFile::AtomicFile(const std::filesystem::path& path) : path_(path), file_(path_.open()) {}

AtomicFile::AtomicFile(const Folder& folder, const std::string& name, const FileMark& mark)
    : path_(folder, name), file_(path_.reopen()), marked_(mark), keeps_lines_(true) {
  if (::ftruncate(file_, static_cast<::off_t>(mark.length)) != 0 ||
      ::lseek(file_, static_cast<::off_t>(mark.length), SEEK_SET) < 0)
    throw cannot_write(path_.path(), errno);
}

namespace {

std::string complaint(const Folder& folder, const std::string& name, const FileMark& mark, bool is_whole) {
  const int file = open_file(folder, name, O_RDONLY);
  FileMark found;
  const bool is_long_enough = extend(found, mark.length, file);
  const ::off_t end = ::lseek(file, 0, SEEK_END);
  ::close(file);
  if (is_long_enough && is_whole) found.length = static_cast<std::uint64_t>(std::max<::off_t>(end, 0));
  if (found.length != mark.length)
    return fmt::format("{} has {} bytes, and had {} at the checkpoint", name, found.length, mark.length);
  return found.checksum == mark.checksum ? "" : fmt::format("{} is not what it was at the checkpoint", name);
}

}  // namespace

std::string complaint_about(const Folder& folder, const std::string& name, const FileMark& mark) {
  return complaint(folder, name_left_behind(folder, name), mark, false);
}

std::string complaint_about_whole(const Folder& folder, const std::string& name, const FileMark& mark) {
  return complaint(folder, name, mark, true);
}

void AtomicFile::sync() {
  flush();
  path_.sync();
}

FileMark AtomicFile::mark() {
  sync();
  const ::off_t end = ::lseek(file_, 0, SEEK_CUR);
  if (end < 0 || !extend(marked_, static_cast<std::uint64_t>(end), file_)) throw cannot_write(path_.path(), errno);
  return marked_;
}

AtomicFile::~AtomicFile() {
  try {
    if (keeps_lines_) flush();
  } catch (const std::exception&) {  // those that are there stay
    failure_ = EIO;
  }
}

void AtomicFile::keep_lines() {
  keeps_lines_ = true;
  path_.keep();
}

void AtomicFile::write(std::string_view text) {
  if (waiting_.capacity() < buffer) waiting_.reserve(2 * buffer);  // once, and not again while rows are recorded
  if (text.size() < buffer) {
    waiting_ += text;
    if (waiting_.size() >= buffer) flush();
  } else {
    flush();
    write_through(text);
  }
}

void AtomicFile::flush() { write_through(waiting_); }

void AtomicFile::write_through(std::string_view text) {
  while (failure_ == 0 && !text.empty()) {
    const ::ssize_t size = ::write(file_, text.data(), text.size());
    if (size > 0) {
      text.remove_prefix(static_cast<std::size_t>(size));
    } else if (size == 0) {
      failure_ = ENOSPC;  // nothing was written, and nothing would be if it were tried again
    } else if (errno != EINTR) {
      failure_ = errno;
    }
  }
  waiting_.clear();
  if (failure_ != 0) throw cannot_write(path_.path(), failure_);
}

void AtomicFile::commit() {
  flush();
  path_.commit();
}

void AtomicFile::commit_lines() {
  path_.keep();
  const bool was_said = failure_ != 0;
  std::string failure;
  try {
    flush();
  } catch (const Error& error) {
    failure = error.what();
  }
  if (failure_ != 0 && ::ftruncate(file_, static_cast<::off_t>(end_of_lines(file_))) != 0)
    throw cannot_write(path_.path(), errno);
  path_.commit();
  if (!failure.empty() && !was_said) throw Error("{}", failure);
}

void write_file(const Folder& folder, const std::string& name, std::string_view text) {
  AtomicFile file(folder, name);
  file.write(text);
  file.commit();
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  write_file(Folder(path.parent_path()), path.filename().string(), text);
}

void rename_file(const Folder& folder, const std::string& from, const std::string& to) {
  folder.require_lock();
  if (::renameat(folder.descriptor(), from.c_str(), folder.descriptor(), to.c_str()) != 0 && errno != ENOENT)
    throw cannot_write(folder.path() / to, errno);
}

std::string put_aside(const Folder& folder, const std::string& name, const std::string& kept) {
  const std::filesystem::path wanted = kept;
  std::string free = kept;
  for (int n = 2; FileIdentity(folder.descriptor(), free) != FileIdentity(); ++n)
    free = fmt::format("{}_{}{}", wanted.stem().string(), n, wanted.extension().string());
  rename_file(folder, name, free);
  return free;
}

void remove_file(const Folder& folder, const std::string& name) noexcept {
  try {
    folder.require_lock();
    ::unlinkat(folder.descriptor(), name.c_str(), 0);
  } catch (const std::exception&) {  // another run's
  }
}

void make_directory(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw Error("cannot make the directory {}: {}", path.string(), std::strerror(error.value()));
  // create_directories is content with a regular file of that name.
  if (!std::filesystem::is_directory(path, error)) throw cannot_write(path, error ? error.value() : ENOTDIR);
}

}  // namespace seiche
