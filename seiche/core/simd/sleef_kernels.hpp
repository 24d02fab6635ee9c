// VectorFunctions from SLEEF's functions of one register. For files that are compiled for one instruction set: nothing
// in here is shared between them, and they include no header with code of its own, which might be.
#pragma once

#include <seiche/core/simd/vector_functions.hpp>

#include <cstring>

namespace seiche::sleef_kernels {

// A set of instructions, Set, has the type of a register, Set::Register, and functions of one.
template <class Set>
struct Loops {
  using Register = typename Set::Register;
  static constexpr std::size_t lanes = sizeof(Register) / sizeof(double);

  static Register load(const double* p, std::size_t n) {
    Register r = {};
    std::memcpy(&r, p, n * sizeof(double));
    return r;
  }
  static void store(double* p, const Register& r, std::size_t n) { std::memcpy(p, &r, n * sizeof(double)); }

  template <auto f>
  static void one(const double* x, double* y, std::size_t n) {
    std::size_t i = 0;
    for (; i + lanes <= n; i += lanes) store(y + i, f(load(x + i, lanes)), lanes);
    if (i < n) store(y + i, f(load(x + i, n - i)), n - i);
  }
  template <auto f>
  static void two(const double* a, const double* b, double* y, std::size_t n) {
    std::size_t i = 0;
    for (; i + lanes <= n; i += lanes) store(y + i, f(load(a + i, lanes), load(b + i, lanes)), lanes);
    if (i < n) store(y + i, f(load(a + i, n - i), load(b + i, n - i)), n - i);
  }
  template <auto f>
  static void pair(const double* x, double* y, double* z, std::size_t n) {
    const auto put = [=](std::size_t i, std::size_t count) {
      const auto both = f(load(x + i, count));
      store(y + i, both.x, count);
      store(z + i, both.y, count);
    };
    std::size_t i = 0;
    for (; i + lanes <= n; i += lanes) put(i, lanes);
    if (i < n) put(i, n - i);
  }
};

// The functions that SLEEF calls Sleef_sin…_u10…, with `set` for the end of their names: d8_u10avx512f.
#define SEICHE_SLEEF_NAME(name, lanes, set) Sleef_##name##d##lanes##_u10##set
#define SEICHE_VECTOR_FUNCTIONS(Set, lanes, set)                                                        \
  {                                                                                                     \
    .sin = Loops<Set>::one<SEICHE_SLEEF_NAME(sin, lanes, set)>,                                         \
    .cos = Loops<Set>::one<SEICHE_SLEEF_NAME(cos, lanes, set)>,                                         \
    .tan = Loops<Set>::one<SEICHE_SLEEF_NAME(tan, lanes, set)>,                                         \
    .asin = Loops<Set>::one<SEICHE_SLEEF_NAME(asin, lanes, set)>,                                       \
    .acos = Loops<Set>::one<SEICHE_SLEEF_NAME(acos, lanes, set)>,                                       \
    .atan = Loops<Set>::one<SEICHE_SLEEF_NAME(atan, lanes, set)>,                                       \
    .sinh = Loops<Set>::one<SEICHE_SLEEF_NAME(sinh, lanes, set)>,                                       \
    .cosh = Loops<Set>::one<SEICHE_SLEEF_NAME(cosh, lanes, set)>,                                       \
    .tanh = Loops<Set>::one<SEICHE_SLEEF_NAME(tanh, lanes, set)>,                                       \
    .asinh = Loops<Set>::one<SEICHE_SLEEF_NAME(asinh, lanes, set)>,                                     \
    .acosh = Loops<Set>::one<SEICHE_SLEEF_NAME(acosh, lanes, set)>,                                     \
    .atanh = Loops<Set>::one<SEICHE_SLEEF_NAME(atanh, lanes, set)>,                                     \
    .exp = Loops<Set>::one<SEICHE_SLEEF_NAME(exp, lanes, set)>,                                         \
    .expm1 = Loops<Set>::one<SEICHE_SLEEF_NAME(expm1, lanes, set)>,                                     \
    .log = Loops<Set>::one<SEICHE_SLEEF_NAME(log, lanes, set)>,                                         \
    .log1p = Loops<Set>::one<SEICHE_SLEEF_NAME(log1p, lanes, set)>, .sqrt = Loops<Set>::one<Set::sqrt>, \
    .pow = Loops<Set>::two<SEICHE_SLEEF_NAME(pow, lanes, set)>, .instructions = #set,                   \
    .sincos = Loops<Set>::pair<SEICHE_SLEEF_NAME(sincos, lanes, set)>,                                  \
  }

}  // namespace seiche::sleef_kernels
