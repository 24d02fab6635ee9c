// A folder for what is read once, where the system keeps such: TMPDIR, or /tmp.
#pragma once

#include <filesystem>

namespace seiche {

class TemporaryFolder {
 public:
  TemporaryFolder();   // empty, and for this user alone; throws Error where it cannot be made
  ~TemporaryFolder();  // with all that is in it
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace seiche
