#include <seiche/core/base/error.hpp>
#include <seiche/core/base/loaded_library.hpp>
#include <seiche/version.hpp>

#include <dlfcn.h>

#include <filesystem>
#include <string_view>
#include <system_error>

namespace seiche {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> places(const std::string& library, std::vector<std::string> inside) {
  inside.insert(inside.begin(), {"", SEICHE_MODULES, "seiche", SEICHE_MODULES "/.."});
  std::vector<fs::path> folders;
  std::error_code none;
  folders.push_back(fs::canonical("/proc/self/exe", none).parent_path());
  Dl_info here = {};
  if (::dladdr(reinterpret_cast<const void*>(&function_of_library), &here) != 0 && here.dli_fname != nullptr)
    folders.push_back(fs::canonical(here.dli_fname, none).parent_path());
  std::vector<fs::path> all;
  for (const fs::path& folder : folders)
    if (folder.is_absolute())
      for (const std::string& part : inside) all.push_back(folder / part / library);
  return all;
}

}  // namespace

void* function_of_library(const std::string& library, const char* version, const char* function,
                          const std::vector<std::string>& folders) {
  for (const fs::path& file : places(library, folders)) {
    std::error_code none;
    if (!fs::exists(file, none)) continue;
    // Parts of Open MPI that are loaded later look for what this one has loaded.
    void* const loaded = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (loaded == nullptr) throw Error("{} cannot be loaded: {}", file.string(), ::dlerror());
    const auto built_of = reinterpret_cast<const char* (*)()>(::dlsym(loaded, version));
    void* const found = ::dlsym(loaded, function);
    if (built_of == nullptr || found == nullptr || std::string_view(built_of()) != version_commit)
      throw Error("{} is of another version of Seiche than this program", file.string());
    return found;
  }
  return nullptr;
}

}  // namespace seiche
