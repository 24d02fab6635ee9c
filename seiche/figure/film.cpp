#include <seiche/core/error.hpp>
#include <seiche/figure/child_program.hpp>
#include <seiche/figure/film.hpp>
#include <seiche/figure/gnuplot.hpp>
#include <seiche/figure/plot/curves.hpp>
#include <seiche/figure/run_maps.hpp>
#include <seiche/output/file/atomic_file.hpp>

#include <fmt/format.h>

namespace seiche {
namespace {

namespace fs = std::filesystem;

constexpr Index most_frames = 150;
constexpr std::size_t frames_at_once = 16;  // of one script: its numbers are text in memory

// What went wrong, or "".
std::string encode(const fs::path& figures, const std::string& frames, const std::string& file,
                   const std::vector<std::string>& codec) {
  PartialPath film(figures / file);
  std::vector<std::string> command = {"ffmpeg", "-nostdin",       "-y",       "-loglevel", "error", "-framerate", "15",
                                      "-i",     "film/" + frames, "-pix_fmt", "yuv420p"};
  // What a film does not say about its colours each player guesses from its size, and not all alike.
  command.insert(command.end(), {"-vf", "scale=720:-2:out_color_matrix=bt709:out_range=tv", "-color_range", "tv",
                                 "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"});
  command.insert(command.end(), codec.begin(), codec.end());
  // By its temporary name ffmpeg does not know the kind.
  command.insert(command.end(),
                 {"-f", film.path().extension().string().substr(1), film.temporary().filename().string()});
  ChildProgram program(
      command, "", figures,
      "ffmpeg was not found on the PATH; it joins the frames in figures/film to a film (Debian package "
      "ffmpeg)");
  std::string failure = program.finish();
  if (failure.empty()) film.commit();
  return failure;
}

// The file, from the folder of the run; "" with a reason in `note`.
std::string joined(const fs::path& figures, const std::string& field, const Theme& theme, std::string& note) {
  const std::string name = "film_" + field + theme.suffix, frames = field + "_%04d" + theme.suffix + ".png";
  note = encode(figures, frames, name + ".mp4", {"-c:v", "libx264", "-crf", "20", "-movflags", "+faststart"});
  if (note.empty()) return "figures/" + name + ".mp4";
  // Built without H.264.
  note = encode(figures, frames, name + ".webm", {"-c:v", "libvpx-vp9", "-b:v", "0", "-crf", "32"});
  return note.empty() ? "figures/" + name + ".webm" : "";
}

}  // namespace

Film draw_film(const RunFiles& run, const SolutionReader& solution, Index field, const fs::path& figures) {
  Film film;
  film.field = solution.fields()[static_cast<std::size_t>(field)];
  if (solution.axes().size() != 2 || solution.count() < 2) return film;
  make_directory(figures / "film");

  const std::vector<Index> times = spread(solution.count(), most_frames);
  const ColourScale colours = common_scale(solution, field, times);
  const Rendering light{.theme = &light_theme(), .formats = {"png"}};
  const Rendering dark{.theme = &dark_theme(), .formats = {"png"}};
  for (std::size_t begin = 0; begin < times.size(); begin += frames_at_once) {
    std::vector<std::string> scripts(2);  // one process each
    for (std::size_t i = begin; i < std::min(begin + frames_at_once, times.size()); ++i) {
      MapPlot frame = film_frame(run, solution, field, times[i], colours);
      frame.stem = fmt::format("{}_{:04}", film.field, i + 1);
      scripts[0] += map_script(frame, light);
      scripts[1] += map_script(frame, dark);
    }
    run_gnuplot(scripts, figures / "film");
  }
  film.frames = times.size();
  film.remark = scale_remark(colours);

  try {
    film.file = joined(figures, film.field, light_theme(), film.note);
    if (!film.file.empty()) film.dark_file = joined(figures, film.field, dark_theme(), film.note);
  } catch (const Error& error) {
    film.note = error.what();
  }
  return film;
}

}  // namespace seiche
