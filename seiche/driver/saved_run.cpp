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
  a.require(solution.in_chunk <= solution.rows && files.size() == sums.size());
}

std::string checkpoint_bytes(const Archive& archive) {
  const Head head{.length = archive.bytes().size(), .checksum = checksum(archive.bytes())};
  std::string bytes(format);
  bytes.reserve(format.size() + sizeof(head) + archive.bytes().size());
  bytes.append(reinterpret_cast<const char*>(&head), sizeof(head));
  return bytes += archive.bytes();
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error("{} cannot be read", file.string());
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  Head head{};
  const std::size_t begin = format.size() + sizeof(head);
  if (!std::string_view(bytes).starts_with(format))
    throw Error("{} is no checkpoint of this version of Seiche", file.string());
  if (bytes.size() >= begin) std::memcpy(&head, bytes.data() + format.size(), sizeof(head));
  if (bytes.size() < begin || head.length != bytes.size() - begin)
    throw Error("{} is damaged: {} bytes are missing or too many", file.string(), head.length);
  bytes.erase(0, begin);
  if (checksum(bytes) != head.checksum) throw Error("{} is damaged: its checksum is another", file.string());
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
