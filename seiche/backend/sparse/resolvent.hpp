// (A − p)⁻¹ for A = hSM and a pole p of a rational function: what Crank–Nicolson and Padé steps are made of.
#pragma once

#include <seiche/core/grid/sparse_operators.hpp>

#include <complex>
#include <memory>
#include <optional>

namespace seiche {

// S = [[0, I], [−I, −G]] and M = diag(K, W) with G and K symmetric and W diagonal and positive: equations of second
// order.
struct WaveStructure {
  SparseMatrix K, G;
  Vector inverse_W;
};
std::optional<WaveStructure> wave_structure(const SparseMatrix& S, const SparseMatrix& M);

class Resolvent {
 public:
  virtual ~Resolvent() = default;
  // x = (A − p)⁻¹b for a real pole p; x = Im((A − p)⁻¹b) / Im p for one of a complex pair. x must not be b.
  virtual void apply(const Vector& b, Vector& x) const = 0;
};

// Makes resolvents of one SM for any h and p.
class Resolvents {
 public:
  virtual ~Resolvents() = default;
  virtual std::unique_ptr<Resolvent> make(double h, std::complex<double> pole) const = 0;
};

// By factors. For a wave structure with the positions u eliminated,
//   (h²K + phG + p²W⁻¹)u = −((hG + pW⁻¹)a + hb),   v = W⁻¹(a + pu)/h   for right-hand side (a, b),
// a symmetric matrix of half the size. Otherwise A − p itself is factorised, as a symmetric matrix where SM is one.
class ResolventFactory final : public Resolvents {
 public:
  ResolventFactory(const SparseMatrix& S, const SparseMatrix& M);
  ~ResolventFactory() override;
  std::unique_ptr<Resolvent> make(double h, std::complex<double> pole) const override;
  // Of one resolvent with a complex pole; found without its numbers. Of LU an estimate: pivoting may fill more.
  double factor_bytes() const;

 private:
  struct Shared;
  std::shared_ptr<const Shared> shared_;
};

}  // namespace seiche
