#include <bench/work_precision/page.hpp>
#include <bench/work_precision/page_tables.hpp>
#include <seiche/core/base/error.hpp>
#include <seiche/figure/html.hpp>
#include <seiche/figure/report_style.hpp>
#include <seiche/output/file/atomic_file.hpp>

#include <fmt/format.h>

namespace seiche::bench {
namespace {

std::string figure(const std::filesystem::path& directory, const Panel& panel) {
  const std::string caption = "<figcaption>" + html_escaped(panel.caption) + "</figcaption></figure>\n";
  try {
    const PngPicture png = read_png(directory / "figures" / (panel.stem + ".png"));
    return fmt::format(
        "<figure><a href=\"figures/{0}.pdf\" title=\"{0}.pdf\"><img src=\"{1}\" width=\"{2}\" height=\"{3}\" alt=\"{4}\"></a>{5}",
        html_escaped(panel.stem), png.data_uri, png.width, png.height, html_escaped(panel.title), caption);
  } catch (const Error&) {
    return "<figure><div class=\"missing\">" + html_escaped(panel.title) + ": not drawn</div>" + caption;
  }
}

std::string section(const ProblemResult& result, const std::filesystem::path& directory) {
  std::string text =
      fmt::format("<h2 id=\"{}\">{}</h2>\n<p class=\"parameters\">{}</p>\n", html_escaped(result.test.key),
                  html_escaped(result.test.title), html_text(result.test.parameters));
  text += fmt::format("<p class=\"source\">Reference: {}. {}: {}.</p>\n", html_text(result.reference),
                      result.law_holds ? "H never grows" : "No energy law", html_text(result.law_reason));
  text += "<div class=\"panels\">\n";
  for (const Panel& panel : panels_of(result)) text += figure(directory, panel);
  text += "</div>\n" + reach_table(result);
  return text + "<details><summary>Every run</summary>\n" + run_table(result) + "</details>\n";
}

constexpr const char* explanation =
    "<ul class=\"text\">\n"
    "<li>Each cell is the CPU time at which the error at T falls below the number above it, interpolated between "
    "neighbouring runs; in brackets the ratio to the fastest of Seiche’s methods. Below 1 the integrator is faster than Seiche. "
    "A dash: never reached within the cap.</li>\n"
    "<li>The law counts as kept where no solved run of the sweep, the coarsest included, let the energy rise from one reading to the "
    "next beyond 50ε times the size of its terms, per step. Fixed steps are read after every step, or at hundreds of them where there are "
    "more; adaptive integrators at 200 times. The sav methods are judged by their modified energy.</li>\n"
    "<li>Every right-hand side was compared with Seiche’s before it was timed. Set-up (plans, propagators) is in the "
    "table of every run, not in the times.</li>\n</ul>\n";

}  // namespace

void write_page(const std::vector<ProblemResult>& results, const Manifest& manifest,
                const std::filesystem::path& directory, const std::string& no_figures_because) {
  AtomicFile file(directory / "index.html");
  file.write(fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Seiche: work and precision</title>\n<style>{}</style>\n</head>\n<body>\n<main>\n"
      "<h1>Work and precision</h1>\n<p class=\"of\">Seiche’s methods, which keep an energy law, beside "
      "packaged integrators and hand-written codes, which promise none but where they project or relax</p>\n",
      report_style));
  if (!no_figures_because.empty())
    file.write("<p class=\"notice\"><strong>Without figures.</strong> " + html_escaped(no_figures_because) + "</p>\n");
  file.write("<nav aria-label=\"Sections\"><a href=\"#summary\">Summary</a>");
  for (const ProblemResult& result : results)
    file.write(fmt::format("<a href=\"#{0}\">{0}</a>", html_escaped(result.test.key)));
  file.write("<a href=\"#origin\">Origin</a></nav>\n<h2 id=\"summary\">Summary: seconds to an error</h2>\n");
  file.write(explanation + summary_table(results));
  for (const ProblemResult& result : results) file.write(section(result, directory));
  file.write(
      "<h2 id=\"origin\">Origin</h2>\n<p>Data: <a href=\"work_precision.csv\">work_precision.csv</a>, "
      "<a href=\"manifest.json\">manifest.json</a></p>\n<div class=\"scroll\"><table class=\"narrow\"><tbody>\n");
  for (const auto& [what, value] : manifest)
    file.write(fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", html_escaped(what), html_escaped(value)));
  file.write("</tbody></table></div>\n</main>\n</body>\n</html>\n");
  file.commit();
}

}  // namespace seiche::bench
