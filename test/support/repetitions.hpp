// How often a test does the same again.
#pragma once

namespace seiche::test {

#if defined(SEICHE_SANITIZED)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

// A tenth under the sanitizers, which look at each path of the code and not at long runs, and are ten times slower.
constexpr int repetitions(int n) { return sanitized ? (n + 9) / 10 : n; }

}  // namespace seiche::test
