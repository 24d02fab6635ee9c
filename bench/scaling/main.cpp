// How the cost of a step and the memory of a run grow with the number of points.
#include <bench/scaling/figure.hpp>
#include <bench/scaling/memory.hpp>
#include <bench/scaling/problem.hpp>
#include <bench/scaling/sizes.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/output/file/atomic_file.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>

namespace seiche::bench {
namespace {

constexpr Index first_asymptotic = 512;  // from here on what does not depend on N is lost in a step

Index power_of_two(int exponent) { return Index{1} << exponent; }

// At 2²⁰ and 2²² points, and the largest power of two whose memory, by these, stays within the limit.
std::vector<SizeMemory> memory_of_sizes(double limit) {
  const double program = peak_bytes(2, limit);
  std::vector<SizeMemory> list;
  const auto add = [&](int exponent) {
    list.push_back({power_of_two(exponent), peak_bytes(power_of_two(exponent), limit), program});
  };
  add(20);
  add(22);
  const double bytes_per_point = list.back().peak / static_cast<double>(list.back().points);
  int exponent = 22;
  while (bytes_per_point * static_cast<double>(power_of_two(exponent + 1)) <= limit) ++exponent;
  for (; exponent > 22; --exponent) {
    try {
      add(exponent);
      break;
    } catch (const Error& error) {  // the library asks for more room than this
      std::fprintf(stderr, "%s\n", error.what());
    }
  }
  return list;
}

std::vector<SizeCost> cost_of_sizes() {
  std::vector<SizeCost> list;
  for (int exponent = 4; exponent <= 22; ++exponent)
    list.push_back({power_of_two(exponent), measure_floor(line_problem(power_of_two(exponent)), {})});
  return list;
}

void write_costs(const std::vector<SizeCost>& costs, const std::filesystem::path& directory) {
  std::string csv = "points,step_ns,transforms_ns,fftw_ns,triad_ns,step_over_transforms,step_ns_over_log2\n";
  for (const SizeCost& cost : costs) {
    const Floor& f = cost.floor;
    csv += fmt::format("{},{:.4g},{:.4g},{:.4g},{:.4g},{:.3f},{:.3f}\n", cost.points, cost.per_point(f.step),
                       cost.per_point(f.transforms), cost.per_point(f.fftw), cost.per_point(f.triad),
                       f.step / f.transforms, cost.per_point(f.step) / cost.levels());
  }
  write_file(directory / "scaling.csv", csv);
  std::fputs(csv.c_str(), stdout);
  std::printf("From %ld points on a step grows as (N log N)^%.2f, its transforms as (N log N)^%.2f.\n",
              static_cast<long>(first_asymptotic), growth_exponent(costs, &Floor::step, first_asymptotic),
              growth_exponent(costs, &Floor::transforms, first_asymptotic));
}

void write_memory(const std::vector<SizeMemory>& sizes, const std::filesystem::path& directory) {
  std::string csv = "points,peak_bytes,doubles_per_unknown\n";
  for (const SizeMemory& size : sizes)
    csv += fmt::format("{},{:.0f},{:.3f}\n", size.points, size.peak, size.doubles_per_unknown());
  write_file(directory / "memory.csv", csv);
  std::fputs(csv.c_str(), stdout);
}

void run(const std::filesystem::path& directory) {
  constexpr double most_memory = 20.0 * (1 << 30);
  make_directory(directory);
  write_memory(memory_of_sizes(std::min(most_memory, spare_memory())),
               directory);  // first: this process is still small
  const std::vector<SizeCost> costs = cost_of_sizes();
  write_costs(costs, directory);
  draw_scaling(costs, first_asymptotic, directory);
  std::printf("%s\n", (directory / "scaling.png").c_str());
}

}  // namespace
}  // namespace seiche::bench

int main(int argc, char** argv) {
  try {
    seiche::bench::run(argc > 1 ? argv[1] : "out/scaling");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "seiche_scaling: %s\n", error.what());
    return 1;
  }
}
