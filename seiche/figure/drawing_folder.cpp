#include <seiche/core/base/error.hpp>
#include <seiche/figure/drawing_folder.hpp>
#include <seiche/output/file/atomic_file.hpp>

#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

namespace seiche {
namespace fs = std::filesystem;

DrawingFolder::DrawingFolder(fs::path target) : target_(std::move(target)), path_(target_ / ".drawing") {
  std::error_code ignored;
  fs::remove_all(path_, ignored);  // of a program that was killed
  make_directory(path_);
}

DrawingFolder::~DrawingFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void DrawingFolder::commit() {
  std::vector<fs::path> drawn;  // listed first, since moving changes what is listed
  std::error_code error;
  for (const auto& entry : fs::recursive_directory_iterator(path_, error))
    if (entry.is_regular_file()) drawn.push_back(entry.path().lexically_relative(path_));
  if (error) throw Error("cannot read {}: {}", path_.string(), std::strerror(error.value()));
  for (const fs::path& file : drawn) {
    make_directory((target_ / file).parent_path());
    fs::rename(path_ / file, target_ / file, error);
    if (error) throw Error("cannot write {}: {}", (target_ / file).string(), std::strerror(error.value()));
  }
}

}  // namespace seiche
