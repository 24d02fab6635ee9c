// A file that appears whole or not at all: written under a temporary name beside the final one, renamed on commit.
#pragma once

#include <seiche/output/file/folder.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace seiche {

// The temporary name, for whoever writes the file; without commit, the temporary is removed at the end.
class PartialPath {
 public:
  PartialPath(Folder folder, std::string name);
  explicit PartialPath(const std::filesystem::path& path);
  ~PartialPath();
  PartialPath(const PartialPath&) = delete;
  PartialPath& operator=(const PartialPath&) = delete;

  const Folder& folder() const { return folder_; }
  std::filesystem::path path() const { return folder_.path() / name_; }
  std::filesystem::path temporary() const { return folder_.path() / temporary_; }

  // The temporary file, new and empty, to be read and written; whatever had its name is gone, and links are not
  // followed. Open as long as the object lives. Throws Error with the path and the reason.
  int open();
  void keep() {
    kept_ = true;
  }  // from now on the temporary stays also without commit: it holds what cannot be had again
  // Throws Error where it cannot be renamed, or is no longer the file that was opened; then it stays as it is.
  void commit();

 private:
  Folder folder_;
  std::string name_, temporary_;
  int file_ = -1;
  bool kept_ = false;  // or committed
};

// Every failure throws Error with the path and the reason of the operating system.
class AtomicFile {
 public:
  AtomicFile(const Folder& folder, const std::string& name);  // without commit, an earlier file stays as it was
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view text);  // buffered; memory does not grow with the file
  void flush();
  void commit();
  // For tables that grow row by row. From now on the rows stay, as NAME.partial without commit.
  void keep_lines();
  // Those that were written before there was no more room are kept. Throws, as write does, unless write has said so
  // before.
  void commit_lines();

 private:
  PartialPath path_;
  int file_;
  std::string waiting_;
  int failure_ = 0;  // its number
  bool keeps_lines_ = false;
};

void write_file(const Folder& folder, const std::string& name, std::string_view text);
void write_file(const std::filesystem::path& path, std::string_view text);

// Fine if there is none; not where the lock of the folder is no longer ours.
void remove_file(const Folder& folder, const std::string& name) noexcept;

// The end of the last line that has one; what is behind it was torn off by a full disk or the end of the program.
std::uintmax_t end_of_lines(const std::filesystem::path& path);

// With its parents; fine if it exists.
void make_directory(const std::filesystem::path& path);

}  // namespace seiche
