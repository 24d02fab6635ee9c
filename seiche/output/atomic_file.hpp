// A file that appears whole or not at all: written under a temporary name beside the final one, renamed on commit.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace seiche {

// The temporary name, for whoever writes the file; without commit, the temporary is removed at the end.
class PartialPath {
 public:
  explicit PartialPath(std::filesystem::path path);
  ~PartialPath();
  PartialPath(const PartialPath&) = delete;
  PartialPath& operator=(const PartialPath&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& temporary() const { return temporary_; }
  void commit();  // throws Error where it cannot be renamed

 private:
  std::filesystem::path path_, temporary_;
  bool committed_ = false;
};

// Every failure throws Error with the path and the reason of the operating system.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);  // without commit, an earlier file stays as it was

  void write(std::string_view text);  // buffered; memory does not grow with the file
  void commit();
  // For tables that grow row by row: those that were written before there was no more room are kept. Throws, as write does,
  // unless write has said so before.
  void commit_lines();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  PartialPath path_;
  std::unique_ptr<std::FILE, Close> file_;
  bool failed_ = false;
};

void write_file(const std::filesystem::path& path, std::string_view text);

// With its parents; fine if it exists.
void make_directory(const std::filesystem::path& path);

}  // namespace seiche
