#include <seiche/core/space.hpp>

namespace seiche {

Vector Space::physical(const Vector& z) const {
  Vector values(physical_size());
  to_physical(z, values);
  return values;
}

}  // namespace seiche
