#include <seiche/config/case/case_file.hpp>
#include <seiche/config/case/run_spec.hpp>
#include <seiche/core/error.hpp>
#include <seiche/figure/curve_picture.hpp>
#include <seiche/figure/curves.hpp>
#include <seiche/figure/ensemble_pictures.hpp>
#include <seiche/output/csv_table.hpp>
#include <seiche/output/text_table.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seiche {
namespace {

namespace fs = std::filesystem;

std::string titled(const RunSpec& spec, const std::string& what) {
  const std::string& title = problem_entry(spec).title;
  return fmt::format("{}, {}, h = {}: {}", title.empty() ? spec.problem : title, method_label(spec.method),
                     step_text(spec.h), what);
}

CurvePicture energy_picture(const RunSpec& spec, const CsvTable& energy) {
  const std::vector<double> t = energy.column("t");
  const auto members = static_cast<std::int64_t>(energy.column("members").front());
  const std::string colour = method_line(spec.method).colour;
  const auto line = [&](const char* column, const char* label, Dash dash, double width) {
    const Curve curve = thinned({column, t, energy.column(column)});
    return Series{.label = label,
                  .style = {.colour = colour, .dash = dash, .width = width},
                  .x = curve.t,
                  .y = curve.value};
  };
  std::vector<Series> series = {line("H_mean", "mean", Dash::solid, 1.2),
                                line("H_q05", "90 % of members", Dash::dashed, 0.7),
                                line("H_q95", "", Dash::dashed, 0.7), line("H_min", "all members", Dash::dotted, 0.7),
                                line("H_max", "", Dash::dotted, 0.7)};
  return {.stem = "energy",
          .title = titled(spec, fmt::format("energy of {} members", members)),
          .caption = "",
          .x = {.label = "time $t$"},
          .y = {.label = "energy $H$", .logarithmic = falls_by_decades({{"reference", series[0].x, series[0].y}})},
          .series = std::move(series)};
}

CurvePicture parameter_picture(const RunSpec& spec, const TextTable& members, const std::string& parameter) {
  constexpr std::size_t most = 400;  // points that an eye tells apart
  Series series{
      .label = "",
      .style = {.colour = method_line(spec.method).colour, .marker = Marker::circle, .filled = false, .width = 0},
      .x = {},
      .y = {}};
  const std::size_t every = std::max<std::size_t>(1, members.rows() / most);
  for (std::size_t m = 0; m < members.rows(); m += every) {
    const double before = members.number(m, "H_initial"), after = members.number(m, "H_final");
    if (members.text(m, "status") != "success" || !(before > 0) || !std::isfinite(after)) continue;
    series.x.push_back(members.number(m, parameter));
    series.y.push_back(after / before);
  }
  return {.stem = "members_" + parameter,
          .title = titled(spec, "energy that is left at t = " + fmt::format("{:g}", spec.t_end)),
          .caption = "",
          .x = {.label = parameter},
          .y = {.label = "$H$ at the end / $H$ at the start"},
          .series = {std::move(series)}};
}

}  // namespace

bool holds_ensemble(const fs::path& directory) {
  return fs::is_regular_file(directory / "case.toml") && read_case(directory / "case.toml").ensemble.has_value();
}

std::size_t draw_ensemble(const fs::path& directory, const PictureOptions& options) {
  require_own_figures(directory);
  const RunSpec spec = read_case(directory / "case.toml");
  const TextTable members(directory / "members.csv");
  std::vector<CurvePicture> pictures = {energy_picture(spec, CsvTable::read(directory / "energy.csv"))};
  for (const auto& [parameter, range] : spec.ensemble->parameters)
    pictures.push_back(parameter_picture(spec, members, parameter));
  CurveFiles files{.formats = options.formats, .dark = true, .width = options.width, .journal = options.journal};
  if (std::find(files.formats.begin(), files.formats.end(), "png") == files.formats.end())
    files.formats.insert(files.formats.begin(), "png");
  remove_pictures(directory);
  draw_curves(pictures, directory / "figures", files);
  return pictures.size();
}

}  // namespace seiche
