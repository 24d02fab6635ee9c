#include <seiche/core/base/error.hpp>
#include <seiche/driver/processes.hpp>
#include <seiche/version.hpp>

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace seiche {
namespace {

namespace fs = std::filesystem;

constexpr const char* library_name = "libseiche_mpi.so";

// Beside the program or the library that this is a part of, and where it is installed from there.
std::vector<fs::path> places() {
  std::vector<fs::path> folders;
  std::error_code none;
  folders.push_back(fs::canonical("/proc/self/exe", none).parent_path());
  Dl_info here = {};
  if (::dladdr(reinterpret_cast<const void*>(&started_processes), &here) != 0 && here.dli_fname != nullptr)
    folders.push_back(fs::canonical(here.dli_fname, none).parent_path());
  std::vector<fs::path> all;
  for (const fs::path& folder : folders)
    if (folder.is_absolute())
      for (const char* inside : {"", SEICHE_MODULES, "seiche"}) all.push_back(folder / inside / library_name);
  return all;
}

}  // namespace

int started_processes() {
  if (const char* const alone = std::getenv("SEICHE_ALONE"); alone != nullptr && *alone != '\0') return 1;
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* const text = std::getenv(name)) return std::atoi(text);
  return 1;
}

std::unique_ptr<Processes> join_processes() {
  for (const fs::path& file : places()) {
    std::error_code none;
    if (!fs::exists(file, none)) continue;
    // Parts of Open MPI that are loaded later look for what this one has loaded.
    void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (library == nullptr) throw Error("{} cannot be loaded: {}", file.string(), ::dlerror());
    const auto version = reinterpret_cast<const char* (*)()>(::dlsym(library, "seiche_mpi_version"));
    const auto join = reinterpret_cast<Processes* (*)()>(::dlsym(library, "seiche_mpi_processes"));
    if (version == nullptr || join == nullptr || std::string_view(version()) != version_commit)
      throw Error("{} is of another version of Seiche than this program", file.string());
    return std::unique_ptr<Processes>(join());
  }
  throw Error(
      "{} processes were started, and this copy of Seiche knows only one: it was built without MPI (Debian packages "
      "libopenmpi-dev and openmpi-bin)",
      started_processes());
}

}  // namespace seiche
