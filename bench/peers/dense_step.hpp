// A step of seisav on few points as it would be written for them alone: full matrices in the registers of the
// processor at hand, no guard, no ledger, nothing that another problem would need.
#pragma once

#include "equation.hpp"

#include <memory>
#include <vector>

namespace seiche::bench {

class DenseStep {
 public:
  virtual ~DenseStep() = default;
  virtual void step() = 0;
  virtual void restart() = 0;
  virtual std::vector<double> state() const = 0;  // field-major
};

// Of klein_gordon on 4, 8, 20 or 64 points in one dimension, with a constant γ; else null.
std::unique_ptr<DenseStep> dense_step(const Equation& equation, double h);

}  // namespace seiche::bench
