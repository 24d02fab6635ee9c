#include <seiche/core/error.hpp>
#include <seiche/output/file/temporary_folder.hpp>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

namespace seiche {

TemporaryFolder::TemporaryFolder() {
  std::error_code unknown;
  std::string name = std::filesystem::temp_directory_path(unknown) / "seiche-XXXXXX";
  if (unknown || ::mkdtemp(name.data()) == nullptr)
    throw Error("cannot make a temporary folder: {}", unknown ? unknown.message() : std::strerror(errno));
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace seiche
