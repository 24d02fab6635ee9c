#include "paper_cases.hpp"

#include <seiche/core/error.hpp>
#include <seiche/damping/rates.hpp>
#include <seiche/method/methods.hpp>
#include <seiche/problem/alpha_fpu.hpp>
#include <seiche/problem/gkdv.hpp>
#include <seiche/problem/klein_gordon.hpp>
#include <seiche/problem/oscillator.hpp>

namespace seiche::test {

Problem klein_gordon_case(double gamma, double alpha) {
  return klein_gordon({.alpha = alpha, .gamma = constant_rate(gamma)});
}

Problem fpu_conservative_case(double gamma, double beta) {
  return alpha_fpu({.beta = beta, .gamma = constant_rate(gamma)});
}

Problem fpu_dissipative_case(double gamma, double beta) {
  return alpha_fpu({.beta = beta, .gamma = constant_rate(gamma), .formulation = AlphaFpu::Formulation::dissipative});
}

Problem gkdv_case(double mu, double sigma, double amplitude) {
  Problem p = gkdv({.sigma = sigma, .mu = constant_rate(mu)});
  p.initial *= amplitude / 0.4;
  return p;
}

Problem duffing_case(double gamma) { return oscillator({.gamma = constant_rate(gamma)}); }

std::vector<NamedProblem> golden_cases() {
  return {{"paper_KG", klein_gordon_case()},
          {"paper_FPU_2.1", fpu_conservative_case()},
          {"paper_FPU_2.2", fpu_dissipative_case()},
          {"paper_gKdV", gkdv_case()}};
}

std::vector<NamedProblem> all_cases() {
  std::vector<NamedProblem> cases = golden_cases();
  cases.push_back({"KG_defocusing", klein_gordon_case(0.1, 1.0)});
  cases.push_back({"gKdV_sigma_1", gkdv_case(0.5, 1.0, 1.0)});
  cases.push_back({"Duffing", duffing_case()});
  return cases;
}

bool applies(std::string_view method, const Problem& problem) {
  if (find_method(method).composition != Composition::whole) return true;
  try {
    with_damping_merged(problem);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace seiche::test
