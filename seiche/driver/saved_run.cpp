#include <seiche/core/error.hpp>
#include <seiche/driver/saved_run.hpp>
#include <seiche/output/file/checksum.hpp>

#include <fcntl.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace seiche {
namespace {

constexpr std::string_view format = "Seiche checkpoint 5\n", of_any_version = "Seiche checkpoint ";

// By its name: a link that leads nowhere is no checkpoint, and a word about it is due.
bool is_there(const std::filesystem::path& file) {
  std::error_code none;
  return std::filesystem::exists(std::filesystem::symlink_status(file, none));
}

struct Tail {
  std::uint64_t length;
  std::uint64_t checksum;
};

// What a checkpoint holds between its first line and its last bytes, which close it.
class Body {
 public:
  explicit Body(AtomicFile& file) : file_(file) { file_.write(format); }
  void write(std::string_view bytes) {
    tail_.length += bytes.size();
    tail_.checksum = checksum(bytes, static_cast<std::uint32_t>(tail_.checksum));
    file_.write(bytes);
  }
  void close() { file_.write({reinterpret_cast<const char*>(&tail_), sizeof(tail_)}); }

 private:
  AtomicFile& file_;
  Tail tail_{.length = 0, .checksum = checksum_of_nothing};
};

// A file that is one: no pipe, which would be waited for, no device, which has no end, and no link.
class PlainFile {
 public:
  explicit PlainFile(const std::filesystem::path& path)
      : file_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC)) {
    struct stat status = {};
    std::string complaint;
    if (file_ < 0) {
      complaint = errno == ELOOP ? "is a link" : fmt::format("cannot be read: {}", std::strerror(errno));
    } else if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode)) {
      complaint = S_ISDIR(status.st_mode) ? "is a folder" : "is not a file";
      ::close(file_);
    }
    if (!complaint.empty()) throw Error("{} {}", path.string(), complaint);
    size_ = static_cast<std::uint64_t>(status.st_size);
  }
  ~PlainFile() { ::close(file_); }
  PlainFile(const PlainFile&) = delete;
  PlainFile& operator=(const PlainFile&) = delete;

  std::uint64_t size() const { return size_; }
  // Fewer than `most` where the file ends.
  std::string read(std::uint64_t at, std::uint64_t most) const {
    std::string bytes(std::min(most, size_ - std::min(at, size_)), '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ::ssize_t size = ::pread(file_, bytes.data() + done, bytes.size() - done, static_cast<::off_t>(at + done));
      if (size == 0 || (size < 0 && errno != EINTR)) break;
      done += size < 0 ? 0 : static_cast<std::size_t>(size);
    }
    bytes.resize(done);
    return bytes;
  }

 private:
  int file_;
  std::uint64_t size_ = 0;
};

constexpr std::uint64_t piece = std::uint64_t{1} << 20U;

// Piece by piece: of a file whose checksum is wrong nothing is kept.
std::uint32_t checksum_of(const PlainFile& file, std::uint64_t begin, std::uint64_t length) {
  std::uint32_t found = checksum_of_nothing;
  for (std::uint64_t done = 0; done < length; done += piece)
    found = checksum(file.read(begin + done, std::min(piece, length - done)), found);
  return found;
}

std::uint64_t archived_size(SavedRun run) {
  std::uint64_t size = 0;
  Archive archive([&size](std::string_view bytes) { size += bytes.size(); });
  archive(run);
  return size;
}

}  // namespace

void SavedRun::archive(Archive& a) {
  std::vector<std::string> files, sums;
  for (const auto& [file, sum] : hashes) {
    files.push_back(file);
    sums.push_back(sum);
  }
  a(versions, case_text, files, sums, notes, resumed_at, resumed_with, new_end, t, steps, energies, solution);
  for (std::size_t i = 0; i < std::min(files.size(), sums.size()); ++i) hashes[files[i]] = sums[i];
  a.require(solution.in_last <= solution.rows && files.size() == sums.size() &&
            resumed_at.size() == resumed_with.size());
}

void write_checkpoint(AtomicFile& file, SavedRun& saved, FunctionRef<void(Archive&)> rest) {
  Body body(file);
  Archive archive([&body](std::string_view bytes) { body.write(bytes); });
  archive(saved);
  rest(archive);
  body.close();
}

void write_new_end(const Folder& folder, const std::string& case_text, double t_end) {
  for (const char* name : {earlier_checkpoint_name, checkpoint_name}) {
    std::optional<PlainFile> in;
    SavedRun run;
    try {
      in.emplace(folder.path() / name);
      run = read_checkpoint(folder.path() / name).run;
    } catch (const Error&) {  // it is not there, or of no use
      continue;
    }
    const std::uint64_t begin = format.size() + archived_size(run), end = in->size() - sizeof(Tail);
    run.case_text = case_text;
    run.hashes["case.toml"] = sha256(case_text);
    run.new_end = t_end;
    AtomicFile out(folder, name);
    Body body(out);
    Archive archive([&body](std::string_view bytes) { body.write(bytes); });
    archive(run);
    for (std::uint64_t at = begin; at < end; at += piece) body.write(in->read(at, std::min(piece, end - at)));
    body.close();
    out.commit();
  }
}

bool is_checkpoint(const std::filesystem::path& file) {
  // To look into a pipe would wait for its writer, and take the bytes from whoever reads it next.
  if (std::error_code none; !std::filesystem::is_regular_file(file, none)) return false;
  std::ifstream in(file, std::ios::binary);
  std::string bytes(of_any_version.size(), '\0');
  return in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) && bytes == of_any_version;
}

// The length at its end is compared before anything else is read: what has grown, or has a hole, has another one.
Checkpoint read_checkpoint(const std::filesystem::path& file) {
  const PlainFile in(file);
  if (in.read(0, format.size()) != format) throw Error("{} is no checkpoint of this version of Seiche", file.string());
  Tail tail{};
  if (in.size() < format.size() + sizeof(tail))
    throw Error("{} is damaged: it ends after {} bytes", file.string(), in.size());
  const std::uint64_t length = in.size() - format.size() - sizeof(tail);
  const std::string last = in.read(format.size() + length, sizeof(tail));
  if (last.size() == sizeof(tail)) std::memcpy(&tail, last.data(), sizeof(tail));
  if (last.size() != sizeof(tail) || tail.length != length)
    throw Error("{} is damaged: its last bytes are missing, or belong to another", file.string());
  if (checksum_of(in, format.size(), length) != tail.checksum)
    throw Error("{} is damaged: its checksum is another", file.string());
  Checkpoint found{.name = file.filename().string(), .run = {}, .rest = Archive(in.read(format.size(), length))};
  found.rest(found.run);
  return found;
}

std::string case_of_checkpoint(const std::filesystem::path& directory) {
  for (const char* name : {checkpoint_name, earlier_checkpoint_name}) {
    try {
      return read_checkpoint(directory / name).run.case_text;
    } catch (const Error&) {  // the other one may serve
    }
  }
  return "";
}

std::string complaint_about(const Folder& folder, const SavedRun& run) {
  std::string of_energies = EnergyTrace::complaint(folder, run.energies);
  return of_energies.empty() ? SolutionFile::complaint(folder, run.solution) : of_energies;
}

Checkpoint newest_checkpoint(const Folder& folder, std::vector<std::string>& notes) {
  for (const char* name : {checkpoint_name, earlier_checkpoint_name}) {
    const std::filesystem::path file = folder.path() / name;
    if (!is_there(file)) continue;
    try {
      Checkpoint found = read_checkpoint(file);
      const std::string said = complaint_about(folder, found.run);
      if (said.empty()) return found;
      notes.push_back(fmt::format("{} is of no use: {}", name, said));
    } catch (const Error& error) {
      notes.push_back(fmt::format("{} is of no use: {}", name, error.what()));
    }
  }
  if (notes.empty())
    throw Error(
        "{} holds no checkpoint, from which a run could go on; another one may begin with initial = {{ file = \"final.txt\" "
        "}}",
        folder.path().string());
  throw Error("no run can go on from {}: {}", folder.path().string(), fmt::join(notes, "; "));
}

bool has_checkpoint(const std::filesystem::path& directory) {
  return is_there(directory / checkpoint_name) || is_there(directory / earlier_checkpoint_name);
}

void remove_checkpoints(const Folder& folder) {
  for (const char* name : {checkpoint_name, earlier_checkpoint_name}) remove_file(folder, name);
}

}  // namespace seiche
