// A folder for what is read as long as a program runs.
#pragma once

#include <filesystem>

namespace seiche {

class TemporaryFolder {
 public:
  // Empty, and for this user alone: in `near`, to whose files links can be made there, or else where the system
  // keeps such, TMPDIR or /tmp. What programs that were killed have left in `near` is removed. Throws Error where
  // it cannot be made.
  explicit TemporaryFolder(const std::filesystem::path& near);
  ~TemporaryFolder();  // with all that is in it
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace seiche
