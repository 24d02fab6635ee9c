// method = "auto": which method, from what the problem is like and how accurate it is to be.
#pragma once

#include <seiche/core/system.hpp>
#include <seiche/method/methods.hpp>

#include <string>

namespace seiche {

// Rates of a problem at its start, 1/time.
struct ProblemRates {
  double linear = 0.0;    // spectral radius of L = SM − D₀, from below, by power iteration
  double damping = 0.0;   // the same of D₀
  double solution = 0.0;  // √(‖J²ż‖ / ‖ż‖) with J the derivative of the right-hand side, both without D₀
};

ProblemRates rates_of(const System& system);

struct MethodChoice {
  std::string method;
  MethodOptions options;  // as they were given
  std::string reason;     // what was seen, and what follows from it
};

struct MethodRequest {
  double tolerance = 0.0;  // of values at the end; 0 where steps have one size, then as for 1e-6
  double duration = 0.0;   // of the run; 0: not known
  bool by_kicks = false;   // a method that asks for no exponential may have the backend that suits it
  bool by_krylov =
      false;  // exact flows are Krylov spaces, which take as many products as kicks, or more, however long a step is
};

// The numbers it decides by are measurements (docs/performance.md, The choice of "auto").
MethodChoice choose_method(const Problem& problem, const System& system, const MethodRequest& request,
                           const MethodOptions& options = {});

}  // namespace seiche
