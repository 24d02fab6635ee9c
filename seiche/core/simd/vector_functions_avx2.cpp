// For processors with AVX2; what is compiled here must not run on others.
#include <seiche/core/simd/sleef_kernels.hpp>

#ifdef __AVX2__
#include <immintrin.h>
#include <sleef.h>

namespace seiche::sleef_kernels {
namespace {

struct Avx2 {
  using Register = __m256d;
  static Register sqrt(Register x) { return _mm256_sqrt_pd(x); }
};

}  // namespace

extern const VectorFunctions avx2;
constinit const VectorFunctions avx2 = SEICHE_VECTOR_FUNCTIONS(Avx2, 4, avx2);

}  // namespace seiche::sleef_kernels
#endif
