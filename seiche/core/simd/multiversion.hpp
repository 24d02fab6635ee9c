#pragma once

// SEICHE_MULTIVERSION before a function compiles it once for each of three instruction sets (AVX-512, AVX2 with FMA,
// the baseline) and chooses when the program starts: what is installed runs on every machine of the architecture, and
// hot loops still use the widest vectors. Templates and lambdas called inside must be inlined into it to profit.

#include <cstddef>  // defines __GLIBC__ where there is one

// The choice needs indirect functions of the GNU C library, and must not run before a sanitiser has started.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#if __GNUC__ >= 12
#define SEICHE_MULTIVERSION_IS_ON
#define SEICHE_MULTIVERSION [[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#endif
#endif
#ifndef SEICHE_MULTIVERSION_IS_ON
#define SEICHE_MULTIVERSION
#endif

namespace seiche {

// Which of the versions runs here: "x86-64-v4", "x86-64-v3" or "baseline".
const char* instruction_set();
int find_register_bits();
// Of its vectors: 512, 256 or 128. Before main begins it may still be 0.
inline const int register_bits = find_register_bits();

}  // namespace seiche
