// Elementary functions of many numbers at once, by SLEEF (Shibata, Petrogalli 2020) on the processor's widest vectors.
#pragma once

#include <cstddef>

namespace seiche {

// n numbers each, and the result may lie where an argument does. Errors are at most 1 ulp; libm's own are hardly above
// ½ ulp for the usual functions and up to 1.8 ulp for hyperbolic ones. But sinh and cosh may be infinite from 709 on,
// asinh and acosh from 1e154 on. A result depends on nothing but its argument, except for sin, cos and tan of or
// next to numbers above 15 in size, where the last bit may change with the neighbours; sincos may differ from sin and
// cos by that bit. AVX-512 and AVX2 give the same bits as long as angles are no longer than 10⁶.
struct VectorFunctions {
  using One = void (*)(const double* x, double* y, std::size_t n);
  using Two = void (*)(const double* a, const double* b, double* y, std::size_t n);
  One sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, asinh, acosh, atanh, exp, expm1, log, log1p, sqrt;
  Two pow;
  const char* instructions;  // that they are made of
  void (*sincos)(const double* x, double* sines, double* cosines, std::size_t n);
};

// Those of the widest vectors that this processor has.
const VectorFunctions& vector_functions();
// "3.5.1"
const char* sleef_version();

}  // namespace seiche
