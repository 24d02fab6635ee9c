#include "step_beside.hpp"

#include <seiche/backend/fft/transform.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/simulation/simulation.hpp>

#include "transform_count.hpp"
#include "turns.hpp"

namespace seiche::bench {

StepBeside measure_step(const Problem& problem, const std::string& method, const std::string& backend, double h) {
  constexpr int restart_after = 12800;  // steps: the paper's run to T = 50
  const bool has_transforms = backend == "modal";
  const double count = has_transforms ? transforms_per_step(problem, method, h) : 0.0;

  Simulation simulation(problem, {.method = method, .backend = backend, .backend_options = {.measure_plans = true}});
  int steps = 0;
  const auto step = [&] {
    if (!simulation.step(h).solved()) throw Error("a step of {} failed", method);
    if (++steps % restart_after == 0) simulation.restart();
  };
  const Index n = problem.grid.unknowns();
  Vector a = Vector::Zero(n), b = Vector::Ones(n), c = Vector::Ones(n);
  const auto triad = [&] { a = b + 0.5 * c; };
  std::vector<std::function<void()>> contestants = {step, triad};

  std::unique_ptr<FieldTransform> transform;
  Vector slots;
  if (has_transforms) {
    transform = modal_transform(problem.grid, {.measure_plans = true});
    slots.setZero(transform->slots());
    contestants.emplace_back([&] {
      const std::span<double> all(slots.data(), static_cast<std::size_t>(slots.size()));
      transform->through_values(all, all, [](std::span<double>) { return 0.0; });
    });
  }
  const std::vector<double> time = median_seconds(contestants);
  const double of_all_fields = count * static_cast<double>(problem.potential->fields());
  return {.step = time[0],
          .transform_count = count,
          .transforms = has_transforms ? time[2] / 2 * of_all_fields : 0.0,
          .triad = time[1]};
}

}  // namespace seiche::bench
