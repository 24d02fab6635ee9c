// Anderson's acceleration of a fixed-point iteration.
#pragma once

#include <seiche/core/potential.hpp>
#include <seiche/core/space.hpp>

#include <span>
#include <vector>

namespace seiche {

// x = G(x), for several states together (D. G. Anderson, J. ACM 12 (1965) 547; H. F. Walker, P. Ni, SIAM J. Numer.
// Anal. 49 (2011) 1715). The next iterate is that combination of the last ones whose residual G(x) − x is least, if G
// is taken to be linear, and this least residual added to it. For linear G, and as long as the memory is not full, that
// is GMRES: it converges where plain iteration does not, and needs no derivative of G. In a full memory the newest pair
// of differences takes the place of the oldest, against which the others stay orthogonal.
class AndersonAcceleration {
 public:
  // Of `count` states with the unknowns `part`; `memory`: so many differences of iterates.
  AndersonAcceleration(const Space& space, std::size_t count, Potential::Support part, int memory);

  void restart();  // the next call brings a first iterate
  // x: G of the iterate before; becomes the next iterate.
  void advance(std::span<Vector> x);

  double size() const { return space_.norm(x_); }  // |x|
  // |G(x) − x| of the iterate before that call; infinite at the first.
  double residual() const { return residual_size_; }
  // |least|
  double least_residual() const { return least_size_; }
  // Its last state, in the unknowns; all else of z stays.
  void least_residual(Vector& z) const { z.segment(part_.begin, part_.size) = least_.tail(part_.size); }

 private:
  struct Pair {
    Vector of_x, of_residual;  // differences; those of residuals are orthonormal
  };
  // What of a residual lies in the pairs, but for one of them, and the same shares of their x.
  void take_off(Vector& residual, Vector& x, std::size_t without) const;
  void remember();  // the last step, and by what it has changed the residual
  auto state(Vector& of_all, std::size_t i) const {
    return of_all.segment(static_cast<Index>(i) * part_.size, part_.size);
  }

  const Space& space_;
  Potential::Support part_;
  std::vector<Pair> pairs_;
  std::size_t known_ = 0, oldest_ = 0;
  int iterates_ = 0;
  double residual_size_ = 0, least_size_ = 0;
  Vector x_, step_, residual_, least_;
};

}  // namespace seiche
