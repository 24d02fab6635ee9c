#include <seiche/core/simd/multiversion.hpp>

namespace seiche {

#ifdef SEICHE_MULTIVERSION_IS_ON
namespace {
// Chosen by the same rule as the loops.
[[gnu::target("arch=x86-64-v4")]] int bits() { return 512; }
[[gnu::target("arch=x86-64-v3")]] int bits() { return 256; }
[[gnu::target("default")]] int bits() { return 128; }
}  // namespace

int find_register_bits() { return bits(); }
#elif defined(__AVX512F__)
int find_register_bits() { return 512; }
#elif defined(__AVX__)
int find_register_bits() { return 256; }
#else
int find_register_bits() { return 128; }
#endif

const char* instruction_set() {
  return register_bits == 512 ? "x86-64-v4" : register_bits == 256 ? "x86-64-v3" : "baseline";
}

}  // namespace seiche
