// For processors with AVX-512; what is compiled here must not run on others.
#include <seiche/core/simd/sleef_kernels.hpp>

#ifdef __AVX512F__
#include <immintrin.h>
#include <sleef.h>

namespace seiche::sleef_kernels {
namespace {

struct Avx512 {
  using Register = __m512d;
  static Register sqrt(Register x) { return _mm512_sqrt_pd(x); }
};

}  // namespace

extern const VectorFunctions avx512;
constinit const VectorFunctions avx512 = SEICHE_VECTOR_FUNCTIONS(Avx512, 8, avx512f);

}  // namespace seiche::sleef_kernels
#endif
