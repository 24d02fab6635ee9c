#include <paper/pictures.hpp>
#include <seiche/figure/curves.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace seiche {
namespace {

constexpr const char* step_label = "time step $h$";
constexpr const char* error_label = R"($\max_n\,\Vert z^n - z(t_n)\Vert_\infty$)";
constexpr const char* cpu_label = "CPU time (s)";
constexpr const char* time_label = "time $t$";
constexpr const char* energy_label = "energy $H$";
constexpr const char* energy_error_label = "$|H(z^n) - H(z(t_n))|$";

// "Example 2.1" of "Example 2.1: damped α-FPU equation, …".
std::string short_title(const std::string& title) {
  std::string text = title.substr(0, title.find_first_of(":,"));
  if (text.size() > 40) text.resize(text.find_last_of(' ', 40));
  return text;
}

std::string picture_title(const std::string& what, const std::string& which, bool quick) {
  return what + ": " + which + (quick ? " (quick run)" : "");
}

// Where the paper has it: "Figure 1, left"; "" for what it has not.
std::string figure_of_paper(const std::string& stem) {
  static const std::map<std::string_view, std::string_view> figures = {
      {"klein_gordon_order", "Figure 1, left"},
      {"klein_gordon_efficiency", "Figure 1, right"},
      {"klein_gordon_energy", "Figure 2, left"},
      {"klein_gordon_energy_error", "Figure 2, right"},
      {"alpha_fpu_conservative_order", "Figure 3, left"},
      {"alpha_fpu_conservative_efficiency", "Figure 3, right"},
      {"alpha_fpu_conservative_energy", "Figure 4, left"},
      {"alpha_fpu_conservative_energy_error", "Figure 4, right"},
      {"alpha_fpu_dissipative_energy", "Figure 5, left"},
      {"alpha_fpu_formulations_efficiency", "Figure 5, right"},
      {"gkdv_order", "Figure 6, left"},
      {"gkdv_efficiency", "Figure 6, right"},
      {"gkdv_energy", "Figure 7, left"},
      {"gkdv_energy_error", "Figure 7, right"}};
  const auto found = figures.find(stem);
  return found == figures.end() ? "" : std::string(found->second);
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
    all.push_back(std::move(series));
  }
  return all;
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

// The words of a study's axis as the main figures set them. A sign of Matplotlib's is one of the text.
std::string axis_label(const std::string& words) {
  if (words == "time step h") return step_label;
  if (words == "t") return time_label;
  if (words == "maximal error") return error_label;
  if (words == "maximal energy error") return R"($\max_n\,|H(z^n) - H(z(t_n))|$)";
  std::string text;
  for (const char c : words) text += c == '$' ? std::string("\\$") : std::string(1, c);
  return text;
}

bool all_powers_of_two(const std::vector<double>& values) {
  return !values.empty() && std::all_of(values.begin(), values.end(), [](double h) {
    int exponent = 0;
    return h > 0 && std::frexp(h, &exponent) == 0.5;
  });
}

PictureAxis time_axis(const ExampleResult& example) {
  return {.label = time_label, .limits = std::pair(0.0, example.t_end > 0 ? example.t_end : 1)};
}

CurvePicture picture_of(const ExampleResult& example, const std::string& what, bool quick, std::string caption,
                        PictureAxis x, PictureAxis y, std::vector<Series> series) {
  std::string stem = example.key + "_" + what, words = what;
  std::replace(words.begin(), words.end(), '_', ' ');
  const std::string number = figure_of_paper(stem);
  return {.stem = std::move(stem),
          .title = picture_title(short_title(example.title), words, quick),
          .caption = std::move(caption),
          .number = number,
          .x = std::move(x),
          .y = std::move(y),
          .series = std::move(series),
          .slope_two = what == "order"};
}

CurvePicture order_picture(const ExampleResult& example, bool quick) {
  return picture_of(example, "order", quick,
                    fmt::format("Largest error up to T = {:g} against the time step; the dotted line has slope 2.",
                                example.t_end),
                    {.label = step_label, .logarithmic = true, .powers_of_two = true},
                    {.label = error_label, .logarithmic = true},
                    series_of_rows(example, [](const StudyRow& row) { return row.h; }));
}

CurvePicture efficiency_picture(const ExampleResult& example, bool quick) {
  return picture_of(example, "efficiency", quick,
                    "Largest error against the CPU time of the run. Further left and further down is better.",
                    {.label = cpu_label, .logarithmic = true}, {.label = error_label, .logarithmic = true},
                    series_of_rows(example, [](const StudyRow& row) { return row.cpu_seconds; }));
}

CurvePicture energy_picture(const ExampleResult& example, bool quick) {
  return picture_of(
      example, "energy", quick,
      fmt::format("Energy H(zⁿ) at h = {}, and the reference as a thin black line. Each method has its markers at "
                  "times of its own.",
                  step_text(example.curve_h)),
      time_axis(example), {.label = energy_label, .logarithmic = falls_by_decades(example.energy)},
      series_of_curves(example.energy));
}

CurvePicture energy_error_picture(const ExampleResult& example, bool quick) {
  std::vector<Curve> envelopes;
  for (const Curve& curve : example.energy_errors) envelopes.push_back(upper_envelope(curve));
  return picture_of(
      example, "energy_error", quick,
      fmt::format("|H(zⁿ) − H(z(tₙ))| at h = {}: the largest value in each of {} stretches of time, because the error "
                  "passes through zero again and again.",
                  step_text(example.curve_h), envelope_stretches),
      time_axis(example), {.label = energy_error_label, .logarithmic = true}, series_of_curves(envelopes));
}

const ExampleResult* find_example(const PaperResults& results, const std::string& key) {
  for (const ExampleResult& example : results.examples) {
    if (example.key == key) return &example;
  }
  return nullptr;
}

}  // namespace

std::vector<CurvePicture> example_pictures(const ExampleResult& example, bool quick) {
  return {order_picture(example, quick), efficiency_picture(example, quick), energy_picture(example, quick),
          energy_error_picture(example, quick)};
}

std::optional<CurvePicture> formulations_picture(const PaperResults& results) {
  const ExampleResult* conservative = find_example(results, "alpha_fpu_conservative");
  const ExampleResult* dissipative = find_example(results, "alpha_fpu_dissipative");
  if (!conservative || !dissipative) return {};
  constexpr const char* formulations = "alpha_fpu_formulations_efficiency";
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

  return CurvePicture{.stem = formulations,
                      .title = picture_title("Examples 2.1 and 2.2", "efficiency", results.quick),
                      .caption =
                          "Four splitting schemes under both formulations: Example 2.1 dotted, Example 2.2 as in "
                          "the other figures.",
                      .number = figure_of_paper(formulations),
                      .x = {.label = cpu_label, .logarithmic = true},
                      .y = {.label = error_label, .logarithmic = true},
                      .series = std::move(all)};
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
    if (curve.t.size() > few) {
      series.marked = staggered(curve.t, i, count);
      series.style.width = 0.8;  // a wiggling heavy line is a blot
    }
    all.push_back(std::move(series));
  }
  std::vector<double> x;
  for (const Series& series : all) x.insert(x.end(), series.x.begin(), series.x.end());
  const bool halved = study.log_x && all_powers_of_two(x);
  return {.stem = study.key,
          .title = study.title + (quick ? " (quick run)" : ""),
          .caption = study.explanation,
          .x = {.label = axis_label(study.x_label), .logarithmic = study.log_x, .powers_of_two = halved},
          .y = {.label = axis_label(study.y_label), .logarithmic = study.log_y},
          .series = std::move(all),
          // Other quantities have no order to compare with.
          .slope_two = halved && study.log_y && study.y_label.find("error") != std::string::npos};
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

std::vector<CurvePicture> draw_paper(const PaperResults& results, const std::filesystem::path& directory) {
  std::vector<CurvePicture> pictures = paper_pictures(results);
  const std::filesystem::path figures = directory / "figures";
  for (const CurvePicture& picture : pictures) {
    for (const char* suffix : {".png", "_dark.png", ".pdf"}) {
      std::error_code ignored;
      std::filesystem::remove(figures / (picture.stem + suffix), ignored);
    }
  }
  const std::vector<std::string> formats = results.quick ? std::vector<std::string>{"png"} : CurveFiles{}.formats;
  draw_curves(pictures, figures, {.formats = formats, .dark = true});
  return pictures;
}

}  // namespace seiche
