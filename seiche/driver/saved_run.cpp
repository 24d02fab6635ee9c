#include <seiche/core/error.hpp>
#include <seiche/driver/saved_run.hpp>
#include <seiche/output/file/checksum.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

namespace seiche {
namespace {

constexpr std::string_view format = "Seiche checkpoint 3\n", of_any_version = "Seiche checkpoint ";

struct Tail {
  std::uint64_t length;
  std::uint64_t checksum;
};

// The next bytes; fewer where the file has become shorter meanwhile.
std::string read(std::ifstream& in, std::uintmax_t size) {
  std::string bytes(size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

}  // namespace

void SavedRun::archive(Archive& a) {
  std::vector<std::string> files, sums;
  for (const auto& [file, sum] : hashes) {
    files.push_back(file);
    sums.push_back(sum);
  }
  a(versions, case_text, files, sums, notes, resumed_at, t, steps, energies, solution);
  for (std::size_t i = 0; i < std::min(files.size(), sums.size()); ++i) hashes[files[i]] = sums[i];
  a.require(solution.in_last <= solution.rows && files.size() == sums.size());
}

void write_checkpoint(AtomicFile& file, SavedRun& saved, FunctionRef<void(Archive&)> rest) {
  Tail tail{.length = 0, .checksum = checksum_of_nothing};
  file.write(format);
  Archive archive([&](std::string_view bytes) {
    tail.length += bytes.size();
    tail.checksum = checksum(bytes, static_cast<std::uint32_t>(tail.checksum));
    file.write(bytes);
  });
  archive(saved);
  rest(archive);
  file.write({reinterpret_cast<const char*>(&tail), sizeof(tail)});
}

bool is_checkpoint(const std::filesystem::path& file) {
  // To look into a pipe would wait for its writer, and take the bytes from whoever reads it next.
  if (std::error_code none; !std::filesystem::is_regular_file(file, none)) return false;
  std::ifstream in(file, std::ios::binary);
  return in && read(in, of_any_version.size()) == of_any_version;
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  std::error_code none;
  std::ifstream in;
  if (std::filesystem::is_regular_file(file, none)) in.open(file, std::ios::binary);
  if (!in.is_open()) throw Error("{} cannot be read", file.string());
  const std::uintmax_t size = std::filesystem::file_size(file);
  const std::string first = read(in, std::min<std::uintmax_t>(size, format.size()));
  if (first != format) throw Error("{} is no checkpoint of this version of Seiche", file.string());
  Tail tail{};
  if (size < format.size() + sizeof(tail)) throw Error("{} is damaged: it ends after {} bytes", file.string(), size);
  std::string bytes = read(in, size - format.size() - sizeof(tail));
  const std::string last = read(in, sizeof(tail));
  if (last.size() == sizeof(tail)) std::memcpy(&tail, last.data(), sizeof(tail));
  if (tail.length != bytes.size())
    throw Error("{} is damaged: its last bytes are missing, or belong to another", file.string());
  if (checksum(bytes) != tail.checksum) throw Error("{} is damaged: its checksum is another", file.string());
  Checkpoint found{.name = file.filename().string(), .run = {}, .rest = Archive(std::move(bytes))};
  found.rest(found.run);
  return found;
}

std::string complaint_about(const Folder& folder, const SavedRun& run) {
  std::string of_energies = EnergyTrace::complaint(folder, run.energies);
  return of_energies.empty() ? SolutionFile::complaint(folder, run.solution) : of_energies;
}

Checkpoint newest_checkpoint(const Folder& folder, std::vector<std::string>& notes) {
  for (const char* name : {checkpoint_name, earlier_checkpoint_name}) {
    const std::filesystem::path file = folder.path() / name;
    if (!std::filesystem::exists(file)) continue;
    try {
      Checkpoint found = read_checkpoint(file);
      const std::string said = complaint_about(folder, found.run);
      if (said.empty()) return found;
      notes.push_back(fmt::format("{} is of no use: {}", name, said));
    } catch (const Error& error) {
      notes.push_back(fmt::format("{} is of no use: {}", name, error.what()));
    }
  }
  if (notes.empty()) throw Error("{} holds no checkpoint, from which a run could go on", folder.path().string());
  throw Error("no run can go on from {}: {}", folder.path().string(), fmt::join(notes, "; "));
}

bool has_checkpoint(const std::filesystem::path& directory) {
  return std::filesystem::exists(directory / checkpoint_name) ||
         std::filesystem::exists(directory / earlier_checkpoint_name);
}

void remove_checkpoints(const Folder& folder) {
  for (const char* name : {checkpoint_name, earlier_checkpoint_name}) remove_file(folder, name);
}

}  // namespace seiche
