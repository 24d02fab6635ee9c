#include <seiche/core/base/error.hpp>
#include <seiche/figure/curves.hpp>
#include <seiche/figure/equation.hpp>
#include <seiche/figure/html.hpp>
#include <seiche/figure/report_figure.hpp>
#include <seiche/figure/report_style.hpp>
#include <seiche/figure/run_report.hpp>
#include <seiche/figure/style.hpp>
#include <seiche/output/citation.hpp>
#include <seiche/output/file/atomic_file.hpp>
#include <seiche/record/run_folder.hpp>
#include <seiche/study/run_files.hpp>
#include <seiche/study/run_view.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace seiche {
namespace {

std::string mark(const char* kind, const char* symbol, const std::string& text) {
  // The text variant of the symbol, where fonts also have a coloured picture.
  return fmt::format(R"(<span class="outcome {}"><span aria-hidden="true">{}&#xFE0E;</span> {}</span>)", kind, symbol,
                     html_escaped(text));
}

std::string status_mark(const RunFiles& run) {
  if (run.status == "success") return mark("holds", "✓", "success");
  const std::string when = early_end(run);
  return run.status == "failed" ? mark("fails", "✗", when) : mark("depends", "≈", when);
}

std::string law_mark(const RunFiles& run) {
  if (!run.has_ended) return mark("depends", "≈", "the energy law is judged at the end");
  if (run.law == "holds") return mark("holds", "✓", "the energy law holds");
  return run.law == "violated" ? mark("fails", "✗", "the energy law is violated")
                               : mark("depends", "≈", "no energy law is promised");
}

std::string grade_mark(const std::string& grade) {
  if (grade == "violated") return mark("fails", "✗", grade);
  return grade == "sampled" ? mark("depends", "≈", grade) : mark("holds", "✓", grade);
}

std::string steps_text(const RunFiles& run) {
  return run.spec.tolerance ? fmt::format("Steps of variable size for the tolerance {:g}", *run.spec.tolerance)
                            : fmt::format("Steps of size h = {}", step_text(run.spec.h));
}

std::string version(const RunFiles& run, const std::string& of) {
  const auto found = run.versions.find(of);
  return found == run.versions.end() ? "" : found->second;
}

// " Finished on 2026-11-26 at 12:40 UTC, by Seiche 0.1.0."
std::string finished_text(const RunFiles& run) {
  constexpr std::size_t date = 10, minute = 16;  // characters of 2026-11-26T12:40:33Z up to their end
  if (run.finished.size() < minute) return "";
  return html_escaped(fmt::format(" Finished on {} at {} UTC, by Seiche {}.", run.finished.substr(0, date),
                                  run.finished.substr(date + 1, minute - date - 1), version(run, "seiche")));
}

std::string head(const RunFiles& run) {
  const std::string title = fmt::format("{} by {}", run_name(run), method_label(run.method));
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{4}\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n<style>{1}{2}</style>\n"
      "</head>\n<body>\n<main>\n<h1>{0}</h1>\n{3}",
      html_escaped(title), report_style, run_report_style, equation_html(run.spec), report_mark);
  std::string sentence = run.message;
  if (!sentence.empty()) sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
  text += fmt::format("<p>{} {}</p>\n<p>{}. {}, backend {}.{}</p>\n", status_mark(run), law_mark(run),
                      html_text(sentence), html_text(steps_text(run)), html_escaped(run.backend), finished_text(run));
  return text;
}

// As it is where that is short.
std::string number(double value) {
  const double size = std::abs(value);
  return size >= 1e-3 && size < 1e6 ? fmt::format("{}{:.4g}", value < 0 ? "−" : "", size) : html_number(value);
}

std::string energy_row(const char* name, const EnergyNumbers& energy) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{:.10g}</td><td>{:.10g}</td><td>{}</td></tr>\n", name,
                     energy.initial, energy.final,
                     html_number(energy.max_increase) + (energy.max_increase < 0 ? " (it never rose)" : ""));
}

std::string energies(const RunFiles& run) {
  std::string text =
      "<h2 id=\"energy\">Energy</h2>\n<div class=\"scroll\"><table class=\"numbers narrow\"><thead><tr><th scope=\"col\"></th>"
      "<th scope=\"col\">at the start</th><th scope=\"col\">" +
      std::string(run.has_ended ? "at the end" : "at last") +
      "</th><th scope=\"col\">largest increase between records</th></tr></thead>\n<tbody>\n";
  text += energy_row("H", run.energy);
  if (run.modified) text += energy_row("modified energy", *run.modified);
  return text + "</tbody></table></div>\n";
}

std::string certificate(const RunFiles& run) {
  if (!run.has_ended) return "";
  std::string text = "<h2 id=\"certificate\">Certificate</h2>\n";
  text += run.promised ? fmt::format("<p>The energy law is promised: {}.</p>\n", html_text(run.law_reason))
                       : fmt::format("<p>No energy law is promised: {}.</p>\n", html_text(run.law_reason));
  if (!run.theorem.empty()) text += fmt::format("<p class=\"source\">{}</p>\n", html_text(run.theorem));
  if (run.hypotheses.empty()) return text;
  text +=
      "<div class=\"scroll\"><table class=\"certificate\"><thead><tr><th scope=\"col\">Hypothesis</th><th scope=\"col\">Known</th>"
      "<th scope=\"col\">What was found</th></tr></thead>\n<tbody>\n";
  for (const HypothesisFound& one : run.hypotheses) {
    const std::string witness =
        one.witness.empty() ? "" : "<div class=\"source\">Witness: " + html_text(one.witness) + "</div>";
    text += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}{}</td></tr>\n", html_text(one.name),
                        grade_mark(one.grade), html_text(one.statement), witness);
  }
  return text + "</tbody></table></div>\n";
}

std::string ledger(const RunFiles& run, const EnergyHistory& history) {
  if (history.causes.empty() || history.H.value.empty()) return "";
  std::string text =
      "<h2 id=\"ledger\">Ledger</h2>\n<p>Where the change of H over the whole run comes from.</p>\n<div class=\"scroll\">"
      "<table class=\"numbers narrow\"><thead><tr><th scope=\"col\">Part</th><th scope=\"col\">change of H</th></tr></thead>\n"
      "<tbody>\n";
  for (const Curve& cause : history.causes)
    text += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n",
                        html_escaped(cause_label(history, cause.name)), number(cause.value.back()));
  return text +
         fmt::format("<tr class=\"group\"><th scope=\"row\">all together</th><td>{}</td></tr></tbody></table></div>\n",
                     number(run.energy.final - run.energy.initial));
}

std::string film(const Film& film) {
  const auto shown = [](const std::string& file, const char* ground) {
    const char* kind = file.ends_with(".mp4") || file.ends_with(".webm")
                           ? "<video class=\"{0}\" src=\"{1}\" controls loop muted preload=\"metadata\"></video>"
                           : "<img class=\"{0}\" src=\"{1}\" alt=\"film\" loading=\"lazy\">";
    return fmt::format(fmt::runtime(kind), ground, html_escaped(file));
  };
  const auto link = [](const std::string& file) { return fmt::format("<a href=\"{0}\">{0}</a>", html_escaped(file)); };
  return fmt::format(
      "<figure class=\"film\"><div class=\"drawn\">{}{}</div><figcaption>{}: {} frames with one scale of colours.{}{} {}, "
      "and for a dark ground {}.</figcaption></figure>\n",
      shown(film.file, "on-light"), shown(film.dark_file, "on-dark"), html_text(film.field), film.frames,
      html_text(film.remark), film.note.empty() ? "" : html_text(" It is " + film.note + "."), link(film.file),
      link(film.dark_file));
}

std::string pictures_section(const RunFiles& run, const RunPictures& pictures, const std::string& why_none) {
  std::string text = "<h2 id=\"pictures\">Pictures</h2>\n";
  if (pictures.list.empty()) {
    return text + (why_none.empty()
                       ? "<p>Not drawn yet: <code>seiche plot</code> with the name of this folder draws them.</p>\n"
                       : "<p class=\"notice\"><strong>Without pictures.</strong> " + html_escaped(why_none) +
                             ". Everything else is complete.</p>\n");
  }
  text += "<div class=\"pictures\">\n";
  for (const RunPicture& picture : pictures.list)
    text += report_figure(run.directory, {.stem = picture.stem,
                                          .title = picture.title,
                                          .caption = picture.caption,
                                          .formats = pictures.formats});
  text += "</div>\n";
  if (!pictures.films.empty()) text += pictures.films.size() > 1 ? "<h3>Films</h3>\n" : "<h3>Film</h3>\n";
  for (const Film& one : pictures.films) text += film(one);
  return text;
}

std::string parameters(const RunFiles& run) {
  const std::string rows = parameter_rows(run.spec);
  return rows.empty()
             ? ""
             : "<h2 id=\"parameters\">Parameters</h2>\n<div class=\"scroll\"><table class=\"narrow\"><thead><tr>"
               "<th scope=\"col\">Name</th><th scope=\"col\">Value</th><th scope=\"col\">Meaning</th></tr></thead>\n"
               "<tbody>\n" +
                   rows + "</tbody></table></div>\n";
}

std::string to_cite(const RunFiles& run) {
  const std::string year = run.finished.substr(0, run.finished.find('-'));
  return fmt::format(
      "<h2 id=\"cite\">To cite</h2>\n<p>The program, the method ({}) and the equation ({}). Figures of the width of a "
      "column, as PDF without a title: <code>seiche plot --journal DIR</code>.</p>\n<pre><code>{}</code></pre>\n",
      html_text(run.method_reference), html_text(run.reference),
      html_escaped(software_citation(version(run, "seiche"), version(run, "git"), year)));
}

std::string table_row(const std::string& name, const std::string& value) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", html_escaped(name), value);
}

std::string origin(const RunFiles& run) {
  std::string text =
      "<h2 id=\"origin\">The case, and how to repeat it</h2>\n<p>Put this into a file, or take <code>case.toml</code> from this "
      "folder, and run <code>seiche run case.toml --out DIR</code>. <code>seiche audit DIR</code> computes the energies "
      "anew from the files.</p>\n";
  text += "<pre><code>" + html_escaped(run.case_text) +
          "</code></pre>\n<div class=\"scroll\"><table class=\"narrow\"><tbody>\n";
  text += table_row("problem", html_text(run.reference)) + table_row("method", html_text(run.method_reference));
  for (const auto& [name, count] : run.counts) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    text += table_row(words, fmt::format("{}", count));
  }
  if (run.has_ended) text += table_row("time of the run", fmt::format("{:.3g} s", run.wall_seconds));
  text +=
      "</tbody></table></div>\n<details><summary>Versions</summary><div class=\"scroll\"><table class=\"narrow\"><tbody>\n";
  for (const auto& [what, version] : run.versions) text += table_row(what, html_escaped(version));
  return text + "</tbody></table></div></details>\n";
}

}  // namespace

void write_run_report(const RunFiles& run, const EnergyHistory& history, const RunPictures& pictures,
                      const std::string& no_pictures_because) {
  require_still_unfinished(run);
  AtomicFile file(run.directory / "report.html");
  file.write(head(run));
  file.write(energies(run));
  file.write(pictures_section(run, pictures, no_pictures_because));
  file.write(ledger(run, history));
  file.write(certificate(run));
  file.write(parameters(run));
  file.write(origin(run));
  file.write(to_cite(run));
  file.write("</main>\n</body>\n</html>\n");
  file.commit();
}

}  // namespace seiche
