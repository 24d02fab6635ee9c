// The legend below a picture. gnuplot's own key spaces proportional fonts as if every letter were wide.
#pragma once

#include <seiche/figure/plot/plot.hpp>

#include <string>
#include <vector>

namespace seiche {

class Legend {
 public:
  // `room`: leave space for at least so many entries. Lengths are in inches.
  Legend(const std::vector<Series>& series, std::size_t room, double picture_width);

  double height() const;
  // Commands for gnuplot; the legend's top edge is `top` above the bottom of a picture of `picture_height`.
  std::string script(double top, double picture_height, const Theme& theme) const;

 private:
  std::vector<Series> entries_;  // without their data
  double picture_width_;
  std::size_t columns_ = 1;
  std::size_t rows_ = 0;
};

}  // namespace seiche
