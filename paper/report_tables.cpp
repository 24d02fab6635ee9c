#include <paper/report_tables.hpp>
#include <seiche/figure/curves.hpp>
#include <seiche/figure/html.hpp>
#include <seiche/figure/style.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seiche {
namespace {

const StudyRow* find_row(const ExampleResult& example, const std::string& method, double h) {
  for (const StudyRow& row : example.rows) {
    if (row.method == method && row.h == h) return &row;
  }
  return nullptr;
}

// The dash and the marker of the figures, so that tables and figures can be read together.
std::string swatch(const std::string& method) {
  const LineStyle line = method_line(method);
  const std::string shape = [&] {
    switch (line.marker) {
      case Marker::square: return R"(<rect x="11" y="4" width="8" height="8")";
      case Marker::triangle: return R"(<path d="M15 3L20 12H10Z")";
      case Marker::triangle_down: return R"(<path d="M15 13L20 4H10Z")";
      case Marker::diamond: return R"(<path d="M15 3L20 8L15 13L10 8Z")";
      case Marker::pentagon: return R"(<path d="M15 3L20 7L18 12H12L10 7Z")";
      case Marker::star: return R"(<path d="M15 3V13M10.5 5.5L19.5 10.5M19.5 5.5L10.5 10.5")";
      case Marker::none:
      case Marker::circle: return R"(<circle cx="15" cy="8" r="4.5")";
    }
    return "";
  }();
  const char* dashes = line.dash == Dash::solid    ? "none"
                       : line.dash == Dash::dashed ? "4 2"
                       : line.dash == Dash::dotted ? "1 3"
                                                   : "5 2 1 2";
  return fmt::format(
      R"(<svg class="swatch" viewBox="0 0 30 16" width="30" height="16" aria-hidden="true" stroke="{0}"><path d="M1 8H29" stroke-width="{1}" stroke-dasharray="{2}"/>{3} fill="{4}" stroke-width="1.4"/></svg>)",
      line.colour, line.width > 1 ? 2.4 : 1.4, dashes, shape, line.filled ? line.colour : "#fff");
}

std::string method_cell(const std::string& method) {
  const MethodStyle* style = find_method_style(method);
  return fmt::format(R"(<th scope="row"{}>{}{}</th>)", style && style->proposed ? R"( class="proposed")" : "",
                     swatch(method), html_escaped(method_label(method)));
}

std::string order_text(const StudyRow& row) {
  return row.order && std::isfinite(*row.order) ? fmt::format("{:.2f}", *row.order) : "";
}

double smallest_error(const ExampleResult& example, double h) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const StudyRow& row : example.rows) {
    if (row.h == h && row.failure.empty() && std::isfinite(row.error)) smallest = std::min(smallest, row.error);
  }
  return smallest;
}

// The largest h has nothing to compare with.
bool has_orders(const ExampleResult& example, double h) {
  return std::any_of(example.rows.begin(), example.rows.end(),
                     [&](const StudyRow& row) { return row.h == h && !order_text(row).empty(); });
}

std::string error_cells(const ExampleResult& example, const std::string& method, double h) {
  const StudyRow* row = find_row(example, method, h);
  const bool failed = row && !row->failure.empty();
  std::string text;
  if (!row || failed) {
    text = failed ? R"(<td class="bad">failed</td>)" : "<td>—</td>";
  } else {
    const bool best = row->error == smallest_error(example, h);
    text = fmt::format("<td{}>{}{}</td>", best ? R"( class="best")" : "", html_number(row->error),
                       row->unresolved > 0 ? "<sup>†</sup>" : "");
  }
  if (!has_orders(example, h)) return text;
  return text + fmt::format(R"(<td class="order">{}</td>)", row && !failed ? order_text(*row) : "");
}

// What the numbers alone do not say.
std::string notes(const ExampleResult& example) {
  std::string text;
  for (const StudyRow& row : example.rows) {
    const std::string who = fmt::format("{} at h = {}", html_escaped(method_label(row.method)), step_text(row.h));
    if (!row.failure.empty()) {
      text += fmt::format("<li>{} did not reach the end: {}</li>", who, html_text(row.failure));
    } else if (row.unresolved > 0) {
      text += fmt::format("<li><sup>†</sup> {}: in {} of {} steps the scalar equation was not solved</li>", who,
                          row.unresolved, row.steps);
    }
  }
  return text.empty() ? "" : "<ul class=\"notes\">" + text + "</ul>\n";
}

}  // namespace

std::string outcome_mark(Outcome outcome) {
  const auto mark = [&](const char* name, const char* symbol) {
    return fmt::format(R"(<span class="outcome {}"><span aria-hidden="true">{}</span> {}</span>)", name, symbol,
                       html_escaped(to_string(outcome)));
  };
  // The text variant of each symbol, where fonts also have a coloured picture.
  switch (outcome) {
    case Outcome::holds: return mark("holds", "✓\uFE0E");
    case Outcome::does_not_hold: return mark("fails", "✗\uFE0E");
    case Outcome::depends: return mark("depends", "≈");
  }
  return "";
}

namespace {

// With a link to the figure of the paper that it names, where that is drawn here.
std::string source_text(const std::string& source, const FigureAnchors& figures) {
  for (const auto& [number, anchor] : figures)
    if (source.starts_with(number))
      return fmt::format("<a href=\"#{}\">{}</a>{}", anchor, html_escaped(number),
                         html_text(source.substr(number.size())));
  return html_text(source);
}

}  // namespace

std::string verdict_table(const std::vector<Verdict>& verdicts, const FigureAnchors& figures) {
  if (verdicts.empty()) return "<p>No claim was judged in this run.</p>\n";
  std::vector<std::string> groups;
  for (const Verdict& verdict : verdicts) {
    if (std::find(groups.begin(), groups.end(), verdict.example) == groups.end()) groups.push_back(verdict.example);
  }
  std::string text =
      "<div class=\"scroll\"><table class=\"verdicts\">\n<thead><tr><th scope=\"col\">Verdict</th>"
      "<th scope=\"col\">Claim of the paper</th><th scope=\"col\">Measured here</th></tr></thead>\n";
  for (const std::string& group : groups) {
    text += fmt::format("<tbody><tr class=\"group\"><th scope=\"rowgroup\" colspan=\"3\">{}</th></tr>\n",
                        html_escaped(group == "all" ? "All examples" : group));
    for (const Verdict& verdict : verdicts) {
      if (verdict.example != group) continue;
      text +=
          fmt::format("<tr><td>{}</td><td>{}<div class=\"source\">{}</div></td><td>{}{}</td></tr>\n",
                      outcome_mark(verdict.outcome), html_text(verdict.claim), source_text(verdict.source, figures),
                      html_text(verdict.measured),
                      verdict.remark.empty() ? "" : "<div class=\"remark\">" + html_text(verdict.remark) + "</div>");
    }
    text += "</tbody>\n";
  }
  return text + "</table></div>\n";
}

std::string error_table(const ExampleResult& example) {
  std::string head;
  std::string subhead;
  for (const double h : example.step_sizes) {
    const bool orders = has_orders(example, h);
    head += fmt::format(R"(<th scope="colgroup" colspan="{}">h = {}</th>)", orders ? 2 : 1, step_text(h));
    subhead += orders ? R"(<th scope="col">error</th><th scope="col">order</th>)" : R"(<th scope="col">error</th>)";
  }
  std::string text = fmt::format(
      "<div class=\"scroll\"><table class=\"numbers\">\n<thead><tr><th scope=\"col\" rowspan=\"2\">Method</th>{}</tr>"
      "<tr>{}</tr></thead>\n<tbody>\n",
      head, subhead);
  for (const std::string& method : example.methods) {
    text += "<tr>" + method_cell(method);
    for (const double h : example.step_sizes) text += error_cells(example, method, h);
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n" + notes(example);
}

std::string record_table(const ExampleResult& example) {
  std::string text =
      "<div class=\"scroll\"><table class=\"numbers\">\n<thead><tr><th scope=\"col\">Method</th><th scope=\"col\">h</th>"
      "<th scope=\"col\">steps</th><th scope=\"col\">CPU time (s)</th><th scope=\"col\">energy error</th>"
      "<th scope=\"col\">largest change of H in a step</th><th scope=\"col\">of its own energy</th>"
      "<th scope=\"col\">energy law</th><th scope=\"col\">iterations per step</th><th scope=\"col\">fallbacks</th>"
      "<th scope=\"col\">unsolved</th></tr></thead>\n<tbody>\n";
  for (const std::string& method : example.methods) {
    for (const double h : example.step_sizes) {
      const StudyRow* row = find_row(example, method, h);
      if (!row || !row->failure.empty()) continue;
      const double per_step =
          row->steps > 0 ? static_cast<double>(row->scalar_iterations) / static_cast<double>(row->steps) : 0.0;
      text += fmt::format(
          "<tr>{}<td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.2f}</td><td>{}</td>"
          "<td>{}</td></tr>\n",
          method_cell(method), step_text(h), row->steps, row->cpu_seconds > 0 ? html_number(row->cpu_seconds) : "—",
          html_number(row->energy_error), html_number(row->max_energy_increase),
          html_number(row->max_modified_increase), row->energy_law_held ? "held" : "not held", per_step, row->fallbacks,
          row->unresolved);
    }
  }
  return text + "</tbody></table></div>\n";
}

}  // namespace seiche
