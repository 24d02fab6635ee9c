#include "turns.hpp"

#include <seiche/study/timing.hpp>

#include <algorithm>

namespace seiche::bench {
namespace {

constexpr double seconds_per_round = 0.004;  // of a contestant
constexpr int rounds = 9;

double seconds(const std::function<void()>& work, int times) {
  const double begin = thread_cpu_seconds();
  for (int i = 0; i < times; ++i) work();
  return (thread_cpu_seconds() - begin) / times;
}

}  // namespace

std::vector<double> median_seconds(const std::vector<std::function<void()>>& contestants) {
  std::vector<int> times;
  for (const auto& work : contestants) {
    work();
    times.push_back(static_cast<int>(std::clamp(seconds_per_round / seconds(work, 1), 1.0, 1e6)));
  }
  std::vector<std::vector<double>> taken(contestants.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < contestants.size(); ++i) taken[i].push_back(seconds(contestants[i], times[i]));
  std::vector<double> medians;
  for (auto& list : taken) {
    std::nth_element(list.begin(), list.begin() + rounds / 2, list.end());
    medians.push_back(list[rounds / 2]);
  }
  return medians;
}

}  // namespace seiche::bench
