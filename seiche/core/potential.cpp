#include <seiche/core/potential.hpp>

namespace seiche {

double PointwisePotential::value_and_gradient_in_place(double in, double out, std::span<double> values) const {
  thread_local std::vector<double> u;
  u.resize(values.size());
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = in * values[i];
  const double v = value_and_gradient(u, values);
  for (double& g : values) g *= out;
  return v;
}

}  // namespace seiche
