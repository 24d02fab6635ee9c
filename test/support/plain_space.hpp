// A space whose coordinates are the physical values.
#pragma once

#include <seiche/core/space.hpp>

namespace seiche::test {

class PlainSpace final : public Space {
 public:
  explicit PlainSpace(Index size) : size_(size) {}
  Index size() const override { return size_; }
  Index physical_size() const override { return size_; }
  void to_physical(const Vector& z, Vector& values) const override { values = z; }
  void from_physical(const Vector& values, Vector& z) const override { z = values; }

 private:
  Index size_;
};

}  // namespace seiche::test
