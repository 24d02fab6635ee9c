// Where event functions change their signs inside a step.
#pragma once

#include <seiche/core/base/function_ref.hpp>
#include <seiche/core/system.hpp>
#include <seiche/loop/integrate.hpp>

#include <span>
#include <vector>

namespace seiche {

class EventFinder {
 public:
  explicit EventFinder(std::span<const Event> events) : events_(events), left_(events.size()) {}

  struct Found {
    double t = 0.0;
    std::vector<const Event*> events;  // all that happen at t; none: no event in the step
    bool empty() const { return events.empty(); }
    // All their actions, each booked by its time; false: the run ends.
    bool happen(State& state, std::vector<double>& times) const;
  };
  // The events that the run begins with: those whose g is 0, in the direction that it then takes. As in SciPy.
  Found begin(const System& system, const State& state);

  // The values from which signs change. The state stands on the surface of events that have just happened, on either
  // side by round-off: for them the sign counts that g has a little later, inside the next step.
  void start(const State& state);

  using Inside = FunctionRef<void(double t, Vector& z)>;  // z ← the solution at a time inside the last step

  // The first events inside the last step, located on the solution inside it to round-off in t (TOMS 748). Throws Error
  // where an event function is not finite.
  Found find(const State& state, Inside inside);
  bool any_crossing(const State& state, Inside inside);  // true if there is one; does not locate it

  // Between two steps; read by one of as many events.
  void archive(Archive& a);

 private:
  double value(std::size_t i, double t, const Vector& z) const;
  void leave_surfaces(const State& state, Inside inside);
  double locate(std::size_t i, double after, const State& state, Inside inside);

  std::span<const Event> events_;
  struct Left {
    double t = 0, g = 0;
    bool on_surface = false;
    void archive(Archive& a) { a(t, g, on_surface); }
  };
  std::vector<Left> left_;  // of each event, from where its sign may change
  std::vector<const Event*> happened_;
  Vector z_;
};

}  // namespace seiche
