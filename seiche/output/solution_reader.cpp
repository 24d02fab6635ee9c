#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/input_file.hpp>
#include <seiche/output/solution_columns.hpp>
#include <seiche/output/solution_reader.hpp>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <string_view>

namespace seiche {
namespace {

template <class Call>
auto unless_interrupted(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream input(text);
  return {std::istream_iterator<std::string>(input), {}};
}

std::vector<double> all_of(const Hdf5Dataset& data) {
  std::vector<double> values(data.rows() * data.row_size());
  data.read(0, values);
  return values;
}

// So long may a processor take: damage can have HDF5 go round in circles.
::rlim_t longest_reading(const std::filesystem::path& solution) {
  namespace fs = std::filesystem;
  constexpr std::uintmax_t seconds = 2, bytes_per_second = 20'000'000, parts_per_second = 20;
  std::error_code unknown;
  const std::uintmax_t bytes = fs::file_size(solution, unknown);
  std::error_code no_folder;
  const auto parts = std::distance(fs::directory_iterator(solution.parent_path() / segments_folder, no_folder), {});
  return seconds + (unknown ? 0 : bytes / bytes_per_second) + static_cast<std::uintmax_t>(parts) / parts_per_second;
}

void set_limit(int resource, ::rlim_t wanted) {
  ::rlimit limit{};
  ::getrlimit(resource, &limit);
  limit.rlim_cur = std::min(limit.rlim_max, wanted);
  ::setrlimit(resource, &limit);
}

void end_at_first_fault(::rlim_t seconds) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) std::signal(signal, SIG_DFL);
  if (const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0)
    ::dup2(nowhere, STDERR_FILENO);  // what libraries say when they break down
  const ::rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  set_limit(RLIMIT_CPU, seconds);
}

// HDF5 keeps all of them open as long as the fields are; programs that draw inherit the limit.
void allow_open(std::size_t count) {
  constexpr std::size_t others = 256;
  ::unsetenv("HDF5_VDS_PREFIX");  // by which HDF5 would look elsewhere
  ::rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  set_limit(RLIMIT_NOFILE, std::max<::rlim_t>(files.rlim_cur, count + others));
}

}  // namespace

SolutionReader::SolutionReader(const std::filesystem::path& path)
    : SolutionReader(path, (what_another_process_finds(path), Unguarded())) {}

SolutionReader::SolutionReader(const std::filesystem::path& path, Unguarded)
    : file_(Hdf5File::open(path)),
      t_(file_.dataset("t")),
      H_(file_.dataset("H")),
      fields_(words(text_attribute(file_.id(), "fields"))) {
  for (const std::string& name : fields_) add_field(name, path);
  if (data_.empty()) throw Error("{} holds no field", path.string());
  if (file_.has("H_modified")) modified_ = file_.dataset("H_modified");
  require_own_parts(path);
  count_times(path);
  const Hdf5Shape& shape = data_.front().shape();
  const bool numbered = file_.has("point");
  for (std::size_t a = 1; a < shape.size(); ++a) {
    const std::string name = numbered ? "point" : std::string(1, static_cast<char>('x' + (a - 1)));
    axes_.push_back({name, all_of(file_.dataset(name))});
    if (axes_.back().values.size() != shape[a])
      throw Error("{} is damaged: {} has {} values for {} points", path.string(), name, axes_.back().values.size(),
                  shape[a]);
  }
  points_ = static_cast<Index>(data_.front().row_size());
}

void SolutionReader::add_field(const std::string& name, const std::filesystem::path& path) {
  data_.push_back(file_.dataset_or_virtual(name));
  meanings_.push_back(text_attribute(data_.back().id(), "long_name"));
  Hdf5Shape shape = data_.back().shape();
  shape.front() = data_.front().rows();
  if (shape != data_.front().shape())
    throw Error("{} is damaged: {} does not fit to {}", path.string(), name, fields_.front());
  const std::vector<Hdf5Source> sources = data_.back().sources();
  std::vector<std::filesystem::path> parts;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const Hdf5Source& source = sources[k];
    const bool is_last = k + 1 == sources.size();
    const bool is_here = source.file.empty() && source.dataset == fmt::format("{}/{}", rest_group, name) && is_last;
    const bool is_part =
        source.file == fmt::format("{}/{}", segments_folder, segment_name(k + 1)) && source.dataset == name;
    if (!is_here && !is_part)
      throw Error("{} is damaged: it shows {} in {}, where no solution has it", path.string(), source.dataset,
                  shortened(source.file));
    if (is_part) parts.push_back(path.parent_path() / source.file);
  }
  if (data_.size() == 1) parts_ = parts;
  if (parts != parts_) throw Error("{} is damaged: {} does not fit to {}", path.string(), name, fields_.front());
}

// Others are not read: they may be links to anything, and what HDF5 does not find it shows as NaN.
void SolutionReader::require_own_parts(const std::filesystem::path& path) const {
  namespace fs = std::filesystem;
  if (parts_.empty()) return;
  allow_open(parts_.size());
  std::error_code none;
  const auto kind = [&](const fs::path& of) { return fs::symlink_status(of, none).type(); };
  if (const fs::path folder = parts_.front().parent_path(); kind(folder) != fs::file_type::directory)
    throw Error("{} is not there, or is no folder, and {} shows what lies in it", folder.string(), path.string());
  const std::vector<Hdf5Source> sources = data_.front().sources();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    if (kind(parts_[k]) != fs::file_type::regular)
      throw Error("{} shows what lies in {}, which is not there, or is not a file", path.string(), parts_[k].string());
    const Hdf5File part = Hdf5File::open(parts_[k]);
    for (std::size_t f = 0; f < data_.size(); ++f) {
      Hdf5Shape shape = data_[f].shape();
      shape.front() = sources[k].rows;
      if (part.dataset(fields_[f]).shape() != shape)
        throw Error("{} has other rows of {} than are shown of it", parts_[k].string(), fields_[f]);
    }
  }
}

void SolutionReader::count_times(const std::filesystem::path& path) {
  const auto require_whole = [&](const Hdf5Dataset& data) {
    if (data.rows() != t_.rows())
      throw Error("{} is damaged: {} has {} rows, and t has {}", path.string(), data.name(), data.rows(), t_.rows());
  };
  require_whole(H_);
  if (modified_) require_whole(*modified_);
  for (const Hdf5Dataset& data : data_) require_whole(data);
  count_ = static_cast<Index>(t_.rows());
}

std::vector<double> SolutionReader::modified_energies() const {
  return modified_ ? first_of(*modified_) : std::vector<double>();
}

void SolutionReader::require_whole() const { file_.require_whole(fields_); }

std::vector<double> SolutionReader::first_of(const Hdf5Dataset& data) const {
  std::vector<double> values(static_cast<std::size_t>(count_));
  data.read(0, values);
  return values;
}

std::vector<Place> SolutionReader::places(const std::string& name) const {
  std::vector<Place> all;
  if (!on_points() || !file_.has(name)) return all;
  const std::vector<double> values = all_of(file_.dataset(name));
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) all.push_back({values[i], values[i + 1], values[i + 2]});
  return all;
}

std::vector<Place> SolutionReader::nodes() const { return places("mesh/points"); }
std::vector<Place> SolutionReader::supports() const { return places("mesh/supports"); }

std::vector<std::array<Index, 2>> SolutionReader::bars() const {
  std::vector<std::array<Index, 2>> all;
  if (!on_points() || !file_.has("mesh/bars")) return all;
  const Hdf5Dataset data = file_.dataset("mesh/bars");
  const std::vector<double> values = all_of(data);
  const double ends = static_cast<double>(nodes().size() + supports().size());
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    for (const double end : {values[i], values[i + 1]})
      if (!(end >= 0 && end < ends)) throw Error("mesh/bars is damaged: {} is the number of no point", end);
    all.push_back({static_cast<Index>(values[i]), static_cast<Index>(values[i + 1])});
  }
  return all;
}

double SolutionReader::time(Index k) const {
  double t = 0;
  t_.read(static_cast<std::uint64_t>(k), {&t, 1});
  return t;
}

void SolutionReader::state(Index k, Vector& values) const {
  values.resize(static_cast<Index>(data_.size()) * points_);
  for (std::size_t f = 0; f < data_.size(); ++f)
    data_[f].read(static_cast<std::uint64_t>(k),
                  {values.data() + static_cast<Index>(f) * points_, static_cast<std::size_t>(points_)});
}

void SolutionReader::field(Index field, Index k, Vector& values) const {
  values.resize(points_);
  data_[static_cast<std::size_t>(field)].read(static_cast<std::uint64_t>(k),
                                              {values.data(), static_cast<std::size_t>(points_)});
}

std::string SolutionReader::what_another_process_finds(const std::filesystem::path& solution) {
  if (look_at(solution).kind == InputKind::other) throw Error("{} is not a file", solution.string());
  constexpr int whole = 0, damaged = 3;
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) return "";  // then without
  const ::pid_t child = ::fork();
  if (child == 0) {
    end_at_first_fault(longest_reading(solution));
    try {
      SolutionReader(solution, Unguarded()).require_whole();
    } catch (const std::exception& error) {
      const std::string_view said = error.what();
      ::_exit(::write(pipe[1], said.data(), std::min<std::size_t>(said.size(), PIPE_BUF)) < 0 ? whole : damaged);
    }
    ::_exit(whole);
  }
  ::close(pipe[1]);
  std::array<char, PIPE_BUF> said{};
  const ::ssize_t length =
      child < 0 ? 0 : unless_interrupted([&] { return ::read(pipe[0], said.data(), said.size()); });
  ::close(pipe[0]);
  int status = 0;
  if (child < 0 || unless_interrupted([&] { return ::waitpid(child, &status, 0); }) < 0) return "";
  const bool finds = WIFEXITED(status) && WEXITSTATUS(status) == damaged && length > 0;
  if (finds) return {said.data(), static_cast<std::size_t>(length)};
  if (!WIFEXITED(status) || WEXITSTATUS(status) != whole)
    throw Error("{} is damaged: HDF5 itself breaks down over it", solution.string());
  return "";
}

void require_readable(const std::filesystem::path& solution) {
  if (const std::string damage = SolutionReader::what_another_process_finds(solution); !damage.empty())
    throw Error(damage);
}

}  // namespace seiche
