// Sums of many terms.
#pragma once

#include <cstddef>

namespace seiche {

// With what round-off took from the sum so far added to the next term (Kahan, 1965): the error does not grow with the
// number of terms, where that of plain sums of n equal terms is up to n/2 ε. Terms are sums of blocks, short enough to
// be plain.
class LongSum {
 public:
  static constexpr std::size_t block = 512;  // terms, of eight plain sums side by side

  void add(double term) {
    const double whole = term - excess_;
    const double sum = sum_ + whole;
    excess_ = (sum - sum_) - whole;
    sum_ = sum;
  }
  double total() const { return sum_; }

 private:
  double sum_ = 0, excess_ = 0;
};

}  // namespace seiche
