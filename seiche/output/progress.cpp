#include <seiche/output/progress.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace seiche {

Progress::Progress(std::FILE* terminal, double t_end) : t_end_(t_end), bar_(terminal) {}

bool Progress::is_due(const State& state, bool) const {
  if (state.n < next_look_) return false;
  if (first_n_ < 0) {
    first_n_ = last_n_ = state.n;
    first_t_ = state.t;
    bar_.begin();
  }
  if (bar_.is_time_to_draw()) {
    draw(state);
    last_n_ = state.n;
  }
  // Growing gaps: few looks where steps are fast, and at most a quarter late where they become slow.
  next_look_ = state.n + std::max<std::int64_t>(1, (state.n - last_n_) / 4);
  return false;
}

void Progress::draw(const State& state) const {
  const auto done = static_cast<double>(state.n - first_n_);
  const double share = t_end_ > first_t_ ? (state.t - first_t_) / (t_end_ - first_t_) : 1.0;
  bar_.draw(share, fmt::format("t = {:<10.6g} {:.3g} steps/s, {} left", state.t, done / bar_.seconds(),
                               bar_.time_left(share)));
}

void Progress::finish(const RunReport&) { bar_.wipe(); }

}  // namespace seiche
