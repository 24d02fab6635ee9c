#include <bench/work_precision/figures.hpp>
#include <seiche/figure/curve_picture.hpp>
#include <seiche/output/file/atomic_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace seiche::bench {
namespace {

struct PeerStyle {
  std::string_view name;
  LineStyle line;
};

LineStyle style_of(const Curve& curve, int index) {
  using enum Marker;
  using enum Dash;
  if (curve.origin == Origin::seiche) {
    LineStyle line = method_line(curve.peer.substr(0, curve.peer.find(' ')));
    line.width = std::max(line.width, 1.3);
    if (curve.rows.front()->sweep == Sweep::tolerance) line.dash = dash_dotted;
    if (curve.peer.ends_with(" explicit")) line.filled = false;
    return line;
  }
  // Hand-written dashed, packaged dotted; Seiche alone has heavy solid lines.
  // clang-format off
  static const std::vector<PeerStyle> styles = {
      {"ETDRK4",                {"#000000", circle,        false, dashed, 0.8}},
      {"Strang exact flow",     {"#6A4C93", triangle,      false, dashed, 0.8}},
      {"RKN4 kicks",            {"#4D9221", square,        false, dashed, 0.8}},
      {"RKN6 kicks",            {"#276419", diamond,       false, dashed, 0.8}},
      {"projected Strang exact flow", {"#6A4C93", triangle, true, dashed, 0.8}},
      {"projected RKN4 kicks",  {"#4D9221", square,        true,  dashed, 0.8}},
      {"projected RKN6 kicks",  {"#276419", diamond,       true,  dashed, 0.8}},
      {"RKN4 exact flow",       {"#C51B7D", square,        true,  dashed, 0.8}},
      {"RKN6 exact flow",       {"#8E0152", diamond,       true,  dashed, 0.8}},
      {"odeint dopri5",         {"#8C8C8C", circle,        true,  dotted, 0.8}},
      {"odeint Fehlberg78",     {"#8C8C8C", square,        true,  dotted, 0.8}},
      {"odeint Bulirsch–Stoer", {"#8C8C8C", triangle,      true,  dotted, 0.8}},
      {"GSL rk8pd",             {"#5B7FA6", pentagon,      true,  dotted, 0.8}},
      {"CVODE Adams",           {"#B08D57", circle,        true,  dotted, 0.8}},
      {"CVODE BDF",             {"#B08D57", square,        true,  dotted, 0.8}},
      {"ARKODE ERK",            {"#B08D57", triangle,      true,  dotted, 0.8}},
      {"ARKODE ImEx",           {"#B08D57", triangle_down, true,  dotted, 0.8}},
  };
  // clang-format on
  const auto found =
      std::find_if(styles.begin(), styles.end(), [&](const PeerStyle& s) { return s.name == curve.peer; });
  return found != styles.end() ? found->line : curve_line("", 0, index);
}

std::set<std::string> shown_methods(const std::vector<Curve>& curves) {
  std::set<std::string> shown = {"seisav", "seilm"};
  for (const double error : wanted_errors) {
    const Curve* best = nullptr;
    for (const Curve& curve : curves) {
      if (curve.origin != Origin::seiche || std::isnan(seconds_to_reach(curve, error))) continue;
      if (!best || seconds_to_reach(curve, error) < seconds_to_reach(*best, error)) best = &curve;
    }
    if (best) shown.insert(best->peer);
  }
  return shown;
}

// Values below `smallest` mean no more than it, and are drawn there.
CurvePicture picture_of(const ProblemResult& result, const Panel& panel, double Row::*value, const std::string& label,
                        double smallest) {
  CurvePicture picture{.stem = panel.stem,
                       .title = panel.title,
                       .caption = panel.caption,
                       .x = {.label = "CPU time (s)", .logarithmic = true},
                       .y = {.label = label, .logarithmic = true},
                       .series = {}};
  const std::vector<Curve> curves = curves_of(result);
  const std::set<std::string> methods = shown_methods(curves);
  constexpr double senseless = 30;  // a run that lost the solution would only squeeze the others together
  int index = 0;
  for (const Curve& curve : curves) {
    if (curve.origin == Origin::seiche && !methods.contains(curve.peer)) continue;
    Series series{.label = curve.origin == Origin::seiche ? method_label(curve.peer) : curve.peer,
                  .style = style_of(curve, index++),
                  .x = {},
                  .y = {},
                  .layer = curve.origin == Origin::seiche ? proposed_layer : 0};
    for (const Row* row : curve.rows) {
      if (row->status != Status::solved || !(row->*value < senseless)) continue;
      series.x.push_back(row->cpu_seconds);
      series.y.push_back(std::max(row->*value, smallest));
    }
    if (series.x.empty()) continue;
    picture.series.push_back(std::move(series));
  }
  return picture;
}

}  // namespace

std::vector<Panel> panels_of(const ProblemResult& result) {
  const std::string& key = result.test.key;
  return {{key + "_error", key + ": error at T",
           "Maximum-norm error at T against CPU time. Solid: Seiche; dashed: hand-written; dotted: packaged."},
          {key + "_energy", key + ": energy error at T", "|H − H_ref| at T against CPU time."}};
}

void draw_figures(const std::vector<ProblemResult>& results, const std::filesystem::path& directory) {
  const std::filesystem::path figures = directory / "figures";
  make_directory(figures);
  constexpr double smallest_energy_error = 1e-16;
  std::vector<CurvePicture> pictures;
  for (const ProblemResult& result : results) {
    const std::vector<Panel> panels = panels_of(result);
    for (const Panel& panel : panels) {
      for (const char* suffix : {".png", ".pdf"}) {
        std::error_code ignored;  // a picture of an earlier run must not stand beside new numbers
        std::filesystem::remove(figures / (panel.stem + suffix), ignored);
      }
    }
    pictures.push_back(picture_of(result, panels[0], &Row::error, "error", result.reference_difference));
    pictures.push_back(picture_of(result, panels[1], &Row::energy_error, "energy error", smallest_energy_error));
  }
  draw_curves(pictures, figures);
}

}  // namespace seiche::bench
