#include <seiche/core/error.hpp>
#include <seiche/output/atomic_file.hpp>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

namespace seiche {
namespace {

Error cannot_write(const std::filesystem::path& path, int error_number) {
  return Error("cannot write {}: {}", path.string(), std::strerror(error_number));
}

// Bytes up to the end of the last line that has one.
std::uintmax_t whole_lines(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::uintmax_t end = 0;
  for (std::string line; std::getline(file, line) && !file.eof();) end += line.size() + 1;
  return end;
}

}  // namespace

PartialPath::PartialPath(std::filesystem::path path) : path_(std::move(path)), temporary_(path_) {
  temporary_ += ".partial";
}

PartialPath::~PartialPath() {
  if (committed_) return;
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void PartialPath::commit() {
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) throw cannot_write(path_, error.value());
  committed_ = true;
}

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)), file_(std::fopen(path_.temporary().c_str(), "wb")) {
  if (!file_) throw cannot_write(path_.path(), errno);
  std::setvbuf(file_.get(), nullptr, _IOFBF, 1 << 16);
}

void AtomicFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size()) return;
  failed_ = true;
  throw cannot_write(path_.path(), errno);
}

void AtomicFile::commit() {
  // Some file systems tell only at the end that there was no room.
  if (std::fclose(file_.release()) != 0) throw cannot_write(path_.path(), errno);
  path_.commit();
}

void AtomicFile::commit_lines() {
  const bool is_whole = std::fclose(file_.release()) == 0 && !failed_;
  const int reason = errno;
  if (!is_whole) {
    std::error_code error;
    std::filesystem::resize_file(path_.temporary(), whole_lines(path_.temporary()), error);
    if (error) throw cannot_write(path_.path(), error.value());
  }
  path_.commit();
  if (!is_whole && !failed_) throw cannot_write(path_.path(), reason);
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

void make_directory(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw Error("cannot make the directory {}: {}", path.string(), std::strerror(error.value()));
  // create_directories is content with a regular file of that name.
  if (!std::filesystem::is_directory(path, error)) throw cannot_write(path, error ? error.value() : ENOTDIR);
}

}  // namespace seiche
