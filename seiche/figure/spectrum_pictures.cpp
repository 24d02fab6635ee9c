#include <seiche/figure/curve_picture.hpp>
#include <seiche/figure/curves.hpp>
#include <seiche/figure/spectrum_pictures.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace seiche {
namespace {

using Quantity = std::function<std::optional<double>(const SpectrumRow&)>;

// Over the exact frequency, from slow modes to fast ones; no more points than the eye tells apart.
Curve over_frequency(const Spectrum& spectrum, const Quantity& quantity) {
  std::vector<const SpectrumRow*> rows;
  for (const SpectrumRow& row : spectrum.rows) rows.push_back(&row);
  std::stable_sort(rows.begin(), rows.end(),
                   [](const SpectrumRow* a, const SpectrumRow* b) { return a->exact_frequency < b->exact_frequency; });
  Curve curve;
  for (const SpectrumRow* row : rows) {
    const std::optional<double> value = quantity(*row);
    if (!value || !std::isfinite(*value)) continue;
    curve.t.push_back(row->exact_frequency);
    curve.value.push_back(*value);
  }
  return thinned(curve, 1000);
}

Series series_of(Curve curve, std::string label, const LineStyle& style, int layer) {
  return {
      .label = std::move(label), .style = style, .x = std::move(curve.t), .y = std::move(curve.value), .layer = layer};
}

CurvePicture picture_of(const Spectrum& spectrum, const std::string& stem, const std::string& what,
                        const std::string& y_label, std::vector<Series> series) {
  return {.stem = stem,
          .title = fmt::format("{}, {}, h = {}: {}", spectrum.problem, method_label(spectrum.method),
                               step_text(spectrum.h), what),
          .caption = {},
          .x = {.label = "exact angular frequency"},
          .y = {.label = y_label},
          .series = std::move(series)};
}

}  // namespace

void draw_spectrum(const Spectrum& spectrum, const std::filesystem::path& directory) {
  LineStyle style = method_line(spectrum.method);
  Series numerical = series_of(over_frequency(spectrum, [](const SpectrumRow& row) { return row.numerical_decay; }),
                               method_label(spectrum.method), style, 0);
  const Series exact = series_of(over_frequency(spectrum, [](const SpectrumRow& row) { return row.exact_decay; }),
                                 "equation", reference_line(), reference_layer);
  numerical.marked = staggered(numerical.x, 0, 1);
  Series phase = series_of(over_frequency(spectrum, [](const SpectrumRow& row) { return row.phase_error(); }),
                           method_label(spectrum.method), style, 0);
  phase.marked = staggered(phase.x, 0, 1);
  std::vector<CurvePicture> pictures = {picture_of(spectrum, "spectrum_decay", "decay of the modes", "decay rate",
                                                   {numerical, exact}),
                                        picture_of(spectrum, "spectrum_phase", "error of the frequencies",
                                                   "relative error", {phase})};
  draw_curves(pictures, directory);
}

}  // namespace seiche
