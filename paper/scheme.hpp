// A scheme of the paper: its ẑ is taken by the gradient at the start of the step.
#pragma once

#include <seiche/simulation/simulation.hpp>

#include <string>
#include <utility>

namespace seiche {

inline SimulationOptions scheme(std::string method, AuxiliaryMode auxiliary = AuxiliaryMode::transport,
                                ScalarSolver solver = ScalarSolver::robust) {
  return {
      .method = std::move(method),
      .method_options = {.C = {}, .auxiliary = auxiliary, .scalar_solver = solver, .predictor = Predictor::gradient}};
}

}  // namespace seiche
