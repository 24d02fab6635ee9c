#include "floor.hpp"

#include <fftw3.h>
#include <seiche/backend/fft/transform.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/simulation/simulation.hpp>

#include <algorithm>
#include <chrono>
#include <functional>
#include <vector>

namespace seiche::bench {
namespace {

double seconds(const std::function<void()>& work, int times) {
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < times; ++i) work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / times;
}

// Medians of contestants that take turns.
std::vector<double> medians(const std::vector<std::function<void()>>& contestants, const FloorOptions& options) {
  std::vector<int> times;
  for (const auto& work : contestants) {
    work();
    times.push_back(static_cast<int>(std::clamp(options.seconds_per_round / seconds(work, 1), 1.0, 1e6)));
  }
  std::vector<std::vector<double>> taken(contestants.size());
  for (int round = 0; round < options.rounds; ++round)
    for (std::size_t i = 0; i < contestants.size(); ++i) taken[i].push_back(seconds(contestants[i], times[i]));
  std::vector<double> result;
  for (auto& list : taken) {
    std::sort(list.begin(), list.end());
    result.push_back(list[list.size() / 2]);
  }
  return result;
}

// r2c and c2r of a whole periodic grid.
class FftwTransforms {
 public:
  FftwTransforms(const Grid& grid, bool measure) : values_(fftw_alloc_real(static_cast<std::size_t>(grid.unknowns()))) {
    std::vector<int> n;
    for (const GridAxis& axis : grid.axes) n.push_back(static_cast<int>(axis.intervals));
    const auto points = static_cast<std::size_t>(grid.unknowns());
    const auto last = static_cast<std::size_t>(n.back());
    modes_ = fftw_alloc_complex(points / last * (last / 2 + 1));
    const unsigned flag = measure ? FFTW_MEASURE : FFTW_ESTIMATE;
    const int rank = static_cast<int>(n.size());
    forward_ = fftw_plan_dft_r2c(rank, n.data(), values_, modes_, flag);
    inverse_ = fftw_plan_dft_c2r(rank, n.data(), modes_, values_, flag);
    std::fill(values_, values_ + points, 0.0);
  }
  FftwTransforms(const FftwTransforms&) = delete;
  FftwTransforms& operator=(const FftwTransforms&) = delete;
  ~FftwTransforms() {
    fftw_destroy_plan(forward_);
    fftw_destroy_plan(inverse_);
    fftw_free(values_);
    fftw_free(modes_);
  }
  void there_and_back() const {
    fftw_execute(forward_);
    fftw_execute(inverse_);
  }

 private:
  double* values_;
  fftw_complex* modes_ = nullptr;
  fftw_plan forward_ = nullptr, inverse_ = nullptr;
};

}  // namespace

Floor measure_floor(const Problem& problem, const FloorOptions& options) {
  constexpr double h = 1.0 / 256;
  const BackendOptions backend{.measure_plans = options.measure_plans, .threads = options.threads};
  const SimulationOptions remembered{.method = "seisav", .backend = "modal", .backend_options = backend};
  SimulationOptions by_gradient = remembered;
  by_gradient.method_options.predictor = Predictor::gradient;
  Simulation simulation(problem, remembered), papers(problem, by_gradient);
  const auto stepping = [](Simulation& which) {
    return [&which] {
      if (!which.step(h).solved()) throw Error("a step of the benchmark failed");
    };
  };
  const auto transform =
      modal_transform(problem.grid, {.measure_plans = options.measure_plans, .threads = options.threads});
  Vector slots = Vector::Zero(transform->slots());
  const std::span<double> all(slots.data(), static_cast<std::size_t>(slots.size()));
  const auto transforms = [&] {
    for (int i = 0; i < 2; ++i) transform->through_values(all, all, [](std::span<double>) { return 0.0; });
  };
  const Index n = problem.grid.unknowns();
  Vector a = Vector::Zero(n), b = Vector::Ones(n), c = Vector::Ones(n);
  const auto triad = [&] { a = b + 0.5 * c; };
  std::vector<std::function<void()>> contestants = {stepping(simulation), stepping(papers), transforms, triad};
  std::unique_ptr<FftwTransforms> fftw;
  if (problem.grid.is_periodic()) {
    fftw = std::make_unique<FftwTransforms>(problem.grid, options.measure_plans);
    contestants.emplace_back([&] {
      fftw->there_and_back();
      fftw->there_and_back();
    });
  }
  const std::vector<double> time = medians(contestants, options);
  return {
      .step = time[0], .by_gradient = time[1], .transforms = time[2], .fftw = fftw ? time[4] : 0.0, .triad = time[3]};
}

}  // namespace seiche::bench
