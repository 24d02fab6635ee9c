#include <seiche/figure/gnuplot.hpp>
#include <seiche/figure/plot/coincide.hpp>
#include <seiche/figure/plot/corners.hpp>
#include <seiche/figure/plot/curves.hpp>
#include <seiche/figure/plot/style.hpp>
#include <seiche/figure/plot/symbols.hpp>
#include <seiche/figure/run_curves.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace seiche {
namespace {

constexpr const char* energy_change_label = "'{/:Italic H} − {/:Italic H}(0)'";
constexpr Index few_points = 4;
constexpr Index most_states = 20000;  // of a curve over time: more are not seen, and take long to read

const std::array<std::string, 6>& colours = curve_colours();
constexpr std::array dashes = {Dash::solid, Dash::dashed, Dash::dash_dotted, Dash::dotted};

double span_of(const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return high - low;
}

Axis values_axis(const std::vector<Series>& all, bool logarithmic) {
  std::vector<double> values;
  for (const Series& series : all) values.insert(values.end(), series.y.begin(), series.y.end());
  return fitted_axis(logarithmic, values);
}

Axis time_axis(const std::vector<double>& t) {
  if (t.empty()) return axis_between(false, 0, 1);
  return t.back() > t.front() ? axis_between(false, t.front(), t.back()) : fitted_axis(false, t);
}

Series line(std::string label, const Curve& curve, LineStyle style, int layer = 0) {
  const Curve thin = thinned(curve, 1500);
  return {.label = std::move(label), .style = std::move(style), .x = thin.t, .y = thin.value, .layer = layer};
}

// Curves that hide one another: both are made visible, and the caption says it.
void show_coinciding(Plot& plot, std::string& caption) {
  const auto groups = coinciding_series(plot);
  for (const std::string& sentence : {coincidence_sentence(plot, groups), nest(plot, groups)})
    if (!sentence.empty()) caption += " " + sentence;
}

CurvePicture energy_picture(const RunFiles& run, const EnergyHistory& history) {
  Curve H = history.H;
  std::optional<Curve> modified = history.modified;
  const double first = H.value.empty() ? 0.0 : H.value.front();
  // A change that the ticks of H would not show.
  double span = span_of(H.value);
  if (modified && !modified->value.empty())
    for (const double value : modified->value) span = std::max(span, std::abs(value - first));
  const bool relative = span < 1e-6 * std::abs(first);
  if (relative) {
    for (double& value : H.value) value -= first;
    if (modified)
      for (double& value : modified->value) value -= first;
  }
  std::vector<Series> all;
  all.push_back(line("H", H, {.colour = colours[0], .width = 1.4}));
  all.back().literal = relative ? energy_change_label : "'{/:Italic H}'";
  if (modified)
    all.push_back(line("modified energy", *modified, {.colour = colours[1], .dash = Dash::dashed, .width = 1.0}, 1));
  const bool decades = !relative && falls_by_decades({H}) && (!modified || falls_by_decades({*modified}));
  std::string caption = "The energy H = ½zᵀMz + V(z)";
  if (relative) caption += fmt::format(", as its change since the start, where it is {:.6g}", first);
  if (modified) caption += ", and the modified energy whose law the method keeps";
  caption += ".";
  const Axis y = values_axis(all, decades);
  Plot plot{.stem = "energy",
            .title = title_of(run, "energy"),
            .x_label = time_axis_label,
            .y_label = relative ? energy_change_label : "'energy {/:Italic H}'",
            .x = time_axis(H.t),
            .y = y,
            .series = std::move(all)};
  show_coinciding(plot, caption);
  return {std::move(caption), std::move(plot)};
}

CurvePicture ledger_picture(const RunFiles& run, const EnergyHistory& history) {
  Curve change = history.H;
  for (double& value : change.value) value -= history.H.value.front();
  double largest = span_of(change.value);
  for (const Curve& cause : history.causes) largest = std::max(largest, span_of(cause.value));
  std::vector<Series> all;
  std::size_t next = 0;
  for (const Curve& cause : history.causes) {
    if (!(span_of(cause.value) > 1e-3 * largest)) continue;
    all.push_back(line(cause_label(history, cause.name), cause,
                       {.colour = colours[next % colours.size()], .dash = dashes[next % dashes.size()], .width = 1.2}));
    ++next;
  }
  all.push_back(line("H − H(0)", change, {.colour = "#000000", .width = 0.7}, reference_layer));
  all.back().literal = energy_change_label;
  const Axis y = values_axis(all, false);
  Plot plot{.stem = "ledger",
            .title = title_of(run, "ledger"),
            .x_label = time_axis_label,
            .y_label = "'change of {/:Italic H} since {/:Italic t} = 0'",
            .x = time_axis(change.t),
            .y = y,
            .series = std::move(all)};
  std::string caption =
      "Where the change of H since the start comes from: the sum over all steps of each part of the ledger, and the change "
      "itself as a thin line. Parts below a thousandth of it are left out.";
  show_coinciding(plot, caption);
  return {std::move(caption), std::move(plot)};
}

// Every field at every point over time, field by field.
struct Histories {
  std::vector<double> t;
  std::vector<std::vector<double>> values;
};

Histories histories(const SolutionReader& solution) {
  Histories all;
  all.values.resize(solution.fields().size() * static_cast<std::size_t>(solution.points()));
  const std::vector<double> times = solution.times();
  Vector state;
  for (const Index k : spread(solution.count(), most_states)) {
    solution.state(k, state);
    all.t.push_back(times[static_cast<std::size_t>(k)]);
    for (std::size_t i = 0; i < all.values.size(); ++i) all.values[i].push_back(state[static_cast<Index>(i)]);
  }
  return all;
}

CurvePicture fields_over_time(const RunFiles& run, const SolutionReader& solution, const Histories& histories) {
  std::vector<Series> all;
  const auto points = static_cast<std::size_t>(solution.points());
  for (std::size_t i = 0; i < histories.values.size(); ++i) {
    const std::size_t field = i / points;
    const std::string& name = solution.fields()[field];
    const std::string which = points == 1 ? "" : fmt::format(", point {}", i % points + 1);
    all.push_back(line(in_text(name) + which, Curve{"", histories.t, histories.values[i]},
                       {.colour = colours[(points > 1 ? i % points : field) % colours.size()],
                        .dash = dashes[field % dashes.size()],
                        .width = 0.9}));
    all.back().literal = fmt::format("({} . {})", symbol(name), gnuplot_text(which));
  }
  std::string symbols;
  for (const std::string& name : solution.fields()) symbols += (symbols.empty() ? "" : " . ', ' . ") + symbol(name);
  const Axis y = values_axis(all, false);
  return {"Every field over time.", Plot{.stem = "fields",
                                         .title = title_of(run, "solution"),
                                         .x_label = time_axis_label,
                                         .y_label = "(" + symbols + ")",
                                         .x = time_axis(histories.t),
                                         .y = y,
                                         .series = std::move(all)}};
}

CurvePicture portrait(const RunFiles& run, const SolutionReader& solution, const Histories& histories, std::size_t a,
                      std::size_t b) {
  const auto points = static_cast<std::size_t>(solution.points());
  std::vector<Series> all;
  std::vector<double> x, y;
  for (std::size_t p = 0; p < points; ++p) {
    Series curve{.label = points > 1 ? fmt::format("point {}", p + 1) : "",
                 .style = {.colour = colours[p % colours.size()], .width = 0.7},
                 .x = histories.values[a * points + p],
                 .y = histories.values[b * points + p]};
    x.insert(x.end(), curve.x.begin(), curve.x.end());
    y.insert(y.end(), curve.y.begin(), curve.y.end());
    all.push_back(std::move(curve));
  }
  const Axis x_axis = fitted_axis(false, x), y_axis = fitted_axis(false, y);
  const std::string corners = show_corners(all, x_axis, y_axis, static_cast<std::size_t>(solution.count()));
  for (const bool start : {true, false}) {
    Series mark{.label = start ? "start" : "end",
                .style = {.colour = "#000000",
                          .marker = start ? Marker::circle : Marker::square,
                          .filled = !start,
                          .width = 0.7,
                          .size = 1.0},
                .x = {},
                .y = {},
                .layer = reference_layer};
    for (std::size_t p = 0; p < points; ++p) {
      const Series& curve = all[p];
      if (curve.x.empty()) continue;
      mark.x.push_back(start ? curve.x.front() : curve.x.back());
      mark.y.push_back(start ? curve.y.front() : curve.y.back());
    }
    mark.only_markers = true;
    mark_all(mark);
    all.push_back(std::move(mark));
  }
  const auto label = [&](std::size_t f) {
    return labelled(solution.meaning(static_cast<Index>(f)), solution.fields()[f]);
  };
  return {fmt::format("Phase portrait: {} over {}.", in_text(solution.fields()[b]), in_text(solution.fields()[a])) +
              corners,
          Plot{.stem = fmt::format("portrait_{}_{}", solution.fields()[a], solution.fields()[b]),
               .title = title_of(run, "phase portrait"),
               .x_label = label(a),
               .y_label = label(b),
               .x = x_axis,
               .y = y_axis,
               .series = std::move(all)}};
}

CurvePicture profiles(const RunFiles& run, const SolutionReader& solution, Index field) {
  const CoordinateAxis& axis = solution.axes().front();
  const std::string& name = solution.fields()[static_cast<std::size_t>(field)];
  const std::vector<Index> times = spread(solution.count(), 5);
  std::vector<Series> all;
  Vector values;
  for (std::size_t i = 0; i < times.size(); ++i) {
    solution.field(field, times[i], values);
    const bool end = i == 0 || i + 1 == times.size();
    const double s = times.size() > 1 ? static_cast<double>(i) / static_cast<double>(times.size() - 1) : 0.0;
    all.push_back(line(fmt::format("t = {:.4g}", solution.time(times[i])),
                       Curve{"", axis.values, {values.data(), values.data() + values.size()}},
                       {.colour = sequence_colour(s), .dash = Dash::solid, .width = end ? 1.4 : 0.8}));
    all.back().literal = at_time(solution.time(times[i]));
    if (axis.name == "point") {
      all.back().style.marker = Marker::circle;
      all.back().style.size = 0.7;
      if (axis.values.size() <= 40) mark_all(all.back());
    }
  }
  const Axis y = values_axis(all, false);
  return {fmt::format("{} at {} times, from the first (violet) to the last (green).", in_text(name), times.size()),
          Plot{.stem = "profiles_" + name,
               .title = title_of(run, in_text(name) + " at some times"),
               .x_label = axis_label(axis.name),
               .y_label = labelled(solution.meaning(field), name),
               .x = axis.values.size() > 1 ? axis_between(false, axis.values.front(), axis.values.back())
                                           : fitted_axis(false, axis.values),
               .y = y,
               .series = std::move(all)}};
}

}  // namespace

std::string title_of(const RunFiles& run, const std::string& what) {
  const std::string steps = run.spec.tolerance ? fmt::format("tolerance {:g}", *run.spec.tolerance)
                                               : fmt::format("h = {}", step_text(run.spec.h));
  return fmt::format("{}, {}, {}: {}", run_name(run), method_label(run.method), steps, what);
}

std::string cause_label(const EnergyHistory& history, const std::string& column) {
  static const std::array<std::pair<std::string, std::string>, 8> labels = {
      {{"work", "work of forces"},
       {"damping_left", "damping, half step before the Hamiltonian step"},
       {"substep", "dissipation of S"},
       {"scalar", "scalar equation"},
       {"auxiliary", "auxiliary variable"},
       {"projection", "projection"},
       {"damping_right", "damping, half step after the Hamiltonian step"},
       {"round_off", "round-off"}}};
  const auto second = std::find_if(history.causes.begin(), history.causes.end(),
                                   [](const Curve& cause) { return cause.name == "damping_right"; });
  if (column == "damping_left" && second != history.causes.end() && !(span_of(second->value) > 0)) return "damping";
  for (const auto& [name, label] : labels)
    if (name == column) return label;
  return column;
}

std::vector<CurvePicture> energy_curves(const RunFiles& run, const EnergyHistory& history) {
  std::vector<CurvePicture> all = {energy_picture(run, history)};
  if (!history.causes.empty() && !history.H.value.empty()) all.push_back(ledger_picture(run, history));
  return all;
}

std::vector<CurvePicture> solution_curves(const RunFiles& run, const SolutionReader& solution) {
  std::vector<CurvePicture> all;
  if (solution.count() == 0 || solution.axes().size() > 1) return all;
  if (solution.axes().empty() || (solution.on_points() && solution.points() <= few_points)) {
    const Histories values = histories(solution);
    all.push_back(fields_over_time(run, solution, values));
    // Each coordinate with its momentum, which stands half of the fields behind it; of an odd number neighbours.
    const std::size_t fields = solution.fields().size();
    const std::size_t apart = fields % 2 == 0 ? fields / 2 : 1;
    for (std::size_t f = 0; f + apart < fields; ++f) all.push_back(portrait(run, solution, values, f, f + apart));
  } else {
    for (std::size_t f = 0; f < solution.fields().size(); ++f)
      all.push_back(profiles(run, solution, static_cast<Index>(f)));
  }
  return all;
}

}  // namespace seiche
