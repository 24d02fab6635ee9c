// Trajectories that the methods are judged by: Boost.odeint's Fehlberg 7(8) on the physical equation, which shares
// nothing with our methods, or the paper's own reference, SEAVF at h = 2⁻¹⁰/100.
#pragma once

#include <seiche/core/problem.hpp>

#include <atomic>
#include <span>
#include <string>
#include <vector>

namespace seiche {

enum class ReferenceKind { fehlberg78, seavf };

struct ReferenceOptions {
  ReferenceKind kind = ReferenceKind::fehlberg78;
  double tolerance = 1e-14;                 // fehlberg78: absolute and relative, per step
  double seavf_h = 1.0 / 1024 / 100;        // the paper's
  const std::atomic<bool>* stop = nullptr;  // ends the computation with an Error
};

// z(t) and H at increasing times, the first of them 0.
class Reference {
 public:
  std::size_t count() const { return t_.size(); }
  double time(std::size_t k) const { return t_[k]; }
  std::span<const double> state(std::size_t k) const { return {states_.data() + k * size_, size_}; }
  double energy(std::size_t k) const { return energy_[k]; }
  double potential(std::size_t k) const { return potential_[k]; }
  std::size_t index_of(double t) const;  // throws Error if there is no such time

  std::string description;
  double error = 0.0;         // max ‖·‖_∞ between this and a second reference, see `description`
  double energy_error = 0.0;  // the same of H

 private:
  friend Reference make_reference(const Problem&, const std::vector<double>&, const ReferenceOptions&);
  std::size_t size_ = 0;
  std::vector<double> t_, states_, energy_, potential_;
};

// The times k h (k = 0, 1, …; the last one t_end) of all step sizes, merged.
std::vector<double> sample_times(std::span<const double> step_sizes, double t_end);

// Throws Error where the solution is no longer finite, does not fit into memory, or needs more steps than will ever
// end.
Reference make_reference(const Problem& problem, const std::vector<double>& times,
                         const ReferenceOptions& options = {});

}  // namespace seiche
