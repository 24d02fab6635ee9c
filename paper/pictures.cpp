#include <paper/pictures.hpp>
#include <seiche/core/error.hpp>
#include <seiche/figure/drawing_folder.hpp>
#include <seiche/figure/gnuplot.hpp>
#include <seiche/figure/plot/coincide.hpp>
#include <seiche/figure/plot/curves.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace seiche {
namespace {

constexpr const char* step_label = "'time step {/:Italic h}'";
constexpr const char* error_label = "'maximal error'";
constexpr const char* cpu_label = "'CPU time (s)'";
constexpr const char* time_label = "'{/:Italic t}'";
constexpr const char* energy_label = "'{/:Italic H}'";
constexpr const char* energy_error_label = "'energy error'";

// "Example 2.1" of "Example 2.1: damped α-FPU equation, …".
std::string short_title(const std::string& title) {
  std::string text = title.substr(0, title.find_first_of(":,"));
  if (text.size() > 40) text.resize(text.find_last_of(' ', 40));
  return text;
}

std::string picture_title(const std::string& what, const std::string& which, bool quick) {
  return what + ": " + which + (quick ? " (quick run)" : "");
}

int layer_of(const std::string& method) {
  const MethodStyle* style = find_method_style(method);
  return style && style->proposed ? proposed_layer : 0;
}

// One series per method, from the runs that reached the end.
std::vector<Series> series_of_rows(const ExampleResult& example, double (*x)(const StudyRow&)) {
  std::vector<Series> all;
  for (const std::string& method : example.methods) {
    Series series{
        .label = method_label(method), .style = method_line(method), .x = {}, .y = {}, .layer = layer_of(method)};
    for (const StudyRow& row : example.rows) {
      if (row.method != method || !row.failure.empty()) continue;
      series.x.push_back(x(row));
      series.y.push_back(row.error);
    }
    mark_all(series);
    all.push_back(std::move(series));
  }
  return all;
}

std::vector<double> all_values(const std::vector<Series>& all, std::vector<double> Series::*member) {
  std::vector<double> values;
  for (const Series& series : all) values.insert(values.end(), (series.*member).begin(), (series.*member).end());
  return values;
}

// One series per curve; the markers of different curves sit at different times, since the curves often coincide.
std::vector<Series> series_of_curves(const std::vector<Curve>& curves) {
  std::vector<Series> all;
  const auto methods = static_cast<int>(
      std::count_if(curves.begin(), curves.end(), [](const Curve& c) { return c.name != "reference"; }));
  int index = 0;
  for (const Curve& curve : curves) {
    const Curve thin = thinned(curve);
    Series series{.label = method_label(curve.name), .style = method_line(curve.name), .x = thin.t, .y = thin.value};
    if (curve.name == "reference") {
      series.style = reference_line();
      series.layer = reference_layer;
    } else {
      series.marked = staggered(thin.t, index++, methods);
      series.layer = layer_of(curve.name);
    }
    all.push_back(std::move(series));
  }
  return all;
}

// Without the series that have no point to show, which would only fill the legend; coinciding ones told apart and
// named.
CurvePicture finished(std::string caption, Plot plot) {
  std::erase_if(plot.series, [&](const Series& series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (plot.x.shows(series.x[i]) && plot.y.shows(series.y[i])) return false;
    }
    return true;
  });
  const auto groups = coinciding_series(plot);
  for (const std::string& sentence : {coincidence_sentence(plot, groups), separate(plot, groups)}) {
    if (!sentence.empty()) caption += " " + sentence;
  }
  return {std::move(caption), std::move(plot)};
}

// The words of a study's axis as the main figures set them.
std::string axis_label(const std::string& words) {
  if (words == "time step h") return step_label;
  if (words == "t") return time_label;
  return gnuplot_text(words);
}

Axis time_axis(const ExampleResult& example) { return axis_between(false, 0, example.t_end > 0 ? example.t_end : 1); }

CurvePicture order_picture(const ExampleResult& example, bool quick) {
  std::vector<Series> series = series_of_rows(example, [](const StudyRow& row) { return row.h; });
  const Axis y = fitted_axis(true, all_values(series, &Series::y), 0.1);
  return finished(fmt::format("Largest error up to T = {:g} against the time step. The triangle has slope 2.",
                              example.t_end),
                  Plot{.stem = example.key + "_order",
                       .title = picture_title(short_title(example.title), "order", quick),
                       .x_label = step_label,
                       .y_label = error_label,
                       .x = step_size_axis(example.step_sizes),
                       .y = y,
                       .series = std::move(series),
                       .slope_two = true});
}

CurvePicture efficiency_picture(const ExampleResult& example, bool quick) {
  std::vector<Series> series = series_of_rows(example, [](const StudyRow& row) { return row.cpu_seconds; });
  const Axis x = fitted_axis(true, all_values(series, &Series::x), 0.08);
  const Axis y = fitted_axis(true, all_values(series, &Series::y), 0.1);
  return finished("Largest error against the CPU time of the run. Further left and further down is better.",
                  Plot{.stem = example.key + "_efficiency",
                       .title = picture_title(short_title(example.title), "efficiency", quick),
                       .x_label = cpu_label,
                       .y_label = error_label,
                       .x = x,
                       .y = y,
                       .series = std::move(series)});
}

CurvePicture energy_picture(const ExampleResult& example, bool quick) {
  std::vector<Series> series = series_of_curves(example.energy);
  const Axis y = fitted_axis(falls_by_decades(example.energy), all_values(series, &Series::y));
  return finished(
      fmt::format("Energy H(zⁿ) at h = {}, and the reference as a thin black line. Each method has its markers at "
                  "times of its own.",
                  step_text(example.curve_h)),
      Plot{.stem = example.key + "_energy",
           .title = picture_title(short_title(example.title), "energy", quick),
           .x_label = time_label,
           .y_label = energy_label,
           .x = time_axis(example),
           .y = y,
           .series = std::move(series)});
}

CurvePicture energy_error_picture(const ExampleResult& example, bool quick) {
  std::vector<Curve> envelopes;
  for (const Curve& curve : example.energy_errors) envelopes.push_back(upper_envelope(curve));
  std::vector<Series> series = series_of_curves(envelopes);
  const Axis y = fitted_axis(true, all_values(series, &Series::y));
  return finished(
      fmt::format("|H(zⁿ) − H(z(tₙ))| at h = {}: the largest value in each of {} stretches of time, because the error "
                  "passes through zero again and again.",
                  step_text(example.curve_h), envelope_stretches),
      Plot{.stem = example.key + "_energy_error",
           .title = picture_title(short_title(example.title), "energy error", quick),
           .x_label = time_label,
           .y_label = energy_error_label,
           .x = time_axis(example),
           .y = y,
           .series = std::move(series)});
}

// A linear one that nearly begins at zero begins there.
Axis abscissa_axis(bool logarithmic, const std::vector<double>& x) {
  const Axis tight = fitted_axis(logarithmic, x, logarithmic ? 0.06 : 0);
  const bool from_zero = !logarithmic && !tight.empty && tight.low > 0 && tight.low < 0.05 * tight.high;
  return from_zero ? axis_from_zero(tight.high) : tight;
}

// Moves zeros, which a logarithmic axis cannot show, to a line of their own; false without zeros.
bool draw_zeros(std::vector<Series>& all, Axis& y) {
  const AxisWithZero extended = with_zero_line(y);
  bool any = false;
  for (Series& series : all) {
    for (double& value : series.y) {
      if (value != 0) continue;
      value = extended.zero;
      any = true;
    }
  }
  if (any) y = extended.axis;
  return any;
}

const ExampleResult* find_example(const PaperResults& results, const std::string& key) {
  for (const ExampleResult& example : results.examples) {
    if (example.key == key) return &example;
  }
  return nullptr;
}

}  // namespace

std::vector<CurvePicture> example_pictures(const ExampleResult& example, bool quick) {
  std::vector<CurvePicture> pictures;
  pictures.push_back(order_picture(example, quick));
  pictures.push_back(efficiency_picture(example, quick));
  pictures.push_back(energy_picture(example, quick));
  pictures.push_back(energy_error_picture(example, quick));
  std::size_t room = 0;
  for (const CurvePicture& picture : pictures) room = std::max(room, picture.plot.series.size());
  for (CurvePicture& picture : pictures) picture.plot.legend_room = room;
  return pictures;
}

std::optional<CurvePicture> formulations_picture(const PaperResults& results) {
  const ExampleResult* conservative = find_example(results, "alpha_fpu_conservative");
  const ExampleResult* dissipative = find_example(results, "alpha_fpu_dissipative");
  if (!conservative || !dissipative) return {};
  const auto cpu = [](const StudyRow& row) { return row.cpu_seconds; };
  const std::array<std::string, 4> compared = {"SAVF", "SEAVF", "SEISAV", "SEILM"};
  std::vector<Series> all;
  const auto add = [&](const ExampleResult& example, bool first) {
    for (Series& series : series_of_rows(example, cpu)) {
      if (std::find(compared.begin(), compared.end(), series.label) == compared.end()) continue;
      if (first) {
        series.label.clear();
        series.style.dash = Dash::dotted;
        series.style.width = 1.0;
        series.style.size *= 0.7;
      }
      all.push_back(std::move(series));
    }
  };
  add(*dissipative, false);
  add(*conservative, true);
  const std::string grey = "#505050";
  all.push_back(
      {.label = "Example 2.1", .style = {.colour = grey, .dash = Dash::dotted, .width = 1.0}, .x = {}, .y = {}});
  all.push_back({.label = "Example 2.2", .style = {.colour = grey}, .x = {}, .y = {}});

  const Axis x = fitted_axis(true, all_values(all, &Series::x), 0.08);
  const Axis y = fitted_axis(true, all_values(all, &Series::y), 0.1);
  return CurvePicture{
      "Four splitting schemes under both formulations: Example 2.1 dotted with small markers, Example 2.2 as in "
      "the other figures.",
      Plot{.stem = "alpha_fpu_formulations_efficiency",
           .title = picture_title("Examples 2.1 and 2.2", "efficiency", results.quick),
           .x_label = cpu_label,
           .y_label = error_label,
           .x = x,
           .y = y,
           .series = std::move(all)}};
}

CurvePicture side_picture(const SideStudy& study, bool quick) {
  std::vector<Series> all;
  std::map<std::string_view, int> left;
  for (const Curve& curve : study.curves) ++left[method_of_curve(curve.name)];
  const auto count = static_cast<int>(study.curves.size());
  for (int i = 0; i < count; ++i) {
    const Curve curve = thinned(study.curves[static_cast<std::size_t>(i)]);
    const std::string_view method = method_of_curve(curve.name);
    // The last curve of a method is the one as built here; what comes before is compared with it.
    Series series{.label = curve.name,
                  .style = curve_line(curve.name, --left[method], i),
                  .x = curve.t,
                  .y = curve.value};
    if (curve.name.starts_with(method)) series.label.replace(0, method.size(), method_label(method));
    constexpr std::size_t few = 24;
    if (curve.t.size() <= few) {
      mark_all(series);
    } else {
      series.marked = staggered(curve.t, i, count);
      series.style.width = 0.8;  // a wiggling heavy line is a blot
    }
    all.push_back(std::move(series));
  }
  const std::vector<double> x = all_values(all, &Series::x);
  const bool halved = study.log_x && all_powers_of_two(x);
  Axis y_axis = fitted_axis(study.log_y, all_values(all, &Series::y), 0.1);
  std::string caption = study.explanation;
  if (study.log_y && !y_axis.empty && draw_zeros(all, y_axis)) {
    caption += " What is exactly zero stands on the line 0 at the bottom, below the logarithmic axis.";
  }
  return finished(std::move(caption),
                  Plot{.stem = study.key,
                       .title = study.title + (quick ? " (quick run)" : ""),
                       .x_label = axis_label(study.x_label),
                       .y_label = axis_label(study.y_label),
                       .x = halved ? step_size_axis(x) : abscissa_axis(study.log_x, x),
                       .y = y_axis,
                       .series = std::move(all),
                       // Other quantities have no order to compare with.
                       .slope_two = halved && study.log_y && study.y_label.find("error") != std::string::npos});
}

std::vector<CurvePicture> paper_pictures(const PaperResults& results) {
  std::vector<CurvePicture> all;
  for (const ExampleResult& example : results.examples) {
    for (CurvePicture& picture : example_pictures(example, results.quick)) all.push_back(std::move(picture));
  }
  if (auto picture = formulations_picture(results)) all.push_back(std::move(*picture));
  for (const SideStudy& study : results.side_studies) all.push_back(side_picture(study, results.quick));
  return all;
}

void draw_paper(const PaperResults& results, const std::filesystem::path& directory) {
  const std::filesystem::path figures = directory / "figures";
  DrawingFolder drawing(figures);
  // Two processes: starting gnuplot once per picture would take longer than drawing.
  std::vector<std::string> scripts(2);
  std::size_t next = 0;
  for (const CurvePicture& picture : paper_pictures(results)) {
    const std::string& stem = picture.plot.stem;
    if (stem.empty() || stem.find('/') != std::string::npos || stem.find('\n') != std::string::npos) {
      throw Error("'{}' cannot be the name of a figure file", stem);
    }
    for (const char* suffix : {".png", ".pdf"}) {
      std::error_code ignored;
      std::filesystem::remove(figures / (stem + suffix), ignored);
    }
    scripts[next++ % scripts.size()] += plot_script(picture.plot);
  }
  std::erase(scripts, std::string());
  run_gnuplot(scripts, drawing.path());
  drawing.commit();
}

}  // namespace seiche
