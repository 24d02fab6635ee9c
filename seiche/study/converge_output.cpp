#include <seiche/study/converge.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iterator>

namespace seiche {

std::string converge_json(const Convergence& study) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const StudyRow& row : study.rows) {
    nlohmann::ordered_json entry = {{"method", row.method},
                                    {"h", row.h},
                                    {"error", row.error},
                                    {"energy_error", row.energy_error},
                                    {"max_energy_increase", row.max_energy_increase},
                                    {"max_modified_increase", row.max_modified_increase},
                                    {"order",
                                     row.order ? nlohmann::ordered_json(*row.order) : nlohmann::ordered_json(nullptr)},
                                    {"scalar_iterations", row.scalar_iterations},
                                    {"fallbacks", row.fallbacks},
                                    {"replaced", row.replaced},
                                    {"unresolved", row.unresolved},
                                    {"steps", row.steps},
                                    {"cpu_seconds", row.cpu_seconds},
                                    {"energy_law_held", row.energy_law_held}};
    if (!row.failure.empty()) entry["failure"] = row.failure;
    rows.push_back(std::move(entry));
  }
  const nlohmann::ordered_json document = {{"problem", study.problem},
                                           {"reference", study.reference},
                                           {"reference_error", study.reference_error},
                                           {"rows", std::move(rows)}};
  return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string converge_table(const Convergence& study) {
  std::string text = fmt::format("{}, errors against {}\n\n", study.problem, study.reference);
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:<8} {:>11} {:>11} {:>6} {:>11} {:>11} {:>10} {:>10} {:>10}\n", "method", "h", "error", "order",
                 "|ΔH|", "max ΔH", "iterations", "fallbacks", "CPU [ms]");
  const std::string* method = nullptr;
  for (const StudyRow& row : study.rows) {
    if (method && *method != row.method) text += '\n';
    method = &row.method;
    fmt::format_to(out, "{:<8} {:>11.5g} {:>11.3e} {:>6} {:>11.3e} {:>11.3e} {:>10} {:>10} {:>10.3f}{}{}{}\n",
                   row.method, row.h, row.error, row.order ? fmt::format("{:.2f}", *row.order) : "–", row.energy_error,
                   row.max_energy_increase, row.scalar_iterations, row.fallbacks, 1e3 * row.cpu_seconds,
                   row.replaced > 0 ? fmt::format("  {} of {} steps replaced", row.replaced, row.steps) : "",
                   row.unresolved > 0 ? fmt::format("  {} unresolved", row.unresolved) : "",
                   row.failure.empty() ? "" : "  " + row.failure);
  }
  return text;
}

}  // namespace seiche
