#include <seiche/core/stepper.hpp>

namespace seiche {

StepLedger& StepLedger::operator+=(const StepLedger& other) {
  work += other.work;
  damping_left += other.damping_left;
  substep += other.substep;
  scalar += other.scalar;
  auxiliary += other.auxiliary;
  projection += other.projection;
  damping_right += other.damping_right;
  return *this;
}

StepReport& StepReport::operator+=(const StepReport& other) {
  if (!other.solved()) {
    status = other.status;
    message = other.message;
  }
  scalar_iterations += other.scalar_iterations;
  fallbacks += other.fallbacks;
  unresolved += other.unresolved;
  ledger += other.ledger;
  return *this;
}

}  // namespace seiche
