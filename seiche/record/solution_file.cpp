#include <seiche/output/xdmf.hpp>
#include <seiche/record/solution_file.hpp>

#include <array>
#include <span>

namespace seiche {

SolutionFile::SolutionFile(const Folder& folder, const Problem& problem, const Space& space, const SnapshotTimes& times,
                           bool has_modified_energy, const SolutionDescription& description, const Mark* from,
                           double join_below)
    : folder_(folder),
      layout_(solution_layout(problem)),
      segments_(folder, layout_, description, has_modified_energy, from != nullptr ? from->rows : SegmentsMark{},
                join_below),
      space_(space),
      times_(times),
      has_modified_(has_modified_energy),
      shown_(from != nullptr ? from->shown : 0),
      last_t_(from != nullptr ? from->last_t : Mark{}.last_t),
      values_(space.physical_size()) {}

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
  const std::array<double, 3> with_modified = {energy.H, energy.modified, state.t};
  const std::array<double, 2> without = {energy.H, state.t};
  const std::span<const double> fields(values_.data(), static_cast<std::size_t>(values_.size()));
  segments_.append(fields, has_modified_ ? std::span<const double>(with_modified) : without);
}

void SolutionFile::finish(const RunReport& report) {
  if (!segments_.is_broken()) segments_.finish(report);  // else the run has said so
}

SolutionFile::Mark SolutionFile::mark() { return {.rows = segments_.seal(), .shown = shown_, .last_t = last_t_}; }

std::uint64_t SolutionFile::describe(const std::atomic<bool>* stop) const {
  return write_xdmf(folder_, solution_name, layout_, {.stop = stop});
}

}  // namespace seiche
