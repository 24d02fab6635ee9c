// Values over a plane as colours: one or several panels side by side with one colour bar.
#pragma once

#include <seiche/figure/plot/axis.hpp>
#include <seiche/figure/plot/rendering.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

struct ColourScale {
  double low = 0, high = 1;
  bool diverging = false;
  double beyond = 0;                  // the largest size of a value, where the scale ends before it; else 0
  bool above = false, below = false;  // then: values lie beyond its upper end, its lower one
};

struct MapPanel {
  std::string title = {};        // a literal for gnuplot, above the panel; "" for none
  std::string x_label, y_label;  // likewise
  std::size_t columns = 0, rows = 0;
  std::vector<double> values = {};                      // columns × rows, along x first
  double x_low = 0, x_high = 1, y_low = 0, y_high = 1;  // the edges of the first and the last cell
  std::optional<ColourScale> colours = {};              // of its own, with a bar beside it
};

// From `low` to `high`: from both sides of zero where they lie on both, and of one length then.
ColourScale colour_scale(double low, double high);

// A scale for several pictures: that of all their values, but where a few large ones would leave everything else pale,
// it ends where it covers 98 per cent of each picture.
class CommonScale {
 public:
  void add(std::vector<double> values);
  ColourScale scale() const;

 private:
  double low_ = 0, high_ = 0, most_ = 0;
  bool empty_ = true;
};

// One scale for all panels; but where the largest sizes in the panels differ by more than a factor of four, one for
// each, so that a wave that has died down is not shown as nothing. Panels that are zero but for round-off take no part
// in this.
ColourScale choose_scales(std::vector<MapPanel>& panels);

struct MapPlot {
  std::string stem, title, warning = {};  // the last below the title, "" for none
  std::string colour_label;               // a literal for gnuplot, along the bar of all
  std::string colour_symbol = {};         // likewise, short: above the bar of every panel
  ColourScale colours = {};
  std::vector<MapPanel> panels = {};
  std::size_t in_a_row = 1;
  bool equal_scales = false;  // one unit of length is as long along y as along x
};

std::string map_script(const MapPlot& plot, const Rendering& rendering);

}  // namespace seiche
