// A method: one row of the method table.
#pragma once

#include <seiche/core/replaced_steps.hpp>
#include <seiche/core/state.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace seiche {

class Archive;

// Where the change of H comes from. The parts of a step add up to H after − H before, but for round-off.
struct StepLedger {
  double work = 0.0;          // of external forces
  double damping_left = 0.0;  // the first damping half-flow; where a step ends with a projection, all of −∫Q dt
  // What the Hamiltonian substep takes from the energy it is to keep: the dissipation of S, −½wᵀGw with
  // G = −(F + Fᵀ + FᵀMF), w = Mz + f; before a projection what ẑ misses of the dissipation.
  double substep = 0.0;
  // What the substep changes of that energy beside it, because the equation of a closure (avf, lm, dm) was solved to a
  // tolerance, or the linear systems in it (of avf); sav solves its own in closed form, and a projection ends on its
  // energy.
  double scalar = 0.0;
  double auxiliary = 0.0;      // change of H − modified energy in the substep: V drifts from r² − C
  double projection = 0.0;     // onto the energy of the law
  double damping_right = 0.0;  // the second damping half-flow
  double heat = 0.0;           // of noise, beside the damping that it balances

  double sum() const;
  StepLedger& operator+=(const StepLedger& other) {  // every step does
    work += other.work, damping_left += other.damping_left, substep += other.substep, scalar += other.scalar;
    auxiliary += other.auxiliary, projection += other.projection;
    damping_right += other.damping_right, heat += other.heat;
    return *this;
  }
  void archive(Archive& a) { a.numbers(*this); }
  StepLedger& operator-=(const StepLedger& other);
};

// Its parts, in the order of the columns of energy.csv.
struct LedgerPart {
  std::string_view name;
  double StepLedger::*value;
};
std::span<const LedgerPart> ledger_parts();

struct StepReport {
  enum class Status { solved, failed };
  Status status = Status::solved;
  int scalar_iterations = 0;  // Newton or fixed-point sweeps
  int fallbacks = 0;          // times a solver left its first choice
  int unresolved = 0;         // scalar equations whose root was not found (plain Newton only)
  // 1 where h does not resolve what the damping acts on and the energy interval, widened for that, decided; 1 where the
  // step was taken in parts, since the whole of it found no solution.
  int widened = 0, halved = 0;
  ReplacedSteps replaced = {};  // itself, where that is so in some part of it
  std::string message = {};     // set on failure: what, with the numbers
  StepLedger ledger = {};       // filled where the stepper keeps one

  bool solved() const { return status == Status::solved; }
  StepReport& operator+=(const StepReport& other);
};

struct EnergyReading {
  double H = 0.0;          // ½zᵀMz + V(z)
  double modified = 0.0;   // ½zᵀMz + r² − C; equal to H where the method has none
  double round_off = 0.0;  // of H
  double modified_round_off = 0.0;
  double size = 0.0;       // |½zᵀMz| + |V(z)|
  StepLedger ledger = {};  // of all steps since the start of the run
};

// `step` allocates nothing for an h seen before, unless an implicit equation needs its Newton–Krylov fallback.
// Contract: a step that reports success obeys the method's energy law; a step that fails leaves the state as it was.
class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual void begin(State& state) = 0;                 // fills what the method keeps beside z and t
  virtual void restart(State& state) { begin(state); }  // the same for a z that something else has changed
  virtual StepReport step(State& state, double h) = 0;  // from t to t + h
  virtual EnergyReading energy(const State& state) const = 0;
  virtual bool has_modified_energy() const = 0;
  // From now on every step fills the ledger of its report, at the price of a few energies. The bits of a solution are
  // the same with and without.
  virtual void keep_ledger() = 0;
  // From now on a step is taken to be accurate where its error is at most this, in the max norm of physical values and
  // per unit of time: an auxiliary variable then has to be no worse.
  virtual void expect(double /*error_rate*/) {}
};

// A stepper that tells the error of its steps, and knows the solution inside the last one.
class AdaptiveStepper : public Stepper {
 public:
  virtual int order() const = 0;
  // As `step`, but where a step cannot be taken, or not be trusted, it fails: a shorter one is to be tried.
  virtual StepReport attempt(State& state, double h) = 0;
  // Of the last attempt that succeeded: an estimate of its local error, in the max norm of physical values. Nothing
  // where the method needs one more step to know.
  virtual std::optional<double> error(const State& state) = 0;
  // Of the same attempt: the part of that error by what D(t) and f(t) do between the times at which the method looks at
  // them, known without one more step. 0 for methods that take their integrals.
  virtual double quadrature_error(const State& /*state*/) { return 0; }
  virtual void undo(State& state) = 0;  // takes that attempt back, once
  // The solution at a time inside it, with all that `energy` asks of a state.
  virtual void interpolate(const State& state, double t, State& between) = 0;
  virtual void forget(State& state) = 0;  // what it remembers of the steps before; all else stays
  // Of a checkpoint, between two attempts: what it knows of the state beside the state, so that a run that goes on does
  // the same work. Reading may evaluate that again.
  virtual void archive_memory(Archive& /*archive*/, const State& /*state*/) {}
};

}  // namespace seiche
