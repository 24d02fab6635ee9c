#include <seiche/core/simd/multiversion.hpp>

namespace seiche {

#ifdef SEICHE_MULTIVERSION_IS_ON
namespace {
// Chosen by the same rule as the loops.
[[gnu::target("arch=x86-64-v4")]] const char* name() { return "x86-64-v4"; }
[[gnu::target("arch=x86-64-v3")]] const char* name() { return "x86-64-v3"; }
[[gnu::target("default")]] const char* name() { return "baseline"; }
}  // namespace

const char* instruction_set() { return name(); }
#else
const char* instruction_set() { return "baseline"; }
#endif

}  // namespace seiche
