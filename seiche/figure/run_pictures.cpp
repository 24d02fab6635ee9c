#include <seiche/core/error.hpp>
#include <seiche/figure/bars_picture.hpp>
#include <seiche/figure/drawing_folder.hpp>
#include <seiche/figure/gnuplot.hpp>
#include <seiche/figure/run_curves.hpp>
#include <seiche/figure/run_maps.hpp>
#include <seiche/figure/run_pictures.hpp>

#include <algorithm>
#include <string_view>

namespace seiche {
namespace fs = std::filesystem;

namespace {

void take_off(std::string& name, std::string_view end) {
  if (name.ends_with(end)) name.resize(name.size() - end.size());
}

bool is_one_of(const std::vector<std::string>& all, std::string_view one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

bool begins_with_one_of(std::string_view name, const std::vector<std::string>& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(), [&](const std::string& beginning) {
    return name.size() > beginning.size() && name.starts_with(beginning);
  });
}

// By their names: those of energy_curves, bars_picture, solution_maps, solution_curves and draw_film.
bool is_picture(const fs::path& file) {
  const std::string extension = file.extension().string();
  std::string stem = file.stem().string();
  take_off(stem, dark_theme().suffix);
  if (extension == ".mp4" || extension == ".webm") return begins_with_one_of(stem, {"film_"});
  if (extension.empty() || !is_one_of(picture_formats(), extension.substr(1))) return false;
  return is_one_of({"energy", "ledger", "bars", "fields"}, stem) ||
         begins_with_one_of(stem, {"portrait_", "profiles_", "space_time_", "slices_", "planes_"});
}

// u_0001.png and u_0001_dark.png.
bool is_frame(const fs::path& file) {
  std::string stem = file.stem().string();
  take_off(stem, dark_theme().suffix);
  const std::size_t end = stem.find_last_not_of("0123456789");
  return file.extension() == ".png" && end != std::string::npos && end > 0 && stem[end] == '_' &&
         stem.size() == end + 5;
}

bool is_link(const fs::path& path) {
  std::error_code not_there;
  return fs::is_symlink(path, not_there);
}

void remove_files(const fs::path& folder, bool (*is_ours)(const fs::path&)) {
  if (is_link(folder)) return;  // to pictures of another run
  std::error_code ignored;
  std::vector<fs::path> ours;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.is_regular_file(ignored) && is_ours(entry.path())) ours.push_back(entry.path());
  for (const fs::path& file : ours) fs::remove(file, ignored);
}

}  // namespace

void remove_pictures(const fs::path& directory) {
  const fs::path figures = directory / "figures";
  if (is_link(figures)) return;
  remove_files(figures, is_picture);
  remove_files(figures / "film", is_frame);
  std::error_code still_holds_something;
  fs::remove(figures / "film", still_holds_something);
}

void require_own_figures(const fs::path& directory) {
  for (const fs::path& folder : {directory / "figures", directory / "figures/film"})
    if (is_link(folder))
      throw Error("{} is a link, and pictures of this run go into no folder of another: remove it", folder.string());
}

RunPictures draw_run(const RunFiles& run, const EnergyHistory& history, const PictureOptions& options) {
  require_own_figures(run.directory);
  RunPictures pictures;
  pictures.formats = options.formats;
  if (!is_one_of(pictures.formats, "png")) pictures.formats.insert(pictures.formats.begin(), "png");
  DrawingFolder drawing(run.directory / "figures");

  const SolutionReader solution(run.directory / "solution.h5");
  const Rendering light{.theme = &light_theme(), .formats = pictures.formats};
  const Rendering dark{.theme = &dark_theme(), .formats = pictures.formats};
  std::vector<std::string> scripts(2);  // one process each
  const std::string warning = shortfall(run);
  const auto add = [&](auto plot, const std::string& caption, const auto& script) {
    plot.warning = warning;
    scripts[0] += script(plot, light);
    scripts[1] += script(plot, dark);
    pictures.list.push_back({plot.stem, plot.title + (warning.empty() ? "" : "; " + warning), caption});
  };
  const auto add_curves = [&](const CurvePicture& picture) { add(picture.plot, picture.caption, plot_script); };
  const auto add_map = [&](const MapPicture& map) { add(map.plot, map.caption, map_script); };
  for (const CurvePicture& picture : energy_curves(run, history)) add_curves(picture);
  if (const auto bars = bars_picture(run, solution)) add_curves(*bars);
  for (const MapPicture& map : solution_maps(run, solution)) add_map(map);
  for (const CurvePicture& picture : solution_curves(run, solution)) add_curves(picture);
  run_gnuplot(scripts, drawing.path());
  std::vector<std::string> filmed = options.film_fields;
  const bool films = options.film && solution.axes().size() == 2;
  if (filmed.empty()) filmed = {solution.fields().front()};
  for (std::size_t f = 0; f < solution.fields().size(); ++f)
    if (films && is_one_of(filmed, solution.fields()[f]))
      pictures.films.push_back(draw_film(run, solution, static_cast<Index>(f), drawing.path()));
  remove_pictures(run.directory);  // of an earlier call, now that the new ones are there
  drawing.commit();
  return pictures;
}

}  // namespace seiche
