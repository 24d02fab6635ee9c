// A method: one row of the method table.
#pragma once

#include <seiche/core/state.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace seiche {

struct StepReport {
  enum class Status { solved, failed };
  Status status = Status::solved;
  int scalar_iterations = 0;  // Newton or fixed-point sweeps
  int fallbacks = 0;          // times a solver left its first choice
  int unresolved = 0;         // scalar equations whose root was not found (plain Newton only)
  std::string message = {};   // set on failure: what, with the numbers

  bool solved() const { return status == Status::solved; }
  StepReport& operator+=(const StepReport& other);
};

struct EnergyReading {
  double H = 0.0;          // ½zᵀMz + V(z)
  double modified = 0.0;   // ½zᵀMz + r² − C; equal to H where the method has none
  double round_off = 0.0;  // of H
  double modified_round_off = 0.0;
};

// `step` allocates nothing for an h seen before, unless an implicit equation needs its Newton–Krylov fallback.
// Contract: a step that reports success obeys the method's energy law; a step that fails leaves the state as it was.
class Stepper {
 public:
  virtual ~Stepper() = default;
  virtual void begin(State& state) = 0;                 // fills what the method keeps beside z and t
  virtual StepReport step(State& state, double h) = 0;  // from t to t + h
  virtual EnergyReading energy(const State& state) const = 0;
  virtual bool has_modified_energy() const = 0;
};

// A stepper that tells the error of its steps, and knows the solution inside the last one.
class AdaptiveStepper : public Stepper {
 public:
  virtual int order() const = 0;
  // As `step`, but where a step cannot be taken, or not be trusted, it fails: a shorter one is to be tried.
  virtual StepReport attempt(State& state, double h) = 0;
  // Of the last attempt that succeeded: an estimate of its local error, in the max norm of physical values. Nothing where
  // the method needs one more step to know.
  virtual std::optional<double> error(const State& state) = 0;
  virtual void undo(State& state) = 0;                                    // takes that attempt back, once
  virtual void interpolate(const State& state, double t, Vector& z) = 0;  // the solution at a time inside it
  virtual void restart(State& state) = 0;                                 // forgets what was before: z has been changed
};

}  // namespace seiche
