#include <bench/peers/sundials_vector.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace seiche::bench {
namespace {

double* data(N_Vector v) { return NV_DATA_S(v); }
sunindextype length(N_Vector v) { return NV_LENGTH_S(v); }

void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
  const double* p = data(x);
  const double* q = data(y);
  double* out = data(z);
  for (sunindextype i = 0; i < length(x); ++i) out[i] = a * p[i] + b * q[i];
}

void scale(double c, N_Vector x, N_Vector z) {
  const double* p = data(x);
  double* out = data(z);
  for (sunindextype i = 0; i < length(x); ++i) out[i] = c * p[i];
}

void constant(double c, N_Vector z) { std::fill_n(data(z), length(z), c); }

void product(N_Vector x, N_Vector y, N_Vector z) {
  const double* p = data(x);
  const double* q = data(y);
  double* out = data(z);
  for (sunindextype i = 0; i < length(x); ++i) out[i] = p[i] * q[i];
}

void quotient(N_Vector x, N_Vector y, N_Vector z) {
  const double* p = data(x);
  const double* q = data(y);
  double* out = data(z);
  for (sunindextype i = 0; i < length(x); ++i) out[i] = p[i] / q[i];
}

void absolute(N_Vector x, N_Vector z) {
  const double* p = data(x);
  double* out = data(z);
  for (sunindextype i = 0; i < length(x); ++i) out[i] = std::abs(p[i]);
}

void inverse(N_Vector x, N_Vector z) {
  const double* p = data(x);
  double* out = data(z);
  for (sunindextype i = 0; i < length(x); ++i) out[i] = 1 / p[i];
}

void add_constant(N_Vector x, double c, N_Vector z) {
  const double* p = data(x);
  double* out = data(z);
  for (sunindextype i = 0; i < length(x); ++i) out[i] = p[i] + c;
}

// Σ f(i), in eight partial sums that the compiler can keep in one register.
template <class Term>
double sum(sunindextype n, const Term& term) {
  constexpr sunindextype lanes = 8;
  double partial[lanes] = {};
  sunindextype i = 0;
  for (; i + lanes <= n; i += lanes)
    for (sunindextype lane = 0; lane < lanes; ++lane) partial[lane] += term(i + lane);
  double total = 0;
  for (; i < n; ++i) total += term(i);
  for (const double p : partial) total += p;
  return total;
}

double dot(N_Vector x, N_Vector y) {
  const double* p = data(x);
  const double* q = data(y);
  return sum(length(x), [=](sunindextype i) { return p[i] * q[i]; });
}

double weighted_rms(N_Vector x, N_Vector w) {
  const double* p = data(x);
  const double* q = data(w);
  const double squares = sum(length(x), [=](sunindextype i) { return p[i] * q[i] * (p[i] * q[i]); });
  return std::sqrt(squares / static_cast<double>(length(x)));
}

double largest(N_Vector x) {
  const double* p = data(x);
  double most = 0;
  for (sunindextype i = 0; i < length(x); ++i) most = std::max(most, std::abs(p[i]));
  return most;
}

template <class Operation>
double seconds_of(const Operation& operation) {
  constexpr int repeats = 2000;
  double best = 1;
  for (int round = 0; round < 5; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < repeats; ++i) operation();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return best;
}

}  // namespace

SundialsVector make_vector(const std::vector<double>& values, SUNContext context) {
  SundialsVector v(N_VNew_Serial(static_cast<sunindextype>(values.size()), context));
  std::copy(values.begin(), values.end(), data(v.get()));
  _generic_N_Vector_Ops& table = *v->ops;  // copied by every N_VClone
  table.nvlinearsum = linear_sum;
  table.nvscale = scale;
  table.nvconst = constant;
  table.nvprod = product;
  table.nvdiv = quotient;
  table.nvabs = absolute;
  table.nvinv = inverse;
  table.nvaddconst = add_constant;
  table.nvdotprod = dot;
  table.nvwrmsnorm = weighted_rms;
  table.nvmaxnorm = largest;
  return v;
}

double packaged_vector_slowdown() {
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  const std::vector<double> values(1024, 1.0);
  double ratio = 1;
  {
    const SundialsVector x = make_vector(values, context);
    const SundialsVector y = make_vector(values, context);
    const SundialsVector z = make_vector(values, context);
    const double packaged = seconds_of([&] { N_VLinearSum_Serial(0.5, x.get(), 0.25, y.get(), z.get()); });
    const double ours = seconds_of([&] { linear_sum(0.5, x.get(), 0.25, y.get(), z.get()); });
    ratio = packaged / ours;
  }
  SUNContext_Free(&context);
  return ratio;
}

}  // namespace seiche::bench
