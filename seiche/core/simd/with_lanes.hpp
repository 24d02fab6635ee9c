// Loops over eight lanes at a time, compiled for the registers of several instruction sets.
#pragma once

#include <seiche/core/simd/lanes.hpp>
#include <seiche/core/simd/multiversion.hpp>

namespace seiche {

// body.operator()<V>() with eight lanes V in the widest registers of this machine, as SEICHE_MULTIVERSION chooses. The
// body must be inlined into its version. What it captures by value stays in registers; what it captures by reference is
// read again behind every store.
#ifdef SEICHE_MULTIVERSION_IS_ON
namespace lanes_detail {
template <class Body>
[[gnu::target("arch=x86-64-v4")]] auto in_512_bits(const Body& given) {
  const Body body = given;
  return body.template operator()<Lanes>();
}
template <class Body>
[[gnu::target("arch=x86-64-v3")]] auto in_256_bits(const Body& given) {
  const Body body = given;
  return body.template operator()<LanesInHalves>();
}
}  // namespace lanes_detail

template <class Body>
[[gnu::always_inline]] inline auto with_lanes(const Body& body) {
  switch (register_bits) {
    case 512: return lanes_detail::in_512_bits(body);
    case 256: return lanes_detail::in_256_bits(body);
    default: return body.template operator()<LanesInQuarters>();
  }
}
#else  // those that the compiler was told of
template <class Body>
auto with_lanes(const Body& body) {
#if defined(__AVX512F__)
  return body.template operator()<Lanes>();
#elif defined(__AVX__)
  return body.template operator()<LanesInHalves>();
#else
  return body.template operator()<LanesInQuarters>();
#endif
}
#endif

}  // namespace seiche
