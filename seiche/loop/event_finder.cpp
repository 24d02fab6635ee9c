#include <seiche/core/base/error.hpp>
#include <seiche/core/text/number_text.hpp>
#include <seiche/loop/event_finder.hpp>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace seiche {
namespace {

bool is_crossing(double before, double after, Event::Direction direction) {
  if (before == 0 || (after != 0 && std::signbit(before) == std::signbit(after))) return false;
  if (direction == Event::Direction::rising) return before < 0;
  if (direction == Event::Direction::falling) return before > 0;
  return true;
}

}  // namespace

double EventFinder::value(std::size_t i, double t, const Vector& z) const {
  const double g = events_[i].g(t, z);
  if (!std::isfinite(g)) throw Error("the function of event {} is {} at t = {:.9g}", i + 1, number_text(g), t);
  return g;
}

bool EventFinder::Found::happen(State& state, std::vector<double>& times) const {
  bool goes_on = true;
  for (const Event* event : events) {
    times.push_back(t);
    goes_on = event->action && event->action(state) && goes_on;
  }
  return goes_on;
}

// Two short steps of Euler's method: a velocity that is 0 may yet change g through its own rate.
EventFinder::Found EventFinder::begin(const System& system, const State& state) {
  constexpr double short_of = 0x1p-20;  // the time in which z would change by its own size
  Found found{.t = state.t, .events = {}};
  std::vector<std::size_t> on_surface;
  for (std::size_t i = 0; i < events_.size(); ++i)
    if (value(i, state.t, state.z) == 0) on_surface.push_back(i);
  if (on_surface.empty()) return found;

  Vector z = state.z, change(state.z.size());
  system.right_hand_side(state.t, z, change);
  const double quotient = system.space->norm(z) / system.space->norm(change);
  const double dt = short_of * (std::isfinite(quotient) && quotient > 0 ? quotient : 1.0);
  z += dt * change;
  system.right_hand_side(state.t + dt, z, change);
  z += dt * change;
  for (const std::size_t i : on_surface) {
    const double soon = value(i, state.t + 2 * dt, z);
    if (is_crossing(-soon, soon, events_[i].direction)) found.events.push_back(&events_[i]);
  }
  happened_ = found.events;
  return found;
}

void EventFinder::start(const State& state) {
  for (std::size_t i = 0; i < events_.size(); ++i) {
    const bool just_now = std::find(happened_.begin(), happened_.end(), &events_[i]) != happened_.end();
    const double g = just_now ? 0.0 : value(i, state.t, state.z);
    left_[i] = {state.t, g, g == 0};
  }
  happened_.clear();
}

// A ball that touches the ground again within a step is seen to be above it in between, unless it is back in a 64th of
// the step.
void EventFinder::leave_surfaces(const State& state, Inside inside) {
  constexpr double soon = 1.0 / 64;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    if (!left_[i].on_surface) continue;
    const double t = left_[i].t + soon * (state.t - left_[i].t);
    z_.resizeLike(state.z);
    inside(t, z_);
    left_[i] = {t, value(i, t, z_), false};
  }
}

bool EventFinder::any_crossing(const State& state, Inside inside) {
  const std::vector<Left> before = left_;  // to be kept: the step may yet be taken back
  leave_surfaces(state, inside);
  bool any = false;
  for (std::size_t i = 0; i < events_.size(); ++i)
    any = any || is_crossing(left_[i].g, value(i, state.t, state.z), events_[i].direction);
  left_ = before;
  return any;
}

void EventFinder::archive(Archive& a) {
  a(left_);
  a.require(left_.size() == events_.size());
}

double EventFinder::locate(std::size_t i, double after, const State& state, Inside inside) {
  if (after == 0) return state.t;
  const auto g = [&](double t) {
    z_.resizeLike(state.z);
    inside(t, z_);
    return value(i, t, z_);
  };
  std::uintmax_t iterations = 100;
  return boost::math::tools::toms748_solve(g, left_[i].t, state.t, left_[i].g, after,
                                           boost::math::tools::eps_tolerance<double>(50), iterations)
      .second;
}

EventFinder::Found EventFinder::find(const State& state, Inside inside) {
  struct Crossing {
    const Event* event;
    double t;
  };
  leave_surfaces(state, inside);
  std::vector<Crossing> crossings;
  Found found{.t = std::numeric_limits<double>::infinity(), .events = {}};
  std::vector<double> after(events_.size());
  for (std::size_t i = 0; i < events_.size(); ++i) {
    after[i] = value(i, state.t, state.z);
    if (!is_crossing(left_[i].g, after[i], events_[i].direction)) continue;
    crossings.push_back({&events_[i], locate(i, after[i], state, inside)});
    found.t = std::min(found.t, crossings.back().t);
  }
  const double same = 4 * epsilon * std::abs(found.t);  // what the location is good for
  for (const Crossing& crossing : crossings)
    if (crossing.t <= found.t + same) found.events.push_back(crossing.event);
  happened_ = found.events;
  for (std::size_t i = 0; i < events_.size(); ++i) left_[i] = {state.t, after[i], false};
  return found;
}

}  // namespace seiche
