#include <seiche/figure/gnuplot.hpp>
#include <seiche/figure/plot/legend.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace seiche {
namespace {

constexpr double row_height = 0.135;
constexpr double sample_width = 0.22;
constexpr double sample_gap = 0.04;
constexpr double side_margin = 0.08;
constexpr double font_size = 6.3;

double entry_width(const Series& series) { return sample_width + sample_gap + text_width(series.label, font_size); }

}  // namespace

Legend::Legend(const std::vector<Series>& series, std::size_t room, double picture_width)
    : picture_width_(picture_width) {
  for (const Series& one : series) {
    if (!one.label.empty())
      entries_.push_back({.label = one.label,
                          .style = one.style,
                          .x = {},
                          .y = {},
                          .only_markers = one.only_markers,
                          .literal = one.literal});
  }
  if (entries_.empty()) return;
  const double usable = picture_width_ - 2 * side_margin;
  constexpr std::size_t most = 5;
  for (std::size_t columns = most; columns > 1; --columns) {
    const double pitch = usable / static_cast<double>(columns);
    bool fits = true;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      // The last entry may run into the empty columns after it.
      const std::size_t free = i + 1 == entries_.size() ? columns - i % columns : 1;
      fits = fits && entry_width(entries_[i]) + 0.03 <= pitch * static_cast<double>(free);
    }
    if (!fits) continue;
    columns_ = columns;
    break;
  }
  rows_ = (std::max(entries_.size(), room) + columns_ - 1) / columns_;
  // Four and four looks better than five and three.
  const std::size_t own_rows = (entries_.size() + columns_ - 1) / columns_;
  while (columns_ > 1 && (entries_.size() + columns_ - 2) / (columns_ - 1) == own_rows &&
         (std::max(entries_.size(), room) + columns_ - 2) / (columns_ - 1) == rows_) {
    --columns_;
  }
}

double Legend::height() const { return static_cast<double>(rows_) * row_height; }

std::string Legend::script(double top, double picture_height, const Theme& theme) const {
  const double pitch = (picture_width_ - 2 * side_margin) / static_cast<double>(columns_);
  std::string text;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Series& entry = entries_[i];
    const double x = side_margin + pitch * static_cast<double>(i % columns_);
    const std::size_t row = i / columns_;
    const double y = (top - row_height * (static_cast<double>(row) + 0.5)) / picture_height;
    const auto across = [&](double inches) { return (x + inches) / picture_width_; };
    if (!entry.only_markers)
      text += fmt::format("set arrow from screen {:.4f},{:.4f} to screen {:.4f},{:.4f} nohead front {}\n", across(0), y,
                          across(sample_width), y, gnuplot_line(entry.style));
    if (entry.style.marker != Marker::none) {
      text += fmt::format("set label '' at screen {:.4f},{:.4f} front point lc rgb '{}' {}\n", across(sample_width / 2),
                          y, entry.style.colour, gnuplot_marker(entry.style));
    }
    text += fmt::format("set label {} at screen {:.4f},{:.4f} left front font ',{}' textcolor rgb '{}'\n",
                        entry.literal.empty() ? gnuplot_text(entry.label) : entry.literal,
                        across(sample_width + sample_gap), y, font_size, theme.ink);
  }
  return text;
}

}  // namespace seiche
