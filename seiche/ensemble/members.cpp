#include <seiche/config/case/case_parameters.hpp>
#include <seiche/config/data/initial_file.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/memory_limit.hpp>
#include <seiche/ensemble/members.hpp>
#include <seiche/problem/problems.hpp>
#include <seiche/simulation/run_memory.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace seiche {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  double uniform() { return std::ldexp(static_cast<double>(bits_() >> 11U), -53); }  // in [0, 1)

  double normal() {  // Box and Muller (1958)
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    const double angle = 2 * std::numbers::pi * uniform();
    spare_ = radius * std::sin(angle);
    has_spare_ = true;
    return radius * std::cos(angle);
  }

 private:
  std::mt19937_64 bits_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

double sample(const ParameterSamples& samples, std::int64_t member, std::int64_t count, Random& random) {
  switch (samples.kind) {
    case ParameterSamples::Kind::range: {
      const double place = count > 1 ? static_cast<double>(member) / static_cast<double>(count - 1) : 0.0;
      return samples.a + place * (samples.b - samples.a);
    }
    case ParameterSamples::Kind::uniform: return samples.a + random.uniform() * (samples.b - samples.a);
    case ParameterSamples::Kind::normal: return samples.a + samples.b * random.normal();
  }
  return samples.a;
}

const Parameter& find_parameter(const RunSpec& spec, const std::string& name) {
  for (const Parameter& parameter : problem_entry(spec).parameters)
    if (parameter.name == name) return parameter;
  throw Error("the problem {} has no parameter {}", spec.problem, name);
}

void set_number(RunSpec& spec, const std::string& name, double value) {
  CaseValue number;
  number.kind = CaseValue::Kind::number;
  number.number = value;
  number.text = fmt::format("{}", value);
  set_parameter(spec, find_parameter(spec, name), number, {});
}

std::shared_ptr<const Problem> problem_of(RunSpec spec, const Members& members, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) set_number(spec, members.parameters[i], values[i]);
  if (!values.empty()) renew_rates(spec);
  return std::make_shared<const Problem>(make_problem(spec));
}

void require_memory(const RunSpec& spec) {
  const double bytes = ensemble_bytes(spec);
  if (bytes > memory_limit())
    throw Error(
        "an ensemble of {} members needs about {:.3g} bytes, but only {:.3g} are available; choose fewer members",
        spec.ensemble->count(), bytes, memory_limit());
}

}  // namespace

double ensemble_bytes(const RunSpec& spec) {
  // Measured with seisav on grids of 20 to 120 points: what does not grow with the unknowns, and doubles for each of
  // them.
  constexpr double of_member = 1700, of_simulation = 13'000;
  constexpr double doubles_of_member = 17;  // states and panels
  const Problem problem = make_problem(spec);
  const double unknowns = 8 * static_cast<double>(problem.size());  // bytes of one number for each
  const auto members = static_cast<double>(spec.ensemble->count());
  const double simulations = spec.ensemble->parameters.empty() ? 1.0 : members;
  return members * (of_member + doubles_of_member * unknowns) +
         simulations * (of_simulation + simulation_bytes(find_method(spec.method), find_backend("modal"), problem));
}

Members make_members(const RunSpec& spec) {
  if (!spec.ensemble) throw Error("the case has no section [ensemble]");
  require_memory(spec);
  const EnsembleSpec& ensemble = *spec.ensemble;
  Members members;
  for (const auto& [name, samples] : ensemble.parameters) members.parameters.push_back(name);
  Random random(ensemble.seed);
  const std::int64_t count = ensemble.count();
  for (std::int64_t m = 0; m < count; ++m) {
    std::vector<double> values;
    for (const auto& [name, samples] : ensemble.parameters) values.push_back(sample(samples, m, count, random));
    try {
      EnsembleMember member;
      const bool same = m > 0 && values == members.values.back();
      member.problem = same ? members.list.back().problem : problem_of(spec, members, values);
      member.initial = ensemble.files.empty()
                           ? member.problem->initial
                           : read_initial_file(ensemble.files[static_cast<std::size_t>(m)], *member.problem);
      if (ensemble.perturb_initial > 0)
        for (double& value : member.initial) value += ensemble.perturb_initial * random.normal();
      members.list.push_back(std::move(member));
    } catch (const Error& error) {
      throw Error("member {} of the ensemble: {}", m + 1, error.what());
    }
    members.values.push_back(std::move(values));
  }
  return members;
}

}  // namespace seiche
