#include <seiche/core/error.hpp>
#include <seiche/figure/gnuplot.hpp>
#include <seiche/figure/picture_choice.hpp>
#include <seiche/figure/run_pictures.hpp>
#include <seiche/output/atomic_file.hpp>

#include <algorithm>

namespace seiche {
namespace fs = std::filesystem;

void remove_pictures(const fs::path& directory) {
  const fs::path figures = directory / "figures";
  std::error_code ignored;
  fs::remove(directory / "report.html", ignored);
  fs::remove_all(figures / "film", ignored);
  std::vector<fs::path> pictures;
  for (const auto& entry : fs::directory_iterator(figures, ignored)) {
    const std::string extension = entry.path().extension().string();
    const std::vector<std::string>& formats = picture_formats();
    const bool film =
        (extension == ".mp4" || extension == ".webm") && entry.path().filename().string().starts_with("film");
    const bool picture =
        extension.size() > 1 && std::find(formats.begin(), formats.end(), extension.substr(1)) != formats.end();
    if (film || picture) pictures.push_back(entry.path());
  }
  for (const fs::path& picture : pictures) fs::remove(picture, ignored);
}

RunPictures draw_run(const RunFiles& run, const EnergyHistory& history, const PictureOptions& options) {
  RunPictures pictures;
  pictures.formats = options.formats;
  if (std::find(pictures.formats.begin(), pictures.formats.end(), "png") == pictures.formats.end())
    pictures.formats.insert(pictures.formats.begin(), "png");
  const fs::path figures = run.directory / "figures";
  remove_pictures(run.directory);
  make_directory(figures);

  const SolutionReader solution(run.directory / "solution.h5");
  const Rendering light{.theme = &light_theme(), .formats = pictures.formats};
  const Rendering dark{.theme = &dark_theme(), .formats = pictures.formats};
  std::vector<std::string> scripts(2);  // one process each
  const auto add = [&](const auto& plot, const std::string& caption, const auto& script) {
    scripts[0] += script(plot, light);
    scripts[1] += script(plot, dark);
    pictures.list.push_back({plot.stem, plot.title, caption});
  };
  const auto add_curves = [&](const CurvePicture& picture) { add(picture.plot, picture.caption, plot_script); };
  const auto add_map = [&](const MapPicture& map) { add(map.plot, map.caption, map_script); };
  for (const CurvePicture& picture : energy_curves(run, history)) add_curves(picture);
  if (const auto bars = bars_picture(run, solution)) add_curves(*bars);
  for (const MapPicture& map : solution_maps(run, solution)) add_map(map);
  for (const CurvePicture& picture : solution_curves(run, solution)) add_curves(picture);
  run_gnuplot(scripts, figures);
  if (!options.film || solution.axes().size() != 2) return pictures;
  std::vector<std::string> filmed = options.film_fields;
  if (filmed.empty()) filmed = {solution.fields().front()};
  for (std::size_t f = 0; f < solution.fields().size(); ++f)
    if (std::find(filmed.begin(), filmed.end(), solution.fields()[f]) != filmed.end())
      pictures.films.push_back(draw_film(run, solution, static_cast<Index>(f)));
  return pictures;
}

}  // namespace seiche
