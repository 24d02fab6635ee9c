#include <seiche/core/stepper.hpp>

namespace seiche {

StepReport& StepReport::operator+=(const StepReport& other) {
  if (!other.solved()) {
    status = other.status;
    message = other.message;
  }
  scalar_iterations += other.scalar_iterations;
  fallbacks += other.fallbacks;
  unresolved += other.unresolved;
  return *this;
}

}  // namespace seiche
