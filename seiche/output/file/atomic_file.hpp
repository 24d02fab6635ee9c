// A file that appears whole or not at all: written under a temporary name beside the final one, renamed on commit when
// its bytes are on the disk.
#pragma once

#include <seiche/output/file/checksum.hpp>
#include <seiche/output/file/folder.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace seiche {

// How far a file had been written when a checkpoint was made, and the CRC-32 of its bytes up to there.
struct FileMark {
  std::uint64_t length = 0;
  std::uint32_t checksum = checksum_of_nothing;
};

// The temporary name, for whoever writes the file; without commit, the temporary is removed at the end.
class PartialPath {
 public:
  PartialPath(Folder folder, std::string name);  // NAME.partial
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
  // What an earlier run has left under the temporary name, or else under the final one, which it then no longer has; to
  // be written on. Throws Error where there is neither, and for what is not a file: a pipe, a folder.
  int reopen();
  void sync();  // what has been written to it is on the disk then
  // Of what has been written to it. Throws Error where it cannot be read.
  FileMark mark() const;
  void keep() {
    kept_ = true;
  }  // from now on the temporary stays also without commit: it holds what cannot be had again
  // Throws Error where it cannot be renamed, or is no longer the file that was opened; then it stays as it is.
  void commit();
  // The same under another name, in a folder that has the lock of this one.
  void commit_as(const Folder& folder, const std::string& name);

 private:
  Folder folder_;
  std::string name_, temporary_;
  int file_ = -1;
  bool kept_ = false;  // or committed
};

// The name under which an earlier run has left it: NAME.partial, or else NAME. Throws Error where there is neither.
std::string name_left_behind(const Folder& folder, const std::string& name);

// Why the file that an earlier run has left does not begin with what the mark is of; "" where it does. Throws Error
// where it cannot be read, or is not a file.
std::string complaint_about(const Folder& folder, const std::string& name, const FileMark& mark);
// The same of a file that is final: under this name alone, and with nothing behind what the mark is of.
std::string complaint_about_whole(const Folder& folder, const std::string& name, const FileMark& mark);

// Every failure throws Error with the path and the reason of the operating system.
class AtomicFile {
 public:
  AtomicFile(const Folder& folder, const std::string& name);  // without commit, an earlier file stays as it was
  explicit AtomicFile(const std::filesystem::path& path);
  // Goes on behind the mark in the file that an earlier run has left, and cuts off what is there.
  AtomicFile(const Folder& folder, const std::string& name, const FileMark& mark);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view text);  // buffered; memory does not grow with the file
  void flush();
  void sync();      // what has been written is on the disk then
  FileMark mark();  // likewise, and its mark
  void commit();
  // For tables that grow row by row. From now on the rows stay, as NAME.partial without commit.
  void keep_lines();
  // Those that were written before there was no more room are kept. Throws, as write does, unless write has said so
  // before.
  void commit_lines();

 private:
  void write_through(std::string_view text);  // and nothing waits any more

  PartialPath path_;
  int file_;
  std::string waiting_;
  FileMark marked_;
  int failure_ = 0;  // its number
  bool keeps_lines_ = false;
};

void write_file(const Folder& folder, const std::string& name, std::string_view text);
void write_file(const std::filesystem::path& path, std::string_view text);

// Does nothing if `from` does not exist.
void rename_file(const Folder& folder, const std::string& from, const std::string& to);
// Renames it to `kept`, or where that name is taken, "a.toml", to "a_2.toml", "a_3.toml", …: the first that is free,
// which is returned.
std::string put_aside(const Folder& folder, const std::string& name, const std::string& kept);
// Does nothing if it does not exist, or where the lock of the folder is no longer ours.
void remove_file(const Folder& folder, const std::string& name) noexcept;

// With its parents; fine if it exists.
void make_directory(const std::filesystem::path& path);

}  // namespace seiche
