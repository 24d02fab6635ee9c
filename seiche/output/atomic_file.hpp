// A file that appears whole or not at all: written under a temporary name beside the final one, renamed on commit.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

namespace seiche {

// Every failure throws Error with the path and the reason of the operating system.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();  // without commit, the temporary is removed and an earlier file stays as it was
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view text);  // buffered; memory does not grow with the file
  void commit();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_, temporary_;
  std::unique_ptr<std::FILE, Close> file_;
};

void write_file(const std::filesystem::path& path, std::string_view text);

// With its parents; fine if it exists.
void make_directory(const std::filesystem::path& path);

}  // namespace seiche
