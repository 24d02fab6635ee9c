#include <seiche/output/xdmf.hpp>
#include <seiche/record/solution_file.hpp>

#include <array>
#include <span>

namespace seiche {

SolutionFile::SolutionFile(const Space& space, const SnapshotTimes& times, const Mark* from)
    : space_(space),
      times_(times),
      shown_(from != nullptr ? from->shown : 0),
      last_t_(from != nullptr ? from->last_t : Mark{}.last_t),
      values_(space.physical_size()) {}

SolutionFile::SolutionFile(const Folder& folder, const Problem& problem, const Space& space, const SnapshotTimes& times,
                           bool has_modified_energy, const SolutionDescription& description, const Mark* from,
                           double join_below, const Ranks* ranks)
    : SolutionFile(space, times, from) {
  file_.emplace(folder, solution_layout(problem), description, has_modified_energy,
                from != nullptr ? from->rows : SegmentsMark{}, join_below);
  let_compress(file_->layout, ranks);
}

SolutionFile::SolutionFile(const Problem& problem, const Space& space, const SnapshotTimes& times, const Mark* from,
                           const Ranks& ranks)
    : SolutionFile(space, times, from) {
  let_compress(solution_layout(problem), &ranks);
}

void SolutionFile::let_compress(const SolutionLayout& layout, const Ranks* ranks) {
  if (ranks != nullptr && JointRow::suits(layout, space_.values())) joint_.emplace(layout, space_.values(), *ranks);
}

bool SolutionFile::is_due(const State& state, bool last) const {
  if (times_.interval > 0) return (last || state.n == 0) && state.t > last_t_;
  return times_.schedule.is_due(state.n, last);
}

double SolutionFile::next_time() const {
  return times_.interval > 0 ? static_cast<double>(shown_ + 1) * times_.interval
                             : std::numeric_limits<double>::infinity();
}

void SolutionFile::observe(const State& state, const EnergyReading& energy) {
  last_t_ = state.t;
  while (next_time() <= state.t) ++shown_;
  space_.to_physical(state.z, values_);
  if (!file_) return pass_on();
  const std::array<double, 3> with_modified = {energy.H, energy.modified, state.t};
  const std::array<double, 2> without = {energy.H, state.t};
  const std::span<const double> numbers = file_->has_modified ? std::span<const double>(with_modified) : without;
  if (joint_)
    file_->segments.append_chunks([this](Segments::TakeChunk take) { joint_->join(span_of_values(), take); }, numbers);
  else
    file_->segments.append([this](Segments::Take take) { join(take); }, numbers);
}

void SolutionFile::pass_on() {
  if (joint_)
    joint_->join(span_of_values(), [](std::size_t, const Hdf5Chunk&) {});
  else
    join([](std::span<const double>) {});
}

void SolutionFile::skip(const State& state) {
  space_.to_physical(state.z, values_);
  pass_on();
}

void SolutionFile::join(Segments::Take take) { space_.join(space_.values(), span_of_values(), take); }

void SolutionFile::finish(const RunReport& report) {
  if (file_ && !file_->segments.is_broken()) file_->segments.finish(report);  // else the run has said so
}

SolutionFile::Mark SolutionFile::mark() { return {.rows = file_->segments.seal(), .shown = shown_, .last_t = last_t_}; }

std::uint64_t SolutionFile::describe(const std::atomic<bool>* stop) const {
  return write_xdmf(file_->folder, solution_name, file_->layout, {.stop = stop});
}

}  // namespace seiche
