#include <seiche/core/base/error.hpp>
#include <seiche/figure/curves.hpp>
#include <seiche/figure/drawing.hpp>
#include <seiche/figure/drawing_folder.hpp>
#include <seiche/figure/run_pictures.hpp>
#include <seiche/figure/style.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/study/run_view.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>

namespace seiche {
namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view dark_suffix = "_dark";

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

// By their names, which python/seiche/drawing gives.
bool is_picture(const fs::path& file) {
  const std::string extension = file.extension().string();
  std::string stem = file.stem().string();
  take_off(stem, dark_suffix);
  if (is_one_of({".mp4", ".webm", ".webp", ".apng"}, extension)) return begins_with_one_of(stem, {"film_"});
  if (extension.empty() || !is_one_of(picture_formats(), extension.substr(1))) return false;
  return is_one_of({"energy", "ledger", "bars", "fields"}, stem) ||
         begins_with_one_of(stem, {"portrait_", "profiles_", "space_time_", "slices_", "planes_", "members_"});
}

// u_0001.png and u_0001_dark.png in figures/film, where earlier versions left the frames of films.
bool is_frame(const fs::path& file) {
  std::string stem = file.stem().string();
  take_off(stem, dark_suffix);
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

Json points_of(const Curve& curve) { return {curve.t, curve.value}; }

Json request_for(const RunFiles& run, const EnergyHistory& history, const std::vector<std::string>& formats,
                 const PictureOptions& options) {
  Json causes = Json::array();
  for (const Curve& cause : history.causes) causes.push_back({cause_label(history, cause.name), points_of(cause)});
  Json request = {{"solution", fs::absolute(run.solution).string()},
                  {"title", run_title(run_name(run), run.method, run.spec)},
                  {"warning", shortfall(run)},
                  {"formats", formats},
                  {"history",
                   {{"H", points_of(history.H)},
                    {"modified", history.modified ? points_of(*history.modified) : Json()},
                    {"causes", causes}}},
                  {"films", options.film_fields.empty() ? Json() : Json(options.film_fields)},
                  {"journal", options.journal},
                  {"progress", options.progress}};
  if (!options.film) request["films"] = Json::array();
  if (options.range) request["range"] = {options.range->first, options.range->second};
  for (const auto& [field, ends] : options.ranges) request["ranges"][field] = {ends.first, ends.second};
  if (options.centre) request["centre"] = *options.centre;
  if (!options.palette.empty()) request["palette"] = options.palette;
  if (options.width > 0) request["width"] = options.width;
  return request;
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

const std::vector<std::string>& picture_formats() {
  static const std::vector<std::string> formats = {"png", "pdf", "svg"};
  return formats;
}

std::vector<std::string> with_png(std::vector<std::string> formats) {
  if (!is_one_of(formats, "png")) formats.insert(formats.begin(), "png");
  return formats;
}

std::string run_title(const std::string& name, const std::string& method, const RunSpec& spec) {
  const std::string steps = spec.tolerance ? fmt::format("tolerance {}", step_text(*spec.tolerance))
                                           : fmt::format("h = {}", step_text(spec.h));
  return fmt::format("{}, {}, {}", name, method_label(method), steps);
}

FolderLock lock_for_pictures(const fs::path& directory, bool is_running) {
  if (!is_running) return FolderLock{Folder(directory)};
  require_own_figures(directory);
  make_directory(directory / "figures");
  return FolderLock{Folder(directory / "figures")};
}

RunPictures draw_run(const RunFiles& run, const EnergyHistory& history, const PictureOptions& options) {
  require_own_figures(run.directory);
  const SolutionReader readable(run.solution);  // or Python would end by damage, or wait for ever
  RunPictures pictures{.list = {}, .formats = with_png(options.formats), .films = {}};
  DrawingFolder drawing(run.directory / "figures");
  const Json drawn = Json::parse(draw(request_for(run, history, pictures.formats, options).dump(), drawing.path()));
  for (const Json& one : drawn.at("pictures"))
    pictures.list.push_back({one.at("stem"), one.at("title"), one.at("caption")});
  for (const Json& one : drawn.at("films")) {
    const auto file = [&](const char* ground) { return "figures/" + one.at("files").at(ground).get<std::string>(); };
    pictures.films.push_back({.field = one.at("field"),
                              .frames = one.at("frames"),
                              .file = file("light"),
                              .dark_file = file("dark"),
                              .remark = one.at("remark"),
                              .note = one.at("note")});
  }
  require_still_unfinished(run);
  remove_pictures(run.directory);  // of an earlier call, now that the new ones are there
  drawing.commit();
  return pictures;
}

}  // namespace seiche
