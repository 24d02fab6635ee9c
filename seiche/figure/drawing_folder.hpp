// Pictures appear whole or not at all: drawn in a folder of their own, and moved to their places when all are there.
#pragma once

#include <filesystem>

namespace seiche {

class DrawingFolder {
 public:
  // <target>/.drawing, empty; `target` is made where it is missing. Throws Error where it cannot be.
  explicit DrawingFolder(std::filesystem::path target);
  ~DrawingFolder();  // what was not moved is gone
  DrawingFolder(const DrawingFolder&) = delete;
  DrawingFolder& operator=(const DrawingFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void commit();  // every file in it and in its folders takes the place of one in `target`

 private:
  std::filesystem::path target_, path_;
};

}  // namespace seiche
