// An observer of one's own with the time loop: it counts how often the mean of a wave turns, and keeps nothing else.
// The states it sees are in the coordinates of the backend; Space turns them into values on the grid.
#include <seiche/seiche.hpp>

#include <cstdio>

class Turns final : public seiche::Observer {
 public:
  explicit Turns(const seiche::Space& space) : space_(space), values_(space.physical_size()) {}
  bool is_due(const seiche::State&, bool) const override { return true; }  // after every step
  void observe(const seiche::State& state, const seiche::EnergyReading&) override {
    space_.to_physical(state.z, values_);
    const double velocity = values_.tail(values_.size() / 2).mean();
    if (velocity * last_ < 0) ++count;
    last_ = velocity;
  }
  void finish(const seiche::RunReport&) override {}
  int count = 0;

 private:
  const seiche::Space& space_;
  seiche::Vector values_;
  double last_ = 0;
};

int main() {
  const auto wave = seiche::klein_gordon(
      {.grid = {.points = {64}}, .omega_squared = 4.0, .alpha = 1.0, .gamma = seiche::constant_rate(0.05)});
  seiche::Simulation simulation(wave, {.method = "seisav"});
  Turns turns(*simulation.system().space);
  seiche::Observer* const observers[] = {&turns};
  const auto report = seiche::integrate(simulation.system(), simulation.stepper(), simulation.state(),
                                        {.h = 1.0 / 64, .t_end = 20}, observers);
  std::printf("%lld steps, the mean turns %d times\n", static_cast<long long>(report.steps), turns.count);
}
// It prints:
//   1280 steps, the mean turns 12 times
