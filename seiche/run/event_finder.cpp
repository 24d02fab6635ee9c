#include <seiche/run/event_finder.hpp>

#include <boost/math/tools/toms748_solve.hpp>

#include <cstdint>

namespace seiche {
namespace {

bool is_crossing(double before, double after, Event::Direction direction) {
  if (before == 0 || !(before * after <= 0)) return false;
  if (direction == Event::Direction::rising) return before < 0;
  if (direction == Event::Direction::falling) return before > 0;
  return true;
}

}  // namespace

void EventFinder::start(const State& state) {
  t_ = state.t;
  for (std::size_t i = 0; i < events_.size(); ++i) values_[i] = events_[i].g(state.t, state.z);
}

EventFinder::Found EventFinder::find(const State& state, AdaptiveStepper& stepper) {
  Found found;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    const Event& event = events_[i];
    const double before = values_[i];
    const double after = event.g(state.t, state.z);
    values_[i] = after;
    if (!is_crossing(before, after, event.direction)) continue;
    const auto g = [&](double t) {
      z_.resizeLike(state.z);
      stepper.interpolate(state, t, z_);
      return event.g(t, z_);
    };
    double t = state.t;
    if (after != 0) {
      std::uintmax_t iterations = 100;
      const auto [low, high] =
          boost::math::tools::toms748_solve(g, t_, state.t, before, after,
                                            boost::math::tools::eps_tolerance<double>(50), iterations);
      t = high;  // on the far side, so that the event is not found again
    }
    if (found.event == nullptr || t < found.t) found = {&event, t};
  }
  t_ = state.t;
  return found;
}

}  // namespace seiche
