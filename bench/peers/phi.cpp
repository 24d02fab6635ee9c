#include <bench/peers/phi.hpp>

namespace seiche::bench {

std::vector<Matrix2> wave_blocks(const Equation& e, const Symbols& symbols) {
  std::vector<Matrix2> blocks;
  for (const double lambda : symbols.lambda) {
    const Real stiffness = Real{e.stiffness} * lambda + e.mass_squared;
    const Real damping = Real{e.gamma} + Real{e.beta} * lambda;
    blocks.push_back({0, 1, -stiffness, -damping});
  }
  return blocks;
}

std::vector<Complex> scalar_blocks(const Equation& e, const Symbols& symbols) {
  std::vector<Complex> blocks;
  for (std::size_t k = 0; k < symbols.lambda.size(); k += 2) blocks.push_back(scalar_symbol(e, symbols, k));
  return blocks;
}

WaveFlow::WaveFlow(const std::vector<Matrix2>& blocks, double h) {
  Matrix2 flow;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (k == 0 || !is_same(blocks[k], blocks[k - 1])) flow = phi(Real{h} * blocks[k])[0];
    a_.push_back(static_cast<double>(flow.a));
    b_.push_back(static_cast<double>(flow.b));
    c_.push_back(static_cast<double>(flow.c));
    d_.push_back(static_cast<double>(flow.d));
  }
}

void WaveFlow::apply(double* u, double* v) const {
  for (std::size_t k = 0; k < a_.size(); ++k) {
    const double old = u[k];
    u[k] = a_[k] * old + b_[k] * v[k];
    v[k] = c_[k] * old + d_[k] * v[k];
  }
}

}  // namespace seiche::bench
