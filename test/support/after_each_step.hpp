// Lets a test look at a run between two steps, and end it there as a kill does: by what is no Error.
#pragma once

#include <seiche/core/observer.hpp>

#include <functional>
#include <utility>

namespace seiche::test {

class AfterEachStep : public Observer {
 public:
  explicit AfterEachStep(std::function<void(const State&)> action) : action_(std::move(action)) {}
  bool is_due(const State& state, bool) const override {
    action_(state);
    return false;
  }
  void observe(const State&, const EnergyReading&) override {}
  void finish(const RunReport&) override {}

 private:
  std::function<void(const State&)> action_;
};

}  // namespace seiche::test
