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
                           double join_below)
    : SolutionFile(space, times, from) {
  file_.emplace(folder, solution_layout(problem), description, has_modified_energy,
                from != nullptr ? from->rows : SegmentsMark{}, join_below);
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
  if (!file_) return join([](std::span<const double>) {});
  const std::array<double, 3> with_modified = {energy.H, energy.modified, state.t};
  const std::array<double, 2> without = {energy.H, state.t};
  file_->segments.append([this](Segments::Take take) { join(take); },
                         file_->has_modified ? std::span<const double>(with_modified) : without);
}

void SolutionFile::skip(const State& state) {
  space_.to_physical(state.z, values_);
  join([](std::span<const double>) {});
}

void SolutionFile::join(Segments::Take take) {
  space_.join(space_.values(), {values_.data(), static_cast<std::size_t>(values_.size())}, take);
}

void SolutionFile::finish(const RunReport& report) {
  if (file_ && !file_->segments.is_broken()) file_->segments.finish(report);  // else the run has said so
}

SolutionFile::Mark SolutionFile::mark() { return {.rows = file_->segments.seal(), .shown = shown_, .last_t = last_t_}; }

std::uint64_t SolutionFile::describe(const std::atomic<bool>* stop) const {
  return write_xdmf(file_->folder, solution_name, file_->layout, {.stop = stop});
}

}  // namespace seiche
