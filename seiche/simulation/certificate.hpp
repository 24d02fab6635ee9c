// Which hypotheses of the energy laws a problem meets, how that was decided, and a witness against one that fails.
#pragma once

#include <seiche/core/run_report.hpp>
#include <seiche/law/hypothesis.hpp>
#include <seiche/simulation/simulation.hpp>

#include <atomic>
#include <string>
#include <vector>

namespace seiche {

struct Certificate {
  std::vector<Hypothesis> hypotheses;
  LawPromise law;       // of H, or of the modified energy where the method has one
  std::string theorem;  // by which the law follows from the hypotheses; "" if none is promised
};

struct CertificateOptions {
  std::string method = "seisav";
  MethodOptions method_options = {};
  Noise noise = {};
  double t_start = 0.0, t_end = 0.0;
  bool sample_solution = true;  // follow a solution of its own, where structure decides nothing
  // One with this method, at its start: what is known of C is read off it instead of one made for that.
  const Simulation* at_start = nullptr;
  const Ranks* ranks = nullptr;             // who hold the parts of the problem; each calls for it
  const std::atomic<bool>* stop = nullptr;  // ends it with an Error, between two hypotheses or inside that solution
};

// Nothing here is taken from the numbers that a method computes with: operators are looked at mode by mode or by
// factorisation, and what can only be sampled is sampled along a solution of its own, by collocation with tolerance
// 1e-5. Throws Error where the method does not apply to the problem, and where a rate of damping is infinite before
// t_end.
Certificate certify(const Problem& problem, const CertificateOptions& options);

// {"hypotheses": […], "law": {…}}, as `seiche check --json` and summary.json have it.
std::string certificate_json(const Certificate& certificate);

}  // namespace seiche
