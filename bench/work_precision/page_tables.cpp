#include <bench/work_precision/page_tables.hpp>
#include <seiche/figure/html.hpp>
#include <seiche/figure/style.hpp>

#include <fmt/format.h>

#include <cmath>

namespace seiche::bench {
namespace {

struct Best {
  const Curve* curve = nullptr;
  double seconds = Row::unknown;
};

// Of Seiche's methods, only those count that kept their law, where there is one.
Best best_of(const ProblemResult& result, const std::vector<Curve>& curves, Origin origin, double error) {
  Best best;
  for (const Curve& curve : curves) {
    if (curve.origin != origin) continue;
    if (origin == Origin::seiche && result.law_holds && energy_law(curve).runs_with_rise > 0) continue;
    const double seconds = seconds_to_reach(curve, error);
    if (!std::isnan(seconds) && (!best.curve || seconds < best.seconds)) best = {&curve, seconds};
  }
  return best;
}

std::string label(const Curve& curve) { return curve.origin == Origin::seiche ? method_label(curve.peer) : curve.peer; }

std::string ratio_to(double seconds, double ours) {
  if (std::isnan(seconds) || std::isnan(ours)) return "";
  const double ratio = seconds / ours;
  return fmt::format(" <span class=\"{}\">({})</span>", ratio < 1 ? "bad" : "order",
                     ratio < 10 ? fmt::format("{:.2f}", ratio) : fmt::format("{:.0f}", ratio));
}

std::string law_cell(const ProblemResult& result, const Curve& curve) {
  const EnergyLaw law = energy_law(curve);
  if (law.runs == 0) return "no solved run";
  if (!result.law_holds) {
    return law.runs_with_rise == 0 ? "none to keep; no rise"
                                   : fmt::format("none to keep; rises in {} of {} runs", law.runs_with_rise, law.runs);
  }
  if (law.runs_with_rise == 0) {
    return fmt::format("<span class=\"outcome holds\">kept{}</span> {} runs", law.own ? " (modified energy)" : "",
                       law.runs);
  }
  return fmt::format("<span class=\"outcome fails\">broken</span> in {} of {} runs, up to {} rises", law.runs_with_rise,
                     law.runs, law.most_rises);
}

// H itself, which an integrator with an energy of its own does not promise.
std::string energy_cell(const Curve& curve) {
  const EnergyLaw law = energy_law(curve);
  if (law.runs == 0) return "";
  return law.runs_where_H_rose == 0 ? "never rose"
                                    : fmt::format("rose in {} of {} runs", law.runs_where_H_rose, law.runs);
}

// For the summary, where there is a law: that an integrator broke it on the way.
std::string law_mark(const ProblemResult& result, const Curve& curve) {
  return result.law_holds && energy_law(curve).runs_with_rise > 0 ? ", law broken" : "";
}

std::string head_of_errors() {
  std::string text;
  for (const double error : wanted_errors)
    text += "<th scope=\"col\">" + html_text(fmt::format("{:.0e}", error)) + "</th>";
  return text;
}

}  // namespace

std::string summary_table(const std::vector<ProblemResult>& results) {
  std::string text = "<div class=\"scroll\"><table class=\"numbers\"><thead><tr><th scope=\"col\">Problem</th>" +
                     head_of_errors() + "</tr></thead>\n<tbody>\n";
  for (const ProblemResult& result : results) {
    const std::vector<Curve> curves = curves_of(result);
    text += fmt::format("<tr class=\"group\"><th colspan=\"{}\" scope=\"colgroup\"><a href=\"#{}\">{}</a></th></tr>\n",
                        wanted_errors.size() + 1, result.test.key, html_escaped(result.test.title));
    const std::pair<Origin, const char*> origins[] = {{Origin::seiche, "Seiche’s fastest, energy law kept"},
                                                      {Origin::packaged, "packaged library’s fastest"},
                                                      {Origin::hand_written, "hand-written code’s fastest"}};
    for (const auto& [origin, name] : origins) {
      text +=
          fmt::format("<tr><th scope=\"row\"{}>{}</th>", origin == Origin::seiche ? " class=\"proposed\"" : "", name);
      for (const double error : wanted_errors) {
        const Best best = best_of(result, curves, origin, error);
        const double ours = best_of(result, curves, Origin::seiche, error).seconds;
        text += fmt::format("<td>{}{}{}</td>", html_number(best.seconds),
                            origin == Origin::seiche ? "" : ratio_to(best.seconds, ours),
                            best.curve ? "<br><span class=\"source\">" + html_escaped(label(*best.curve)) +
                                             law_mark(result, *best.curve) + "</span>"
                                       : "");
      }
      text += "</tr>\n";
    }
  }
  return text + "</tbody></table></div>\n";
}

std::string reach_table(const ProblemResult& result) {
  const std::vector<Curve> curves = curves_of(result);
  std::string text =
      "<h3>Seconds to reach an error</h3>\n<div class=\"scroll\"><table class=\"numbers\"><thead><tr><th scope=\"col\">Integrator</th>" +
      head_of_errors() +
      "<th scope=\"col\" class=\"words\">energy law</th><th scope=\"col\" class=\"words\">H</th></tr></thead>\n<tbody>\n";
  std::string group;
  for (const Curve& curve : curves) {
    const std::string name(to_string(curve.origin));
    if (name != group) {
      group = name;
      text += fmt::format("<tr class=\"group\"><th colspan=\"{}\" scope=\"colgroup\">{}</th></tr>\n",
                          wanted_errors.size() + 3, curve.origin == Origin::seiche ? "Seiche" : name);
    }
    text += "<tr><th scope=\"row\">" + html_escaped(label(curve)) + "</th>";
    for (const double error : wanted_errors) {
      const double seconds = seconds_to_reach(curve, error);
      const Best ours = best_of(result, curves, Origin::seiche, error);
      text += fmt::format("<td{}>{}{}</td>", ours.curve == &curve ? " class=\"best\"" : "", html_number(seconds),
                          ratio_to(seconds, ours.seconds));
    }
    const bool refused = curve.rows.front()->status == Status::refused;
    text += "<td class=\"words\">" + (refused ? html_text(curve.rows.front()->message) : law_cell(result, curve)) +
            "</td><td class=\"words\">" + energy_cell(curve) + "</td></tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string run_table(const ProblemResult& result) {
  std::string text =
      "<div class=\"scroll\"><table class=\"numbers\"><thead><tr><th scope=\"col\">Integrator</th><th scope=\"col\">h or tolerance</th>"
      "<th scope=\"col\">CPU s</th><th scope=\"col\">runs</th><th scope=\"col\">set-up s</th><th scope=\"col\">error</th>"
      "<th scope=\"col\">energy error</th><th scope=\"col\">steps</th><th scope=\"col\">evaluations</th>"
      "<th scope=\"col\">rises of H</th><th scope=\"col\">readings</th><th scope=\"col\" class=\"words\">status</th></tr></thead>\n<tbody>\n";
  const auto count = [](std::int64_t value) { return value < 0 ? std::string("—") : fmt::format("{}", value); };
  for (const Curve& curve : curves_of(result)) {
    for (const Row* row : curve.rows) {
      const std::string status =
          std::string(to_string(row->status)) + (row->message.empty() ? "" : ": " + row->message);
      text += fmt::format(
          "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
          "<td>{}</td><td>{}</td><td class=\"words\">{}</td></tr>\n",
          html_escaped(label(curve)), html_number(row->parameter), html_number(row->cpu_seconds), row->repeats,
          html_number(row->setup_seconds), html_number(row->error), html_number(row->energy_error),
          count(row->work.steps), count(row->work.evaluations), row->energy_rises, row->energy_points,
          html_text(status));
    }
  }
  return text + "</tbody></table></div>\n";
}

}  // namespace seiche::bench
