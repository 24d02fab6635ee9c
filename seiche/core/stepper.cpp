#include <seiche/core/stepper.hpp>

#include <algorithm>
#include <array>

namespace seiche {

namespace {

constexpr std::array all_parts = {
    LedgerPart{"work", &StepLedger::work},
    LedgerPart{"damping_left", &StepLedger::damping_left},
    LedgerPart{"substep", &StepLedger::substep},
    LedgerPart{"scalar", &StepLedger::scalar},
    LedgerPart{"auxiliary", &StepLedger::auxiliary},
    LedgerPart{"projection", &StepLedger::projection},
    LedgerPart{"damping_right", &StepLedger::damping_right},
    LedgerPart{"heat", &StepLedger::heat},
};

// StepLedger::operator+= names them one by one.
static_assert(sizeof(StepLedger) == all_parts.size() * sizeof(double));

}  // namespace

std::span<const LedgerPart> ledger_parts() { return all_parts; }

double StepLedger::sum() const {
  double sum = 0;
  for (const LedgerPart& part : all_parts) sum += this->*part.value;
  return sum;
}

StepLedger& StepLedger::operator-=(const StepLedger& other) {
  for (const LedgerPart& part : all_parts) this->*part.value -= other.*part.value;
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
