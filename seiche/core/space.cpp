#include <seiche/core/space.hpp>

namespace seiche {

Vector Space::physical(const Vector& z) const {
  Vector values(physical_size());
  to_physical(z, values);
  return values;
}

double Space::norm_inf(const Vector& z) const { return physical(z).lpNorm<Eigen::Infinity>(); }

}  // namespace seiche
