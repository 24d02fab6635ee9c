#include <seiche/output/snapshots.hpp>

#include <fmt/ranges.h>

namespace seiche {

Snapshots::Snapshots(const std::filesystem::path& path, const Problem& problem, const Space& space, Schedule schedule,
                     double interval)
    : file_(path), space_(space), schedule_(schedule), interval_(interval), values_(space.physical_size()) {
  file_.write(fmt::format("t,{}\n", fmt::join(value_names(problem), ",")));
}

bool Snapshots::is_due(const State& state, bool last) const {
  if (interval_ > 0) return (last || state.n == 0) && state.t > last_t_;
  return schedule_.is_due(state.n, last);
}

double Snapshots::next_time() const {
  return interval_ > 0 ? static_cast<double>(shown_ + 1) * interval_ : std::numeric_limits<double>::infinity();
}

void Snapshots::observe(const State& state, const EnergyReading&) {
  last_t_ = state.t;
  while (next_time() <= state.t) ++shown_;
  space_.to_physical(state.z, values_);
  row_.clear();
  row_.add(state.t);
  row_.add(values_);
  file_.write(row_.line());
}

void Snapshots::finish(const RunReport&) { file_.commit(); }

std::vector<std::string> value_names(const Problem& problem) {
  std::vector<std::string> names;
  for (const std::string& field : problem.fields) {
    for (Index j = 1; j <= problem.grid.unknowns(); ++j) names.push_back(fmt::format("{}_{}", field, j));
  }
  return names;
}

}  // namespace seiche
