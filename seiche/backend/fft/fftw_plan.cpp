#include <seiche/backend/fft/fftw_plan.hpp>

#include <fftw3.h>

namespace seiche {

void FreeFftw::operator()(double* p) const { fftw_free(p); }

FftwBuffer fftw_buffer(std::size_t size) { return FftwBuffer(fftw_alloc_real(size)); }

std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

FftwPlan::~FftwPlan() {
  if (plan_ == nullptr) return;
  const std::scoped_lock lock(planner_mutex());
  fftw_destroy_plan(plan_);
}

fftw_plan_s* FftwPlans::of(const double* in, const double* out) const {
  const auto is_aligned = [](const double* p) { return fftw_alignment_of(const_cast<double*>(p)) == 0; };
  return is_aligned(in) && is_aligned(out) ? aligned.get() : any.get();
}

unsigned plan_flags(bool measure) { return measure ? FFTW_MEASURE : FFTW_ESTIMATE; }

unsigned unaligned_plan_flags() { return FFTW_ESTIMATE | FFTW_UNALIGNED; }

}  // namespace seiche
