#include <seiche/backend/krylov/hessenberg_flow.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {

HessenbergFlow::HessenbergFlow(Index most_columns)
    : H_(most_columns + 1, most_columns), y_(most_columns + 1), term_(most_columns + 1), next_(most_columns + 1) {}

void HessenbergFlow::clear() {
  columns_ = 0;
  norm_ = 0;
}

void HessenbergFlow::append(const Vector& column) {
  const Index size = columns_ + 2;
  H_.col(columns_).head(size) = column.head(size);
  norm_ = std::max(norm_, column.head(size).lpNorm<1>());
  ++columns_;
}

void HessenbergFlow::start() {
  y_.head(columns_ + 1).setZero();
  y_[0] = 1;
}

double HessenbergFlow::reach() const { return norm_ > 0 ? 2 / norm_ : std::numeric_limits<double>::infinity(); }

void HessenbergFlow::advance(double tau) {
  constexpr int most_terms = 40;  // 2⁴⁰/40! is far below round-off
  const Index size = columns_ + 1;
  auto y = y_.head(size);
  auto term = term_.head(size);
  auto next = next_.head(size);
  term = y;
  for (int k = 1; k <= most_terms; ++k) {
    next.setZero();
    for (Index j = 0; j < columns_; ++j)
      if (term[j] != 0) next.head(j + 2) += (tau / k * term[j]) * H_.col(j).head(j + 2);
    y += next;
    term = next;
    if (term.lpNorm<Eigen::Infinity>() <= epsilon / 8 * y.lpNorm<Eigen::Infinity>()) break;
  }
}

}  // namespace seiche
