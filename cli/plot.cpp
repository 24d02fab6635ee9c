// seiche plot: the pictures of a run, and its report with them.
#include "command_line.hpp"

#include <fmt/ranges.h>
#include <seiche/config/case/run_spec.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>
#include <seiche/core/text/axis_names.hpp>
#include <seiche/figure/drawing.hpp>
#include <seiche/figure/ensemble_pictures.hpp>
#include <seiche/figure/run_pictures.hpp>
#include <seiche/figure/run_report.hpp>
#include <seiche/output/file/folder_lock.hpp>
#include <seiche/output/hdf5/hdf5.hpp>
#include <seiche/output/solution_layout.hpp>
#include <seiche/output/solution_reader.hpp>
#include <seiche/output/xdmf.hpp>
#include <seiche/record/checkpoint_file.hpp>
#include <seiche/record/run_folder.hpp>
#include <seiche/study/run_view.hpp>

#include <unistd.h>

#include <algorithm>
#include <locale>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

namespace seiche::cli {
namespace {

struct PlotArguments {
  std::string directory;
  std::string formats = "png,pdf,svg";
  std::string film_fields;
  bool no_film = false;
  std::vector<std::string> ranges;
  std::string palette;
  std::optional<double> centre, size;
  bool journal = false;
  bool xdmf = false;
};

std::vector<std::string> parsed_formats(const std::string& text) {
  std::vector<std::string> formats;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const std::vector<std::string>& known = picture_formats();
    if (std::find(known.begin(), known.end(), word) == known.end()) throw unknown_name("--format", word, known);
    if (std::find(formats.begin(), formats.end(), word) == formats.end()) formats.push_back(word);
  }
  if (formats.empty()) throw Error("--format needs one or more of {}", fmt::join(picture_formats(), ","));
  return formats;
}

std::vector<std::string> parsed_fields(const std::string& text, const SolutionReader& solution) {
  std::vector<std::string> fields;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const std::vector<std::string>& known = solution.fields();
    if (std::find(known.begin(), known.end(), word) == known.end()) throw unknown_name("--film", word, known);
    fields.push_back(word);
  }
  if (!fields.empty() && solution.axes().size() != 2)
    throw Error("--film {}: films are of solutions in the plane, and this one has {}", text,
                counted_axes(solution.axes().size()));
  return fields;
}

// "0.8,1.2" for all fields, "v=0,1.1" for one.
void add_range(const std::string& text, PictureOptions& options) {
  const std::size_t equals = text.find('=');
  const std::string field = equals == std::string::npos ? "" : text.substr(0, equals);
  double low = 0, high = 0;
  char comma = 0;
  std::istringstream words(equals == std::string::npos ? text : text.substr(equals + 1));
  words.imbue(std::locale::classic());
  words >> low >> comma >> high;
  if (words.fail() || comma != ',' || words.peek() != EOF || !(low < high) || equals == 0)
    throw Error(
        "--range {} must be two numbers with a comma, the lower one first: --range 0.8,1.2, or of one field: "
        "--range v=0,1.1",
        shortened(text));
  if (field.empty()) {
    options.range = std::pair(low, high);
  } else {
    options.ranges[field] = {low, high};
  }
}

PictureOptions picture_options(const PlotArguments& arguments) {
  constexpr double cm_per_inch = 2.54, least = 6, most = 60, column = 8.6;
  if (arguments.size && !(*arguments.size >= least && *arguments.size <= most))
    throw Error("--size {:g} must be a width in centimetres from {:g} to {:g}", *arguments.size, least, most);
  PictureOptions options = {.formats = parsed_formats(arguments.formats),
                            .film = !arguments.no_film,
                            .centre = arguments.centre,
                            .palette = arguments.palette,
                            .width = arguments.size.value_or(arguments.journal ? column : 0) / cm_per_inch,
                            .journal = arguments.journal,
                            .progress = ::isatty(STDERR_FILENO) != 0};
  for (const std::string& range : arguments.ranges) add_range(range, options);
  return options;
}

// Asked where something went wrong, since all of it is read.
bool is_damaged(const RunFiles& run) {
  try {
    const SolutionReader solution(run.solution);
    Vector values;
    for (Index k = 0; k < solution.count(); ++k) solution.state(k, values);
    return false;
  } catch (const Error&) {
    return true;
  }
}

ExitCode write_all_times(const std::filesystem::path& directory) {
  require_ended(directory);
  const RunFiles run = read_run(directory);
  const Folder folder(directory);
  const FolderLock lock(folder);
  write_xdmf(folder, "solution.h5", solution_layout(make_problem(run.spec)), {.all_times = true});
  print_lines(fmt::format("{:<10} {}\n", "ParaView", (directory / "solution.xdmf").string()));
  return success;
}

ExitCode plot_ensemble(const PlotArguments& arguments, const PictureOptions& options) {
  if (!arguments.ranges.empty() || arguments.centre || !arguments.palette.empty() || !arguments.film_fields.empty())
    throw Error(
        "{} holds an ensemble, whose pictures are curves: --range, --centre, --palette and --film have nothing to colour",
        arguments.directory);
  const std::filesystem::path directory = arguments.directory;
  EnsemblePictures pictures = ensemble_pictures(directory);
  const FolderLock lock = lock_for_pictures(directory, pictures.is_running);
  try {
    draw_ensemble(pictures, directory, options);
  } catch (const BadDrawingRequest&) {
    throw;
  } catch (const Error& error) {
    print_failure(error.what());
    return computation_failed;
  }
  print_lines(fmt::format("{:<10} {} in {}\n", "pictures", pictures.list.size(), (directory / "figures").string()));
  if (!pictures.has_ended) print_note(pictures.warning);
  return success;
}

ExitCode plot(const PlotArguments& arguments) {
  hdf5_without_cleanup_at_exit();  // which of a damaged file says that it does not end
  if (arguments.xdmf) return write_all_times(arguments.directory);
  PictureOptions options = picture_options(arguments);
  if (holds_ensemble(arguments.directory)) return plot_ensemble(arguments, options);
  const auto [run, history] = view_of_run(arguments.directory);
  if (!std::filesystem::exists(run.solution) && !checkpoints_in(run.directory).empty())
    throw Error(
        "{0} has no solution.h5, since there was no room for it: `seiche recover {0}` writes what a checkpoint vouches for, "
        "and `seiche resume {0}` goes on from it",
        run.directory.string());
  if (!std::filesystem::exists(run.solution))
    throw Error(
        "{0} has no solution.h5 and nothing to draw: its run ended before a state was written, or the file was removed; "
        "`seiche run {0}/case.toml --out {0} --restart` computes it again",
        run.directory.string());
  if (!arguments.film_fields.empty())
    options.film_fields = parsed_fields(arguments.film_fields, SolutionReader(run.solution));
  const FolderLock lock = lock_for_pictures(run.directory, run.is_running);
  require_own_report(run.directory);
  require_own_figures(run.directory);
  try {
    const RunPictures pictures = draw_run(run, history, options);
    write_run_report(run, history, pictures);
    print_lines(
        fmt::format("{:<10} {} in {}\n", "pictures", pictures.list.size(), (run.directory / "figures").string()));
    for (const Film& film : pictures.films) {
      print_lines(fmt::format("{:<10} {}\n", "film", (run.directory / film.file).string()));
      print_lines(fmt::format("{:<10} {}\n", "", (run.directory / film.dark_file).string()));
      if (!film.note.empty()) print_note(fmt::format("the film is {}", film.note));
    }
  } catch (const BadDrawingRequest&) {
    throw;
  } catch (const Error& error) {
    if (is_damaged(run)) throw;
    // The run and its files are what they were, and so are pictures of an earlier call.
    if (!std::filesystem::exists(run.directory / "figures" / "energy.png"))
      write_run_report(run, history, {}, error.what());
    print_failure(error.what());
    return computation_failed;
  }
  print_lines(fmt::format("{:<10} {}\n", "report", (run.directory / "report.html").string()));
  if (!run.has_ended) print_note(run.status);
  return success;
}

}  // namespace

void add_plot(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<PlotArguments>();
  CLI::App* command = app.add_subcommand(
      "plot",
      "Draw a run, also one that goes on: energies, solution, film, and report.html with them; of an ensemble its energies");
  command->add_option("DIR", arguments->directory, "The directory that a run left")->required()->type_name("");
  command->add_option("--format", arguments->formats, "Kinds of files: png, pdf, svg (all if not given; png always)")
      ->type_name("LIST");
  CLI::Option* film = command
                          ->add_option("--film", arguments->film_fields,
                                       "Fields to film, of a solution in the plane (the first if not given)")
                          ->type_name("FIELDS");
  command->add_flag("--no-film", arguments->no_film, "No film of a solution in the plane, which takes longest")
      ->excludes(film);
  CLI::Option* range =
      command
          ->add_option(
              "--range", arguments->ranges,
              "Lowest and highest value of the colours, of all fields or of one: --range 0.8,1.2 --range v=0,1.1")
          ->allow_extra_args(false)
          ->type_name("[FIELD=]LOW,HIGH");
  command
      ->add_option("--centre", arguments->centre, "The value of the middle colour, for colours from both sides of it")
      ->type_name("VALUE")
      ->excludes(range);
  command->add_option("--palette", arguments->palette, "Colours of maps, one of Matplotlib's: magma, RdBu_r, …")
      ->type_name("NAME");
  command->add_option("--size", arguments->size, "Width of every picture but films in centimetres (8.6)")
      ->type_name("CM");
  command->add_flag("--journal", arguments->journal,
                    "For a paper: 8.6 cm wide unless --size says otherwise, no titles");
  command->add_flag("--xdmf", arguments->xdmf,
                    "No pictures, but solution.xdmf with every time for ParaView, where a long run left some out");
  command->callback([arguments, &action] { action = [arguments] { return plot(*arguments); }; });
}

}  // namespace seiche::cli
