// The pictures of a run, drawn into its folder.
#pragma once

#include <seiche/output/file/folder_lock.hpp>
#include <seiche/study/energy_history.hpp>
#include <seiche/study/run_files.hpp>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seiche {

struct RunPicture {
  std::string stem;  // figures/<stem>.png for a light ground, figures/<stem>_dark.png for a dark one
  std::string title, caption;
};

// Of a field in the plane: an MP4 or WebM, or an animated WebP or PNG where ffmpeg is missing.
struct Film {
  std::string field;
  std::size_t frames = 0;
  std::string file, dark_file;  // "figures/film_u.mp4", "figures/film_u_dark.mp4", from the folder of the run
  std::string remark;           // of its scale of colours, or ""
  std::string note;             // why it is an animated picture, or ""
};

struct RunPictures {
  std::vector<RunPicture> list;
  std::vector<std::string> formats;
  std::vector<Film> films;
};

struct PictureOptions {
  std::vector<std::string> formats = {"png", "pdf", "svg"};  // png is always among them: the report shows it
  bool film = true;
  std::vector<std::string> film_fields = {};                     // empty: the first
  std::optional<std::pair<double, double>> range = {};           // of the colours of maps
  std::map<std::string, std::pair<double, double>> ranges = {};  // the same of single fields
  std::optional<double> centre = {};  // the value of the middle colour, of colours from both sides
  std::string palette = {};           // one of Matplotlib's, "" for those of the house
  double width = 0;                   // inches; 0: 3.4
  bool journal = false;               // without titles
  bool progress = false;              // on the terminal
};

const std::vector<std::string>& picture_formats();
std::vector<std::string> with_png(std::vector<std::string> formats);

// "Klein–Gordon equation, SEISAV, h = 2⁻⁸": what titles begin with.
std::string run_title(const std::string& name, const std::string& method, const RunSpec& spec);

// Throws Error where DIR/figures, or the folder in it where earlier versions left the frames of films, is a link,
// through which files would get elsewhere or vanish there.
void require_own_figures(const std::filesystem::path& directory);

// For who draws: the lock of the folder, or of its figures where the run itself holds the other.
FolderLock lock_for_pictures(const std::filesystem::path& directory, bool is_running);

// Throws Error where require_own_figures does, where Python or a package that draws is missing or fails, where
// solution.h5 cannot be read, and where a run that went on has ended meanwhile; then what an earlier call drew stays,
// and goes only where everything is drawn. Throws BadDrawingRequest for a palette or a field that there is not.
RunPictures draw_run(const RunFiles& run, const EnergyHistory& history, const PictureOptions& options = {});

// What draw_run left in the figures of an earlier run, so that nothing old stands beside new data; other files stay.
void remove_pictures(const std::filesystem::path& directory);

}  // namespace seiche
