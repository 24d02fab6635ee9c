#include <seiche/core/base/error.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/file/checksum.hpp>
#include <seiche/record/checkpoint_file.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <exception>
#include <fstream>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>

namespace seiche {
namespace {

constexpr std::string_view format = "Seiche checkpoint 10\n", of_any_version = "Seiche checkpoint ";
constexpr std::uint64_t piece = std::uint64_t{1} << 20U;

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
    bytes.resize(read(at, std::span<char>(bytes)));
    return bytes;
  }
  // Returns how many there were.
  std::size_t read(std::uint64_t at, std::span<char> bytes) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ::ssize_t size = ::pread(file_, bytes.data() + done, bytes.size() - done, static_cast<::off_t>(at + done));
      if (size == 0 || (size < 0 && errno != EINTR)) break;
      done += size < 0 ? 0 : static_cast<std::size_t>(size);
    }
    return done;
  }

 private:
  int file_;
  std::uint64_t size_ = 0;
};

// Piece by piece: of a file whose checksum is wrong nothing is kept.
std::uint32_t checksum_of(const PlainFile& file, std::uint64_t begin, std::uint64_t length) {
  std::uint32_t found = checksum_of_nothing;
  for (std::uint64_t done = 0; done < length; done += piece)
    found = checksum(file.read(begin + done, std::min(piece, length - done)), found);
  return found;
}

}  // namespace

void commit_checkpoint(const Folder& folder, bool keeps_earlier, FunctionRef<void(Archive&)> contents) {
  std::optional<AtomicFile> file;
  std::optional<Body> body;
  std::exception_ptr failure;
  const auto attempt = [&failure](const auto& action) {
    if (failure) return;
    try {
      action();
    } catch (...) {
      failure = std::current_exception();
    }
  };
  attempt([&] { body.emplace(file.emplace(folder, checkpoint_name)); });
  Archive archive([&](std::string_view bytes) { attempt([&] { body->write(bytes); }); });
  contents(archive);
  if (failure) std::rethrow_exception(failure);
  body->close();
  file->sync();  // before the one that it replaces loses its name
  if (keeps_earlier) rename_file(folder, checkpoint_name, earlier_checkpoint_name);
  file->commit();
}

// The length at its end is compared before anything else is read: what has grown, or has a hole, has another one.
Archive read_checkpoint_file(const std::filesystem::path& file, bool is_checked) {
  const auto held = std::make_shared<const PlainFile>(file);
  const PlainFile& in = *held;
  if (in.read(0, format.size()) != format) throw Error("{} is no checkpoint of this version of Seiche", file.string());
  Tail tail{};
  if (in.size() < format.size() + sizeof(tail))
    throw Error("{} is damaged: it ends after {} bytes", file.string(), in.size());
  const std::uint64_t length = in.size() - format.size() - sizeof(tail);
  const std::string last = in.read(format.size() + length, sizeof(tail));
  if (last.size() == sizeof(tail)) std::memcpy(&tail, last.data(), sizeof(tail));
  if (last.size() != sizeof(tail) || tail.length != length)
    throw Error("{} is damaged: its last bytes are missing, or belong to another", file.string());
  if (!is_checked && checksum_of(in, format.size(), length) != tail.checksum)
    throw Error("{} is damaged: its checksum is another", file.string());
  // What is small is read from a piece that was read at once.
  struct Piece {
    std::uint64_t at = 0;
    std::string bytes = {};
  };
  constexpr std::uint64_t longest = std::uint64_t{1} << 16U;
  return Archive(length, [held, file, part = Piece()](std::uint64_t at, std::span<char> to) mutable {
    if (to.size() >= longest) {
      if (held->read(format.size() + at, to) != to.size()) throw Error("{} cannot be read", file.string());
      return;
    }
    if (at < part.at || at + to.size() > part.at + part.bytes.size())
      part = {.at = at, .bytes = held->read(format.size() + at, longest)};
    if (part.bytes.size() < to.size()) throw Error("{} cannot be read", file.string());
    std::copy_n(part.bytes.begin() + static_cast<std::ptrdiff_t>(at - part.at), to.size(), to.begin());
  });
}

void replace_beginning(const Folder& folder, const std::string& name, std::uint64_t bytes,
                       FunctionRef<void(Archive&)> contents) {
  const PlainFile in(folder.path() / name);
  const std::uint64_t end = in.size() - std::min<std::uint64_t>(in.size(), sizeof(Tail));
  AtomicFile out(folder, name);
  Body body(out);
  Archive archive([&body](std::string_view written) { body.write(written); });
  contents(archive);
  for (std::uint64_t at = format.size() + bytes; at < end; at += piece) {
    const std::string part = in.read(at, std::min(piece, end - at));
    if (part.size() != std::min(piece, end - at))
      throw Error("{} cannot be read to its end", (folder.path() / name).string());
    body.write(part);
  }
  body.close();
  out.commit();
}

bool is_checkpoint(const std::filesystem::path& file) {
  // To look into a pipe would wait for its writer, and take the bytes from whoever reads it next.
  if (std::error_code none; !std::filesystem::is_regular_file(file, none)) return false;
  std::ifstream in(file, std::ios::binary);
  std::string bytes(of_any_version.size(), '\0');
  return in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) && bytes == of_any_version;
}

std::vector<std::string> checkpoints_in(const std::filesystem::path& directory) {
  std::vector<std::string> names;
  for (const char* name : {checkpoint_name, earlier_checkpoint_name}) {
    std::error_code none;
    if (std::filesystem::exists(std::filesystem::symlink_status(directory / name, none))) names.emplace_back(name);
  }
  return names;
}

void promote_checkpoint(const Folder& folder, const std::string& name) {
  if (name != earlier_checkpoint_name) return;
  try {
    rename_file(folder, name, checkpoint_name);
  } catch (const Error&) {  // a folder has that name
    return;
  }
}

void remove_checkpoints(const Folder& folder) {
  for (const char* name : {checkpoint_name, earlier_checkpoint_name}) remove_file(folder, name);
}

}  // namespace seiche
