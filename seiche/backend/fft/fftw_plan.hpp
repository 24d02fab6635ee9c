// FFTW's plans as values, and its memory. Installed headers do without FFTW's own.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>

struct fftw_plan_s;

namespace seiche {

struct FreeFftw {
  void operator()(double* p) const;
};
using FftwBuffer = std::unique_ptr<double[], FreeFftw>;
FftwBuffer fftw_buffer(std::size_t size);

// (Re, Im) side by side: FFTW's fftw_complex is this array.
using FftwComplex = double[2];
inline FftwComplex* pairs(double* p) { return reinterpret_cast<FftwComplex*>(p); }

std::mutex& planner_mutex();  // FFTW's planner keeps global tables; plans run on any thread

class FftwPlan {
 public:
  FftwPlan() = default;
  template <class Make>
  explicit FftwPlan(const Make& make) {
    const std::scoped_lock lock(planner_mutex());
    plan_ = make();
  }
  FftwPlan(FftwPlan&& other) noexcept : plan_(std::exchange(other.plan_, nullptr)) {}
  FftwPlan& operator=(FftwPlan&& other) noexcept {
    std::swap(plan_, other.plan_);
    return *this;
  }
  ~FftwPlan();
  fftw_plan_s* get() const { return plan_; }

 private:
  fftw_plan_s* plan_ = nullptr;
};

// The same transform for arrays that lie as FFTW's vector instructions want them, and for any others.
struct FftwPlans {
  FftwPlan aligned, any;
  fftw_plan_s* of(const double* in, const double* out) const;
};

unsigned plan_flags(bool measure);
unsigned unaligned_plan_flags();

// make(flags) plans on arrays of fftw_buffer.
template <class Make>
FftwPlans make_plans(bool measure, const Make& make) {
  return {.aligned = FftwPlan([&] { return make(plan_flags(measure)); }),
          .any = FftwPlan([&] { return make(unaligned_plan_flags()); })};
}

// A transform of many lines in batches of `full` lines, and of the `rest` that is left (0: none).
struct BatchPlans {
  template <class Make>  // make(lines, flags)
  BatchPlans(Index full_lines, Index rest_lines, bool measure, const Make& make)
      : full(make_plans(measure, [&](unsigned flags) { return make(static_cast<int>(full_lines), flags); })) {
    if (rest_lines != 0)
      rest = make_plans(measure, [&](unsigned flags) { return make(static_cast<int>(rest_lines), flags); });
  }
  FftwPlans full, rest;
};

}  // namespace seiche
