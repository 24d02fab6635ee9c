#include <seiche/backend/krylov/restoration.hpp>

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace seiche {

Restoration::Restoration(const Product& M, const Space& space, double& moved)
    : M_(M), space_(space), moved_(moved), Mq_(space.size()) {
  for (Pair& pair : before_)
    for (Vector* v : {&pair.w, &pair.y, &pair.My}) v->resize(space.size());
}

void Restoration::start(const Vector& w, Vector& y) {
  known_ = 0;
  follow(w, y);
}

void Restoration::follow(const Vector& f, Vector& q) {
  for (int round = 0; round < most_rounds && misses(f, q); ++round) move(f, q);
  if (known_ == before_.size()) return;
  Pair& pair = before_[known_++];
  pair.w = f;
  pair.y = q;
  M_.apply(q, pair.My);
}

const Vector& Restoration::y(Index i, const Vector& q) const {
  return i < std::ssize(before_) && i < static_cast<Index>(known_) ? before_[static_cast<std::size_t>(i)].y : q;
}

// Sets e, in units of the sizes of its terms; true where one is more than round-off.
bool Restoration::misses(const Vector& f, const Vector& q) {
  const auto n = static_cast<Index>(known_);
  const auto length = [this](const Vector& v) { return space_.norm(v); };
  M_.apply(q, Mq_);
  e_.resize(n + 1);
  size_.resize(n + 1);
  const double of_f = length(f), of_q = length(q);
  for (Index j = 0; j < n; ++j) {
    const Pair& pair = before_[static_cast<std::size_t>(j)];
    size_[j] = of_q * (length(pair.w) + length(pair.My)) + of_f * length(pair.y);
    e_[j] = dot(pair.w, q) + dot(f, pair.y) + dot(pair.My, q);
  }
  size_[n] = of_q * (2 * of_f + length(Mq_));
  e_[n] = 2 * dot(f, q) + dot(q, Mq_);
  bool misses = false;
  for (Index j = 0; j <= n; ++j) {
    if (size_[j] == 0) size_[j] = 1;  // at rest, or without a force
    e_[j] /= size_[j];
    misses = misses || std::abs(e_[j]) > 2 * epsilon;
  }
  return misses;
}

// One step of Newton's method from there.
void Restoration::move(const Vector& f, Vector& q) {
  const auto n = static_cast<Index>(known_);
  const double of_q = space_.norm(q);
  Matrix J(n + 1, n + 1);
  for (Index i = 0; i <= n; ++i) {
    const Vector& direction = y(i, q);
    const double length = space_.norm(direction);
    const double unit = length > 0 ? of_q / length : 0;  // every direction as long as q
    for (Index j = 0; j < n; ++j) {
      const Pair& pair = before_[static_cast<std::size_t>(j)];
      J(j, i) = unit * (dot(pair.w, direction) + dot(pair.My, direction)) / size_[j];
    }
    J(n, i) = unit * 2 * (dot(f, direction) + dot(Mq_, direction)) / size_[n];
  }
  // At rest, without a force, or where two forces are nearly one, there are fewer directions to move in.
  Eigen::JacobiSVD<Matrix> svd(J, Eigen::ComputeFullU | Eigen::ComputeFullV);
  svd.setThreshold(1e-12);
  if (svd.rank() == 0) return;
  const Coefficients a = svd.solve(-e_);
  if (!a.allFinite()) return;
  moved_ = std::max(moved_, a.cwiseAbs().maxCoeff());
  q *= 1 + a[n];
  for (Index i = 0; i < n; ++i) {
    const Vector& direction = y(i, q);
    const double length = space_.norm(direction);
    if (length > 0) q += (a[i] * of_q / length) * direction;
  }
}

}  // namespace seiche
