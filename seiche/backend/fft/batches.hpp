// Lines that are transformed side by side.
#pragma once

#include <seiche/core/base/vector.hpp>

#include <algorithm>

namespace seiche {

// `lines` in batches of at most `width`, but that one line left over joins the last: FFTW computes a line alone in
// another way than side by side with others, and bits would depend on where lines are cut.
class Batches {
 public:
  Batches(Index lines, Index width) : lines_(lines), width_(std::clamp<Index>(lines, 1, width)) {
    const Index over = lines_ % width_;
    count_ = lines_ / width_ + (over > 1 ? 1 : 0);
  }
  Index count() const { return count_; }
  Index width() const { return width_; }
  Index begin(Index batch) const { return batch * width_; }
  Index size(Index batch) const { return batch + 1 == count_ ? lines_ - begin(batch) : width_; }
  Index most() const { return std::max(width_, rest()); }  // lines of the largest
  Index rest() const {                                     // lines of a last batch of another size; else 0
    const Index last = count_ > 0 ? size(count_ - 1) : 0;
    return last == width_ ? 0 : last;
  }

 private:
  Index lines_, width_, count_;
};

}  // namespace seiche
