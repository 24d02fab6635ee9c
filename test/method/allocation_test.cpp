// `step` allocates nothing once the propagators it needs exist.
#include <test/support/cases.hpp>

#include <seiche/simulation/simulation.hpp>

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> allocations{0};

}  // namespace

// Eigen asks malloc for its vectors and the standard library asks operator new: count both.
extern "C" void* __libc_malloc(std::size_t size);  // NOLINT(bugprone-reserved-identifier): the C library named it
#if !defined(SEICHE_SANITIZED)
extern "C" void* malloc(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
#endif

namespace seiche::test {
namespace TEST_FILE {

TEST(Allocation, NoStepOfAnyMethodAllocates) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer owns malloc";
#endif
  for (const auto& [name, problem] : all_cases()) {
    for (const MethodEntry& method : methods()) {
      if (!applies(method.name, problem)) continue;
      for (const BackendEntry& backend : backends_for(problem)) {
        Simulation simulation(problem, {.method = std::string(method.name), .backend = std::string(backend.name)});
        for (int n = 0; n < 64; ++n) simulation.step(1.0 / 64);  // builds what it needs, fallbacks included
        const long before = allocations;
        int solved = 0;
        for (int n = 0; n < 64; ++n) solved += simulation.step(1.0 / 64).status == StepReport::Status::solved;
        EXPECT_EQ(solved, 64) << name << " " << method.name << " " << backend.name;
        EXPECT_EQ(allocations - before, 0) << name << " " << method.name << " " << backend.name;
      }
    }
  }
}

TEST(Allocation, NoStepByKicksAloneAllocates) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer owns malloc";
#endif
  SimulationOptions options{.method = "crkn6"};
  options.method_options.linear = LinearTreatment::explicit_kicks;
  for (const char* backend : {"dense", "modal", "sparse"}) {
    options.backend = backend;
    Simulation simulation(klein_gordon_case(), options);
    for (int n = 0; n < 64; ++n) simulation.step(1.0 / 64);
    const long before = allocations;
    for (int n = 0; n < 64; ++n) simulation.step(1.0 / 64);
    EXPECT_EQ(allocations - before, 0) << backend;
  }
}

TEST(Allocation, TheCounterSeesAnAllocation) {
#if defined(SEICHE_SANITIZED)
  GTEST_SKIP() << "the address sanitizer owns malloc";
#endif
  const long before = allocations;
  const Vector v = Vector::Zero(1000);
  EXPECT_GT(allocations - before, 0) << v.size();
}

}  // namespace TEST_FILE
}  // namespace seiche::test
