#include <seiche/core/simd/sleef_kernels.hpp>
#include <seiche/core/simd/vector_function_sets.hpp>

#include <cmath>

#if defined(__x86_64__)
#include <emmintrin.h>
#include <sleef.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#include <sleef.h>
#endif

namespace seiche {
namespace sleef_kernels {
namespace {

struct SineAndCosine {
  double x, y;
};
struct Scalar {
  using Register = double;
};
constexpr VectorFunctions libm = {
    .sin = Loops<Scalar>::one<[](double x) { return std::sin(x); }>,
    .cos = Loops<Scalar>::one<[](double x) { return std::cos(x); }>,
    .tan = Loops<Scalar>::one<[](double x) { return std::tan(x); }>,
    .asin = Loops<Scalar>::one<[](double x) { return std::asin(x); }>,
    .acos = Loops<Scalar>::one<[](double x) { return std::acos(x); }>,
    .atan = Loops<Scalar>::one<[](double x) { return std::atan(x); }>,
    .sinh = Loops<Scalar>::one<[](double x) { return std::sinh(x); }>,
    .cosh = Loops<Scalar>::one<[](double x) { return std::cosh(x); }>,
    .tanh = Loops<Scalar>::one<[](double x) { return std::tanh(x); }>,
    .asinh = Loops<Scalar>::one<[](double x) { return std::asinh(x); }>,
    .acosh = Loops<Scalar>::one<[](double x) { return std::acosh(x); }>,
    .atanh = Loops<Scalar>::one<[](double x) { return std::atanh(x); }>,
    .exp = Loops<Scalar>::one<[](double x) { return std::exp(x); }>,
    .expm1 = Loops<Scalar>::one<[](double x) { return std::expm1(x); }>,
    .log = Loops<Scalar>::one<[](double x) { return std::log(x); }>,
    .log1p = Loops<Scalar>::one<[](double x) { return std::log1p(x); }>,
    .sqrt = Loops<Scalar>::one<[](double x) { return std::sqrt(x); }>,
    .pow = Loops<Scalar>::two<[](double a, double b) { return std::pow(a, b); }>,
    .instructions = "libm",
    .sincos = Loops<Scalar>::pair<[](double x) {
      return SineAndCosine{std::sin(x), std::cos(x)};
    }>,
};

#if defined(__x86_64__)
struct Sse2 {
  using Register = __m128d;
  static Register sqrt(Register x) { return _mm_sqrt_pd(x); }
};
constexpr VectorFunctions baseline = SEICHE_VECTOR_FUNCTIONS(Sse2, 2, sse2);
#elif defined(__aarch64__)
struct Neon {
  using Register = float64x2_t;
  static Register sqrt(Register x) { return vsqrtq_f64(x); }
};
constexpr VectorFunctions baseline = SEICHE_VECTOR_FUNCTIONS(Neon, 2, advsimd);
#else
constexpr VectorFunctions baseline = libm;  // of a processor that SLEEF does not know
#endif

}  // namespace

#if defined(__x86_64__)
extern const VectorFunctions avx512, avx2;
#endif

}  // namespace sleef_kernels

std::vector<VectorFunctions> all_vector_functions() {
  std::vector<VectorFunctions> all;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) all.push_back(sleef_kernels::avx512);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) all.push_back(sleef_kernels::avx2);
#endif
  all.push_back(sleef_kernels::baseline);
  all.push_back(sleef_kernels::libm);
  return all;
}

const char* sleef_version() {
#ifdef SLEEF_VERSION_MAJOR
#define SEICHE_TEXT(number)                #number
#define SEICHE_DOTTED(major, minor, patch) SEICHE_TEXT(major) "." SEICHE_TEXT(minor) "." SEICHE_TEXT(patch)
  return SEICHE_DOTTED(SLEEF_VERSION_MAJOR, SLEEF_VERSION_MINOR, SLEEF_VERSION_PATCHLEVEL);
#else
  return "none";
#endif
}

const VectorFunctions& vector_functions() {
  static const VectorFunctions widest = all_vector_functions().front();
  return widest;
}

}  // namespace seiche
