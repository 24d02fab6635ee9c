#include <paper/pictures.hpp>
#include <paper/report.hpp>
#include <paper/report_tables.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/core/text/characters.hpp>
#include <seiche/figure/html.hpp>
#include <seiche/figure/mathml.hpp>
#include <seiche/figure/report_figure.hpp>
#include <seiche/figure/report_style.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/record/run_folder.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>

namespace seiche {
namespace {

namespace fs = std::filesystem;

// Where the page lies, and what it cannot show.
struct Page {
  const PaperResults& results;
  fs::path directory;
  const std::vector<CurvePicture>& pictures;
  std::string no_figures_because;
};

std::string plural(std::size_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::size_t count_of(const PaperResults& results, Outcome outcome) {
  return static_cast<std::size_t>(std::count_if(results.verdicts.begin(), results.verdicts.end(),
                                                [&](const Verdict& verdict) { return verdict.outcome == outcome; }));
}

std::string formula(std::string_view text) { return mathml(text, Notation::printed); }

// "L = 2, ω² = 0.2, …; SAV constant C automatic": what equals a number, as formulas.
std::string typeset_parameters(std::string_view text) {
  std::string html;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(",;("), text.size());
    const std::string_view part = text.substr(0, end);
    const bool is_formula = part.find(" = ") != std::string_view::npos && part.find(" with ") == std::string_view::npos;
    html += is_formula ? (part.starts_with(' ') ? " " : "") + formula(trimmed(part)) + (part.ends_with(' ') ? " " : "")
                       : html_escaped(std::string(part));
    html += text.substr(end, 1);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return html;
}

// A link to each of the files that is there.
std::string links(const Page& page, const std::vector<std::string>& files) {
  std::string text;
  for (const std::string& file : files) {
    if (!fs::exists(page.directory / file)) continue;
    text += fmt::format("{}<a href=\"{}\">{}</a>", text.empty() ? "Data: " : ", ", html_escaped(file),
                        html_escaped(fs::path(file).filename().string()));
  }
  return text.empty() ? "" : "<p>" + text + "</p>\n";
}

std::string anchor_of(std::string number) {
  std::erase(number, ',');
  std::replace(number.begin(), number.end(), ' ', '-');
  std::transform(number.begin(), number.end(), number.begin(), [](unsigned char c) { return std::tolower(c); });
  return number;
}

std::string figure(const Page& page, const std::string& stem) {
  const auto found = std::find_if(page.pictures.begin(), page.pictures.end(),
                                  [&](const CurvePicture& picture) { return picture.stem == stem; });
  if (found == page.pictures.end()) return "";
  return report_figure(page.directory, {.stem = stem,
                                        .title = found->title,
                                        .caption = found->caption,
                                        .formats = {"png", "pdf"},
                                        .number = found->number,
                                        .anchor = anchor_of(found->number)});
}

std::string page_head(const Page& page) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{}\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>The paper’s numerical experiments{}</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n",
      report_mark, page.results.quick ? " (quick run)" : "", report_style);
}

std::string summary(const Page& page) {
  const PaperResults& results = page.results;
  std::size_t runs = 0, most = 0, fewest = std::numeric_limits<std::size_t>::max();
  for (const ExampleResult& example : results.examples) {
    runs += example.rows.size();
    most = std::max(most, example.methods.size());
    fewest = std::min(fewest, example.methods.size());
  }
  std::string text =
      "<h1>The paper’s numerical experiments</h1>\n<p class=\"of\">A unified framework of energy-stable splitting "
      "exponential integrators for damped Hamiltonian systems: every experiment computed again by Seiche</p>\n";
  if (results.quick) {
    text +=
        "<p class=\"notice\"><strong>Quick run.</strong> The examples end earlier than in the paper, and CPU times come "
        "from short runs. The verdicts are those of these shorter runs; the full ones need <code>seiche paper</code> "
        "without <code>--quick</code>.</p>\n";
  }
  if (!page.no_figures_because.empty()) {
    text += "<p class=\"notice\"><strong>Without figures.</strong> " + html_escaped(page.no_figures_because) +
            ". Data and verdicts are complete.</p>\n";
  }
  text += fmt::format(
      "<p>{} with {}{} were integrated in {} and compared with an independent reference; further studies ({}) look at "
      "single points more closely. Of the {} that the paper makes about its experiments:</p>\n",
      plural(results.examples.size(), "example"), fewest < most ? "up to " : "", plural(most, "method"),
      plural(runs, "run"), results.side_studies.size(), plural(results.verdicts.size(), "claim"));
  text += "<ul class=\"counts\">";
  for (const Outcome outcome : {Outcome::holds, Outcome::does_not_hold, Outcome::depends}) {
    text += fmt::format("<li><b>{}</b>{}</li>", count_of(results, outcome), outcome_mark(outcome));
  }
  text +=
      "</ul>\n<nav aria-label=\"Sections\"><a href=\"#verdicts\">Verdicts</a><a href=\"#measured\">How this was measured</a>";
  for (const ExampleResult& example : results.examples) {
    text += fmt::format("<a href=\"#{}\">{}</a>", html_escaped(example.key),
                        html_escaped(example.title.substr(0, example.title.find_first_of(":,"))));
  }
  if (!results.side_studies.empty()) text += "<a href=\"#studies\">Further studies</a>";
  return text + "<a href=\"#origin\">Origin</a></nav>\n";
}

double smallest_error(const ExampleResult& example) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const StudyRow& row : example.rows) {
    if (row.failure.empty() && row.error > 0) smallest = std::min(smallest, row.error);
  }
  return smallest;
}

std::string how_measured(const PaperResults& results) {
  std::string text =
      "<h2 id=\"measured\">How this was measured</h2>\n<ul class=\"text\">\n"
      "<li>The error of a run is " +
      formula("max_n ‖zⁿ − z(t_n)‖_∞") + " over all its steps, the energy error " +
      formula("max_n |H(zⁿ) − H(z(t_n))|") + ", with " + formula("z(t)") +
      " from the reference below.</li>\n"
      "<li>The order compares the error with that at the next larger time step of the same method.</li>\n"
      "<li>CPU time is that of the time stepping alone: the median of repeated runs after a warm-up, in which the methods "
      "take turns. Ratios between methods carry over to other machines far better than the times themselves.</li>\n"
      "<li>An energy law counts as held if no recorded step raised the energy it speaks about beyond round-off.</li>\n"
      "</ul>\n<div class=\"scroll\"><table class=\"numbers\"><thead><tr><th scope=\"col\">Example</th>"
      "<th scope=\"col\" class=\"words\">Reference</th><th scope=\"col\">its error</th><th scope=\"col\">smallest error judged</th>"
      "</tr></thead>\n<tbody>\n";
  for (const ExampleResult& example : results.examples) {
    text += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"words\">{}</td><td>{}</td><td>{}</td></tr>\n",
                        html_escaped(example.title.substr(0, example.title.find_first_of(":,"))),
                        html_text(example.reference), html_number(example.reference_error),
                        html_number(smallest_error(example)));
  }
  return text + "</tbody></table></div>\n";
}

std::string example_section(const Page& page, const ExampleResult& example) {
  std::string text = fmt::format(
      "<h2 id=\"{}\">{}</h2>\n<p class=\"equation\">{}</p>\n<p class=\"parameters\">{}</p>\n<div class=\"pictures\">\n",
      html_escaped(example.key), html_escaped(example.title), formula(example.equation),
      typeset_parameters(example.parameters));
  for (const CurvePicture& picture : example_pictures(example, page.results.quick)) text += figure(page, picture.stem);
  if (example.key == "alpha_fpu_dissipative") {
    if (const auto picture = formulations_picture(page.results)) text += figure(page, picture->stem);
  }
  text += "</div>\n<h3>Errors and orders</h3>\n" + error_table(example);
  text += "<details><summary>Energy, cost and solver of each run</summary>\n" + record_table(example) + "</details>\n";
  return text + links(page, {"data/" + example.key + "_errors.csv", "data/" + example.key + "_energy.csv",
                             "data/" + example.key + "_energy_errors.csv"});
}

std::string side_section(const Page& page) {
  if (page.results.side_studies.empty()) return "";
  std::string text = "<h2 id=\"studies\">Further studies</h2>\n<div class=\"pictures\">\n";
  std::vector<std::string> files;
  for (const SideStudy& study : page.results.side_studies) {
    text += figure(page, study.key);
    files.push_back("data/" + study.key + ".csv");
  }
  return text + "</div>\n" + links(page, files);
}

std::string origin(const Page& page, const std::map<std::string, std::string>& versions) {
  std::string text = fmt::format(
      "<h2 id=\"origin\">Origin</h2>\n<p>Made by <code>seiche paper{}</code> in {:.0f} s. The verdicts are also in "
      "<code>verdicts.csv</code>, each figure is in <code>figures</code> as PNG and PDF, and what it shows in "
      "<code>data</code>.</p>\n",
      page.results.quick ? " --quick" : "", std::max(page.results.seconds, 0.0));
  if (versions.empty()) return text;
  text += "<div class=\"scroll\"><table class=\"narrow\"><tbody>\n";
  for (const auto& [what, version] : versions) {
    text += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", html_escaped(what), html_escaped(version));
  }
  return text + "</tbody></table></div>\n";
}

FigureAnchors anchors_of(const std::vector<CurvePicture>& pictures) {
  FigureAnchors anchors;
  for (const CurvePicture& picture : pictures)
    if (!picture.number.empty()) anchors[picture.number] = anchor_of(picture.number);
  return anchors;
}

}  // namespace

void write_report(const PaperResults& results, const std::vector<CurvePicture>& pictures, const fs::path& directory,
                  const std::map<std::string, std::string>& versions, const std::string& no_figures_because) {
  const Page page{results, directory, pictures, no_figures_because};
  make_directory(directory);
  AtomicFile file(directory / "report.html");
  file.write(page_head(page));
  file.write(summary(page));
  file.write("<h2 id=\"verdicts\">Verdicts</h2>\n" + verdict_table(results.verdicts, anchors_of(pictures)));
  file.write(how_measured(results));
  for (const ExampleResult& example : results.examples) file.write(example_section(page, example));
  file.write(side_section(page));
  file.write(origin(page, versions));
  file.write("</main>\n</body>\n</html>\n");
  file.commit();
}

}  // namespace seiche
