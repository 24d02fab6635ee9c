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
std::vector<fs::path> places(std::vector<std::string> inside) {
  inside.insert(inside.begin(), {"", SEICHE_MODULES, "seiche"});
  std::vector<fs::path> folders;
  std::error_code none;
  folders.push_back(fs::canonical("/proc/self/exe", none).parent_path());
  Dl_info here = {};
  if (::dladdr(reinterpret_cast<const void*>(&started_processes), &here) != 0 && here.dli_fname != nullptr)
    folders.push_back(fs::canonical(here.dli_fname, none).parent_path());
  std::vector<fs::path> all;
  for (const fs::path& folder : folders)
    if (folder.is_absolute())
      for (const std::string& part : inside) all.push_back(folder / part / library_name);
  return all;
}

// What the library calls so; null where it is not there. Throws Error where it is another version's.
template <class Function>
Function* found(const char* name, const std::vector<std::string>& folders = {}) {
  for (const fs::path& file : places(folders)) {
    std::error_code none;
    if (!fs::exists(file, none)) continue;
    // Parts of Open MPI that are loaded later look for what this one has loaded.
    void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (library == nullptr) throw Error("{} cannot be loaded: {}", file.string(), ::dlerror());
    const auto version = reinterpret_cast<const char* (*)()>(::dlsym(library, "seiche_mpi_version"));
    auto* const function = reinterpret_cast<Function*>(::dlsym(library, name));
    if (version == nullptr || function == nullptr || std::string_view(version()) != version_commit)
      throw Error("{} is of another version of Seiche than this program", file.string());
    return function;
  }
  return nullptr;
}

constexpr const char* built_without =
    "this copy of Seiche knows only one: it was built without MPI (Debian packages libopenmpi-dev and openmpi-bin)";

}  // namespace

int started_processes() {
  if (const char* const alone = std::getenv("SEICHE_ALONE"); alone != nullptr && *alone != '\0') return 1;
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"})
    if (const char* const text = std::getenv(name)) return std::atoi(text);
  return 1;
}

std::unique_ptr<Processes> join_processes() {
  if (auto* const join = found<Processes*()>("seiche_mpi_processes")) return std::unique_ptr<Processes>(join());
  throw Error("{} processes were started, and {}", started_processes(), built_without);
}

std::unique_ptr<Ranks> ranks_of_communicator(int fortran_handle, const std::vector<std::string>& folders) {
  if (auto* const ranks = found<Ranks*(int)>("seiche_mpi_ranks", folders))
    return std::unique_ptr<Ranks>(ranks(fortran_handle));
  throw Error("comm stands for several processes, and {}", built_without);
}

}  // namespace seiche
