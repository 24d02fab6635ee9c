#include <seiche/method/collocation/anderson_acceleration.hpp>

#include <limits>

namespace seiche {

AndersonAcceleration::AndersonAcceleration(const Space& space, std::size_t count, Potential::Support part, int memory)
    : space_(space), part_(part), pairs_(static_cast<std::size_t>(memory)) {
  const Index size = static_cast<Index>(count) * part.size;
  for (Vector* v : {&x_, &step_, &residual_, &least_}) v->setZero(size);
  for (Pair& p : pairs_) p = {Vector::Zero(size), Vector::Zero(size)};
  restart();
}

void AndersonAcceleration::restart() {
  known_ = oldest_ = 0;
  iterates_ = 0;
  residual_size_ = least_size_ = std::numeric_limits<double>::infinity();
}

void AndersonAcceleration::advance(std::span<Vector> x) {
  if (iterates_++ == 0) {
    for (std::size_t i = 0; i < x.size(); ++i) state(x_, i) = x[i].segment(part_.begin, part_.size);
    return;
  }
  least_.swap(residual_);  // the residual before, until it is no longer needed
  for (std::size_t i = 0; i < x.size(); ++i) state(residual_, i) = x[i].segment(part_.begin, part_.size) - state(x_, i);
  residual_size_ = space_.norm(residual_);
  if (iterates_ > 2) remember();

  least_ = residual_;
  step_.setZero();
  take_off(least_, step_, pairs_.size());
  least_size_ = space_.norm(least_);
  step_ += least_;
  x_ += step_;
  for (std::size_t i = 0; i < x.size(); ++i) x[i].segment(part_.begin, part_.size) = state(x_, i);
}

void AndersonAcceleration::take_off(Vector& residual, Vector& x, std::size_t without) const {
  for (std::size_t i = 0; i < known_; ++i) {
    if (i == without) continue;
    const double share = space_.dot(pairs_[i].of_residual, residual);
    residual -= share * pairs_[i].of_residual;
    x -= share * pairs_[i].of_x;
  }
}

void AndersonAcceleration::remember() {
  const bool is_full = known_ == pairs_.size();
  const std::size_t place = is_full ? oldest_ : known_;
  Pair& pair = pairs_[place];
  pair.of_x = step_;
  pair.of_residual = residual_ - least_;
  const double size = space_.norm(pair.of_residual);
  take_off(pair.of_residual, pair.of_x, place);
  const double left = space_.norm(pair.of_residual);
  constexpr double parallel = 1e-8;
  if (!(left > parallel * size)) {  // nothing new; or not a number
    pair.of_residual.setZero();
    pair.of_x.setZero();
    return;
  }
  pair.of_residual /= left;
  pair.of_x /= left;
  if (is_full)
    oldest_ = (oldest_ + 1) % pairs_.size();
  else
    ++known_;
}

}  // namespace seiche
