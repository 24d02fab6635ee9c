#include <seiche/core/base/error.hpp>
#include <seiche/output/file/folder_open.hpp>
#include <seiche/record/segments.hpp>
#include <seiche/record/whole_solution.hpp>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

namespace seiche {
namespace {

std::filesystem::path path_of(const Folder& folder) { return folder.path() / segments_folder; }

// By how it begins; of what is empty nothing is lost.
bool is_hdf5(const Folder& folder, const std::string& name) {
  std::array<char, hdf5_signature.size()> begin{};
  const int file = ::openat(folder.descriptor(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  const ::ssize_t size = ::read(file, begin.data(), begin.size());
  ::close(file);
  return size == 0 || (size > 0 && std::string_view(begin.data(), static_cast<std::size_t>(size)) == hdf5_signature);
}

}  // namespace

std::uint64_t SegmentsMark::rows() const {
  std::uint64_t all = unfinished.empty() ? 0 : unfinished.back().size();  // of t
  for (const Segment& segment : sealed) all += segment.rows;
  return all;
}

void SegmentsMark::archive(Archive& a) {
  a(sealed, has_modified, unfinished);
  a.require(unfinished.size() > numbers());
  if (unfinished.empty()) return;
  const std::size_t times = unfinished.back().size(), field = unfinished.front().size();
  a.require(times == 0 ? field == 0 : field % times == 0);
  for (std::size_t i = 0; i < unfinished.size(); ++i) a.require(unfinished[i].size() == (i < fields() ? field : times));
}

std::string complaint_about(const Folder& folder, const SegmentsMark& mark) {
  if (mark.sealed.empty()) return "";
  const Folder inside = folder.inside(segments_folder);
  for (std::size_t k = 0; k < mark.sealed.size(); ++k)
    if (std::string said = complaint_about_whole(inside, segment_name(k + 1), mark.sealed[k].file); !said.empty())
      return fmt::format("{}/{}", segments_folder, said);
  return "";
}

void require_layout(const SegmentsMark& mark, const SolutionLayout& layout, bool has_modified_energy) {
  const std::uint64_t chunk = layout.chunk().front();
  bool is_same = mark.has_modified == has_modified_energy &&
                 mark.unfinished.size() == layout.fields.size() + mark.numbers() &&
                 mark.unfinished.back().size() < chunk &&
                 mark.unfinished.front().size() == mark.unfinished.back().size() * layout.points();
  for (const SegmentsMark::Segment& segment : mark.sealed)
    is_same = is_same && segment.rows > 0 && segment.rows % chunk == 0;
  if (!is_same) throw Error("the checkpoint is of a solution with other fields, or another grid");
}

void remove_segments(const Folder& folder, std::size_t kept) {
  std::error_code none;
  if (!folder.has_lock()) return;
  if (!std::filesystem::is_directory(std::filesystem::symlink_status(path_of(folder), none))) return;
  const Folder inside = folder.inside(segments_folder);
  std::size_t last = kept;
  while (FileIdentity(inside.descriptor(), segment_name(last + 1)) != FileIdentity()) ++last;
  // From the end, so that those of a removal that was interrupted are found again.
  for (; last > kept; --last)
    if (is_hdf5(inside, segment_name(last))) remove_file(inside, segment_name(last));
  ::unlinkat(folder.descriptor(), segments_folder, AT_REMOVEDIR);  // fails where something is in it
}

Segments::Segments(Folder folder, SolutionLayout layout, SolutionDescription description, bool has_modified_energy,
                   SegmentsMark mark, double join_below)
    : folder_(std::move(folder)),
      layout_(std::move(layout)),
      description_(std::move(description)),
      chunk_(layout_.chunk().front()),
      mark_(std::move(mark)),
      join_below_(join_below) {
  if (mark_.unfinished.empty()) {
    mark_.has_modified = has_modified_energy;
    mark_.unfinished.resize(layout_.fields.size() + mark_.numbers());
  }
  require_layout(mark_, layout_, has_modified_energy);
}

Segments::~Segments() = default;

void Segments::require_writable() const {
  if (is_finished_) throw Error("{} is finished, and takes no more rows", (folder_.path() / solution_name).string());
  if (is_broken_) throw Error("{} could not be written", (folder_.path() / solution_name).string());
}

OpenSolution& Segments::open() {
  if (open_) return *open_;
  remove_segments(folder_, mark_.sealed.size());
  open_ = std::make_unique<OpenSolution>(folder_, layout_, description_, mark_.has_modified);
  return *open_;
}

template <class Action>
void Segments::attempt(const Action& action) {
  require_writable();
  is_broken_ = true;
  try {
    action();
  } catch (...) {
    open_.reset();
    throw;
  }
  is_broken_ = false;
}

// visit(field, values) of a piece that comes behind so many others.
template <class Visit>
void Segments::by_fields(std::uint64_t at, std::span<const double> piece, const Visit& visit) const {
  for (const std::uint64_t points = layout_.points(); !piece.empty();) {
    const std::size_t length = std::min<std::uint64_t>(piece.size(), points - at % points);
    visit(static_cast<std::size_t>(at / points), piece.first(length));
    piece = piece.subspan(length);
    at += length;
  }
}

void Segments::append(FunctionRef<void(Take)> join, std::span<const double> numbers) {
  if (is_broken_ || is_finished_) join([](std::span<const double>) {});  // other processes take part in it
  attempt([&] {
    if (chunk_ == 1) {
      append_large(join);
    } else {
      std::uint64_t at = 0;
      join([&](std::span<const double> piece) {
        by_fields(at, piece, [&](std::size_t f, std::span<const double> values) {
          mark_.unfinished[f].insert(mark_.unfinished[f].end(), values.begin(), values.end());
        });
        at += piece.size();
      });
    }
    append_numbers(numbers);
  });
}

void Segments::append_chunks(FunctionRef<void(TakeChunk)> join, std::span<const double> numbers) {
  if (is_broken_ || is_finished_) join([](std::size_t, const Hdf5Chunk&) {});
  attempt([&] {
    std::size_t begun = 0;
    join([&](std::size_t f, const Hdf5Chunk& chunk) {
      Hdf5Dataset& column = open().columns[f];
      if (begun == f) column.begin_row();
      begun = f + 1;
      column.write_chunk(chunk, column.rows() - 1);
    });
    append_numbers(numbers);
  });
}

void Segments::append_numbers(std::span<const double> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) mark_.unfinished[layout_.fields.size() + i].push_back(numbers[i]);
  if (mark_.unfinished.back().size() == chunk_) write_rows(open());
}

// Rows that fill chunks are not kept twice: some planes at a time, which fill chunks, go to the disk.
void Segments::append_large(FunctionRef<void(Take)> join) {
  constexpr std::uint64_t enough = std::uint64_t{1} << 20U;  // numbers
  const std::uint64_t points = layout_.points(), planes = layout_.shape().front(), plane = points / planes;
  const std::uint64_t height = layout_.chunk()[1];
  const std::uint64_t most = plane * height * std::max<std::uint64_t>(enough / (plane * height), 1);
  std::uint64_t at = 0, written = 0;  // in all fields, and in this one
  std::vector<double> block;
  join([&](std::span<const double> piece) {
    by_fields(at, piece, [&](std::size_t f, std::span<const double> values) {
      Hdf5Dataset& column = open().columns[f];
      if (written == 0 && block.empty()) column.begin_row();
      while (!values.empty()) {
        const std::uint64_t full = std::min(most, points - written);
        const std::size_t length = std::min<std::uint64_t>(values.size(), full - block.size());
        block.insert(block.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(length));
        values = values.subspan(length);
        if (block.size() < full) continue;
        column.continue_row(written / plane, block);
        written = (written + full) % points;
        block.clear();
      }
    });
    at += piece.size();
  });
}

void Segments::write_rows(OpenSolution& to) {
  to.rows += mark_.unfinished.back().size();
  for (std::size_t i = 0; i < to.columns.size(); ++i) {
    to.columns[i].append(mark_.unfinished[i]);
    mark_.unfinished[i].clear();
  }
}

SegmentsMark Segments::seal() {
  attempt([&] {
    if (!open_) return;
    const Folder inside = folder_.make_inside(segments_folder);
    open_->close();
    const FileMark file = open_->path.mark();
    open_->path.commit_as(inside, segment_name(mark_.sealed.size() + 1));
    mark_.sealed.push_back({.rows = open_->rows, .file = file});
    open_.reset();
  });
  return mark_;
}

void Segments::finish(const RunReport& report) {
  if (!mark_.sealed.empty()) seal();
  attempt([&] {
    if (mark_.sealed.empty()) {
      write_rows(open());
      open().commit(layout_, report);
      open_.reset();
      return;
    }
    double bytes = 0;
    for (const SegmentsMark::Segment& segment : mark_.sealed) bytes += static_cast<double>(segment.file.length);
    shows_segments_ = bytes > join_below_;
    if (shows_segments_) {
      remove_segments(folder_, mark_.sealed.size());
      show_segments(folder_, layout_, description_, mark_, report);
    } else {
      join_segments(folder_, layout_, description_, mark_, report);
    }
  });
  is_finished_ = true;
}

}  // namespace seiche
