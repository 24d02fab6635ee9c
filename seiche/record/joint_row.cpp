#include <seiche/core/base/error.hpp>
#include <seiche/record/joint_row.hpp>

#include <algorithm>
#include <cstring>
#include <exception>
#include <mutex>
#include <numeric>
#include <utility>

namespace seiche {
namespace {

Index height_of(const SolutionLayout& layout) { return static_cast<Index>(layout.chunk()[1]); }
Index down_to_chunk(Index plane, Index height) { return plane / height * height; }
Index up_to_chunk(Index plane, Index height) { return down_to_chunk(plane + height - 1, height); }

// A chunk as numbers to be sent: its filters, how many axes, its corner, how many bytes, and these.
void pack(const Hdf5Chunk& chunk, std::vector<double>& all) {
  all.push_back(chunk.filters);
  all.push_back(static_cast<double>(chunk.corner.size()));
  all.insert(all.end(), chunk.corner.begin(), chunk.corner.end());
  all.push_back(static_cast<double>(chunk.bytes.size()));
  const std::size_t at = all.size();
  all.resize(at + (chunk.bytes.size() + sizeof(double) - 1) / sizeof(double));
  std::memcpy(all.data() + at, chunk.bytes.data(), chunk.bytes.size());
}

template <class Visit>
void unpack(const std::vector<double>& all, const Visit& visit) {
  Hdf5Chunk chunk;
  for (auto at = all.begin(); at != all.end();) {
    chunk.filters = static_cast<std::uint32_t>(*at++);
    const auto axes = static_cast<std::ptrdiff_t>(*at++);
    chunk.corner.assign(at, at + axes);
    at += axes;
    chunk.bytes.resize(static_cast<std::size_t>(*at++));
    std::memcpy(chunk.bytes.data(), &*at, chunk.bytes.size());
    at += static_cast<std::ptrdiff_t>((chunk.bytes.size() + sizeof(double) - 1) / sizeof(double));
    visit(chunk);
  }
}

}  // namespace

bool JointRow::suits(const SolutionLayout& layout, const FieldPart& field) {
  return !layout.axes.empty() && layout.chunk().front() == 1 && layout.chunk()[1] < layout.shape().front() &&
         static_cast<std::uint64_t>(field.units.of) == layout.shape().front();
}

JointRow::JointRow(SolutionLayout layout, const FieldPart& field, const Ranks& ranks)
    : layout_(std::move(layout)),
      ranks_(ranks),
      plane_(field.plane()),
      size_(field.size),
      first_(field.first / plane_),
      end_(first_ + size_ / plane_),
      sent_(static_cast<std::size_t>(ranks.here().count), 0),
      received_(sent_) {
  const Index height = height_of(layout_);
  const auto [index, count] = ranks.here();
  std::vector<Slab> slabs;
  for (int rank = 0; rank < count; ++rank) slabs.push_back(slab_of(field.units.whole(), {rank, count}));
  begin_own_ = std::min(up_to_chunk(first_, height), end_);
  // What lies before the first chunk of a process goes to the one that has the plane where that chunk begins.
  for (int rank = 0; rank < count; ++rank) {
    const auto [first, planes] = slabs[static_cast<std::size_t>(rank)];
    const Index passed_on = std::min(up_to_chunk(first, height), first + planes) - first;
    if (passed_on == 0) continue;
    const Index beginning = down_to_chunk(first, height);
    const auto owner = std::find_if(slabs.begin(), slabs.end(), [&](const Slab& slab) {
      return beginning >= slab.first && beginning < slab.first + slab.planes;
    });
    const auto to = static_cast<int>(owner - slabs.begin());
    if (rank == index) sent_[static_cast<std::size_t>(to)] = passed_on * plane_;
    if (to == index) received_[static_cast<std::size_t>(rank)] = passed_on * plane_;
  }
}

// HDF5 itself compresses, into a file in memory with the same chunks. It runs on one thread at a time.
JointRow::Compressed JointRow::compress(std::span<const double> mine, std::span<const double> from_others) const {
  Compressed found;
  if (begin_own_ == end_) return found;
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  try {
    Hdf5File file = Hdf5File::in_memory();
    Hdf5Dataset data = file.make_dataset("u", {.row = layout_.shape(), .chunk = layout_.chunk()});
    const auto here = [&](Index from, Index to) {
      return mine.subspan(static_cast<std::size_t>((from - first_) * plane_),
                          static_cast<std::size_t>((to - from) * plane_));
    };
    const Index last = std::max(begin_own_, down_to_chunk(end_, height_of(layout_)));
    data.begin_row();
    if (last > begin_own_) data.continue_row(static_cast<std::uint64_t>(begin_own_), here(begin_own_, last));
    if (end_ > last) {
      const std::span<const double> rest = here(last, end_);
      std::vector<double> block(rest.begin(), rest.end());
      block.insert(block.end(), from_others.begin(), from_others.end());
      data.continue_row(static_cast<std::uint64_t>(last), block);
    }
    data.for_chunks(0, static_cast<std::uint64_t>(begin_own_), static_cast<std::uint64_t>(end_),
                    [&](const Hdf5Shape& corner) { pack(data.read_chunk(corner), found.chunks); });
  } catch (const std::exception& error) {
    found = {.chunks = {}, .complaint = error.what()};
  }
  return found;
}

void JointRow::join(std::span<const double> values, Take take) const {
  const auto [index, count] = ranks_.here();
  const auto processes = static_cast<std::size_t>(count);
  const auto sum = [](const std::vector<Index>& counts) {
    return static_cast<std::size_t>(std::accumulate(counts.begin(), counts.end(), Index{0}));
  };
  std::exception_ptr failure;
  std::string complaint;
  std::vector<double> from_others(sum(received_));
  for (std::size_t f = 0; f < layout_.fields.size(); ++f) {
    const std::span<const double> mine =
        values.subspan(f * static_cast<std::size_t>(size_), static_cast<std::size_t>(size_));
    ranks_.exchange(mine.first(sum(sent_)), sent_, from_others, received_);
    const Compressed compressed = compress(mine, from_others);
    if (complaint.empty()) complaint = ranks_.any(compressed.complaint);
    const auto passes = [&](const Hdf5Chunk& chunk) {
      if (failure || !complaint.empty()) return;
      try {
        take(f, chunk);
      } catch (...) {
        failure = std::current_exception();
      }
    };
    if (index == 0) unpack(compressed.chunks, passes);
    const double length = static_cast<double>(compressed.chunks.size());
    std::vector<double> lengths(processes);
    ranks_.gather({&length, 1}, std::vector<Index>(processes, 1), lengths);
    for (std::size_t rank = 1; rank < processes; ++rank) {
      std::vector<Index> to_first(processes, 0), from_rank(processes, 0);
      const bool sends = static_cast<std::size_t>(index) == rank;
      if (sends) to_first.front() = std::ssize(compressed.chunks);
      if (index == 0) from_rank[rank] = static_cast<Index>(lengths[rank]);
      std::vector<double> received(index == 0 ? static_cast<std::size_t>(lengths[rank]) : 0);
      ranks_.exchange(sends ? std::span(compressed.chunks) : std::span<const double>(), to_first, received, from_rank);
      unpack(received, passes);
    }
  }
  if (failure) std::rethrow_exception(failure);
  if (!complaint.empty()) throw Error(std::string_view(complaint));
}

}  // namespace seiche
