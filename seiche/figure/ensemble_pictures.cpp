#include <seiche/config/case/case_file.hpp>
#include <seiche/config/case/run_spec.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/figure/curves.hpp>
#include <seiche/figure/ensemble_pictures.hpp>
#include <seiche/output/csv_table.hpp>
#include <seiche/output/text_table.hpp>
#include <seiche/study/member_counts.hpp>
#include <seiche/study/unfinished_run.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace seiche {
namespace {

namespace fs = std::filesystem;

// As formulas have it where it is a Greek letter.
std::string symbol(const std::string& parameter) {
  static const std::vector<std::string> greek = {"alpha", "beta", "gamma", "epsilon", "kappa", "mu", "nu", "sigma"};
  const bool is_greek = std::find(greek.begin(), greek.end(), parameter) != greek.end();
  if (parameter.size() == 1) return "$" + parameter + "$";
  return is_greek ? fmt::format("$\\{}$", parameter) : parameter;
}

Series line(const CsvTable& energy, const char* column, const char* label, Dash dash, double width,
            const std::string& colour) {
  const Curve curve = thinned({column, energy.column("t"), energy.column(column)});
  return {.label = label, .style = {.colour = colour, .dash = dash, .width = width}, .x = curve.t, .y = curve.value};
}

CurvePicture energy_picture(const CsvTable& energy, const std::string& titled, const std::string& colour) {
  std::vector<Series> series = {line(energy, "H_mean", "mean", Dash::solid, 1.2, colour),
                                line(energy, "H_q05", "90 % of members", Dash::dashed, 0.7, colour),
                                line(energy, "H_q95", "", Dash::dashed, 0.7, colour),
                                line(energy, "H_min", "all members", Dash::dotted, 0.7, colour),
                                line(energy, "H_max", "", Dash::dotted, 0.7, colour)};
  const bool falls = falls_by_decades({{"reference", series[1].x, series[1].y}});
  return {.stem = "energy",
          .title = fmt::format("{}: energy of {:g} members", titled, energy.column("members").front()),
          .caption = "",
          .x = {.label = "time $t$"},
          .y = {.label = "energy $H$", .logarithmic = falls},
          .series = std::move(series)};
}

struct MemberEnergy {
  double parameter, before, after;
};

// Of members that did not fail, so many that an eye tells them apart.
std::vector<MemberEnergy> member_energies(const TextTable& members, const std::string& parameter) {
  constexpr std::size_t most = 400;
  const std::size_t every = (members.rows() + most - 1) / most;
  std::vector<MemberEnergy> all;
  for (std::size_t m = 0; m < members.rows(); m += std::max<std::size_t>(every, 1)) {
    const MemberEnergy one{members.number(m, parameter), members.number(m, "H_initial"), members.number(m, "H_final")};
    if (members.text(m, "status") != "failed" && std::isfinite(one.before) && std::isfinite(one.after))
      all.push_back(one);
  }
  return all;
}

// Nothing where no member is left to show.
std::optional<CurvePicture> parameter_picture(const TextTable& members, const std::string& parameter,
                                              const std::string& titled, const std::string& colour) {
  const std::vector<MemberEnergy> energies = member_energies(members, parameter);
  if (energies.empty()) return {};
  const bool is_share = std::all_of(energies.begin(), energies.end(), [](const auto& one) { return one.before > 0; });
  Series series{.label = "",
                .style = {.colour = colour, .marker = Marker::circle, .filled = false, .width = 0},
                .x = {},
                .y = {}};
  for (const MemberEnergy& one : energies) {
    series.x.push_back(one.parameter);
    series.y.push_back(is_share ? one.after / one.before : one.after - one.before);
  }
  const auto [low, high] = std::minmax_element(series.x.begin(), series.x.end());
  const double margin = *high > *low ? 0.04 * (*high - *low) : std::max(0.04 * std::abs(*low), 1e-3);
  return CurvePicture{.stem = "members_" + parameter,
                      .title = fmt::format("{}: {}", titled,
                                           is_share ? "energy that is left at the end" : "change of the energy"),
                      .caption = "",
                      .x = {.label = symbol(parameter), .limits = std::pair(*low - margin, *high + margin)},
                      .y = {.label =
                                is_share ? "$H$ at the end / $H$ at the start" : "$H$ at the end − $H$ at the start"},
                      .series = {std::move(series)}};
}

// "2 of 5 members failed, 1 of 5 interrupted, the energy law of 2 is violated"
std::string shortfall(const TextTable& members) {
  MemberCounts counts = count_members(members);
  std::vector<std::string> parts;
  for (const char* word : {"failed", "interrupted"})
    if (const std::int64_t found = counts.statuses[word]; found > 0)
      parts.push_back(fmt::format("{} of {} members {}", found, members.rows(), word));
  if (const std::int64_t found = counts.laws["violated"]; found > 0)
    parts.push_back(fmt::format("the energy law of {} is violated", found));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

bool holds_ensemble(const fs::path& directory) {
  return fs::is_regular_file(directory / "case.toml") && read_case(directory / "case.toml").ensemble.has_value();
}

EnsemblePictures ensemble_pictures(const fs::path& directory) {
  require_own_figures(directory);
  const std::optional<UnfinishedRun> unfinished = unfinished_run(directory);
  const RunSpec spec = unfinished ? unfinished->spec : read_case(directory / "case.toml");
  if (!unfinished && !fs::is_regular_file(directory / "energy.csv"))
    throw Error("{} is no directory of a finished ensemble: it has no energy.csv", directory.string());
  const std::string name = run_name(problem_entry(spec).title, spec.problem, directory);
  const std::string titled = run_title(name, spec.method, spec);
  const std::string colour = method_line(spec.method).colour;
  const CsvTable energies = unfinished ? CsvTable::read(unfinished->energies, unfinished->saved.energies.file.length)
                                       : CsvTable::read(directory / "energy.csv");
  EnsemblePictures pictures{.list = {energy_picture(energies, titled, colour)}, .warning = ""};
  if (unfinished) {
    pictures.warning = unfinished->how_far();
    pictures.has_ended = false;
    pictures.is_running = unfinished->is_running;
    return pictures;
  }
  const TextTable members(directory / "members.csv");
  pictures.warning = shortfall(members);
  for (const auto& [parameter, range] : spec.ensemble->parameters)
    if (auto picture = parameter_picture(members, parameter, titled, colour))
      pictures.list.push_back(std::move(*picture));
  return pictures;
}

void draw_ensemble(EnsemblePictures& pictures, const fs::path& directory, const PictureOptions& options) {
  const CurveFiles files{.formats = with_png(options.formats),
                         .dark = true,
                         .width = options.width,
                         .journal = options.journal,
                         .warning = pictures.warning,
                         .when_drawn = [&] { remove_pictures(directory); }};
  draw_curves(pictures.list, directory / "figures", files);
}

}  // namespace seiche
