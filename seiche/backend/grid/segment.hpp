// Parts of vectors as spans.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <span>

namespace seiche {

inline std::span<const double> segment(const Vector& v, Index begin, Index size) {
  return {v.data() + begin, static_cast<std::size_t>(size)};
}

inline std::span<double> segment(Vector& v, Index begin, Index size) {
  return {v.data() + begin, static_cast<std::size_t>(size)};
}

inline std::span<double> all(Vector& v) { return {v.data(), static_cast<std::size_t>(v.size())}; }

}  // namespace seiche
