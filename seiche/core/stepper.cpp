#include <seiche/core/stepper.hpp>

#include <algorithm>
#include <array>

namespace seiche {

std::span<const LedgerPart> ledger_parts() {
  using L = StepLedger;
  static constexpr std::array parts = {
      LedgerPart{"work", &L::work},
      LedgerPart{"damping_left", &L::damping_left},
      LedgerPart{"substep", &L::substep},
      LedgerPart{"scalar", &L::scalar},
      LedgerPart{"auxiliary", &L::auxiliary},
      LedgerPart{"projection", &L::projection},
      LedgerPart{"damping_right", &L::damping_right},
      LedgerPart{"heat", &L::heat},
  };
  return parts;
}

double StepLedger::sum() const {
  double sum = 0;
  for (const LedgerPart& part : ledger_parts()) sum += this->*part.value;
  return sum;
}

StepLedger& StepLedger::operator+=(const StepLedger& other) {
  for (const LedgerPart& part : ledger_parts()) this->*part.value += other.*part.value;
  return *this;
}

StepLedger& StepLedger::operator-=(const StepLedger& other) {
  for (const LedgerPart& part : ledger_parts()) this->*part.value -= other.*part.value;
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
  widened = std::max(widened, other.widened);
  halved = std::max(halved, other.halved);
  replaced += other.replaced;
  ledger += other.ledger;
  return *this;
}

}  // namespace seiche
