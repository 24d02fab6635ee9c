#include <seiche/study/spectrum.hpp>
#include <seiche/study/spectrum_output.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

namespace seiche {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t shown_rows = 48;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json mode_json(const SpectrumRow* row) {
  if (row == nullptr) return nullptr;
  return {{"mode", row->mode},
          {"damping_error", number(row->damping_error())},
          {"exact_decay", number(row->exact_decay)},
          {"numerical_decay", number(row->numerical_decay)}};
}

// What was measured, and on what.
std::string premise(const Spectrum& s) {
  std::string text = fmt::format("The linear part of {}", s.problem);
  if (s.has_potential) text += ", without V";
  if (s.has_drives) text += ", without friction beyond its linear part, forces and what of S changes with z";
  if (s.rates_at_start) text += ", with γ as it is at t = 0";
  text += fmt::format(": one step of {} with h = {:g} (backend {})", s.method, s.h, s.backend);
  if (!s.is_homogeneous) {
    text += "; the step is not homogeneous in z: rates are those of single modes of norm 1";
  } else if (!s.is_linear) {
    text += "; the step is nonlinear in z: rates are those of single modes";
  }
  return text + ".\n";
}

std::string line_of(const SpectrumRow& row) {
  const auto phase = row.phase_error();
  return fmt::format("{:<12} {:>13.6g} {:>13.6g} {:>11.3g} {:>13.6g} {:>13.6g} {:>11}{}\n", row.mode, row.exact_decay,
                     row.numerical_decay, row.damping_differs() ? row.damping_error() : 0.0, row.exact_frequency,
                     row.numerical_frequency, phase ? fmt::format("{:.3g}", *phase) : "–",
                     row.aliased ? "  aliased" : "");
}

std::string compared(const SpectrumRow& row) {
  return fmt::format("{:.3g} at mode {} ({:.6g} instead of {:.6g})", std::abs(row.damping_error()), row.mode,
                     row.numerical_decay, row.exact_decay);
}

bool nothing_happens(const std::vector<SpectrumRow>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const SpectrumRow& row) {
    const double largest = std::max({std::abs(row.exact_decay), std::abs(row.numerical_decay), row.exact_frequency,
                                     std::abs(row.numerical_frequency)});
    return row.resolved && largest <= row.round_off;
  });
}

// The rows of each mode, one after the other: two or more where it has several rates.
std::vector<std::span<const SpectrumRow>> by_mode(const std::vector<SpectrumRow>& rows) {
  std::vector<std::span<const SpectrumRow>> modes;
  for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
    while (end < rows.size() && rows[end].mode == rows[begin].mode) ++end;
    modes.emplace_back(rows.data() + begin, end - begin);
  }
  return modes;
}

bool is_undamped(const SpectrumRow* row) { return row != nullptr && row->exact_decay <= row->round_off; }

}  // namespace

std::string spectrum_sentence(const Spectrum& spectrum) {
  const SpectrumVerdict verdict = judge(spectrum);
  std::string text;
  if (verdict.unresolved > 0)
    text += fmt::format(
        "Of {} of {} modes one step leaves no more than round-off: their rates are not known, and a smaller h would show "
        "them.\n",
        verdict.unresolved, spectrum.rows.size());
  if (verdict.is_physical()) {
    text += fmt::format(
        "The damping is physical: every mode decays at the rate of the equation, to round-off ({:.1g} at most).\n",
        verdict.round_off);
  } else {
    text += verdict.most_spurious ? fmt::format("Largest spurious damping: {}.\n", compared(*verdict.most_spurious))
                                  : std::string("No mode decays faster than in the equation.\n");
    if (verdict.most_missing) text += fmt::format("Largest missing damping: {}.\n", compared(*verdict.most_missing));
    if (verdict.most_missing && verdict.most_missing->numerical_decay < -verdict.most_missing->round_off)
      text += fmt::format("Mode {} grows: the steps are not stable.\n", verdict.most_missing->mode);
    text += verdict.worst_relative ? fmt::format("The damping is physical to within {:.3g} %, as mode {} shows{}.\n",
                                                 100 * verdict.relative, verdict.worst_relative->mode,
                                                 is_undamped(verdict.most_spurious) || is_undamped(verdict.most_missing)
                                                     ? "; modes without damping are not in this number"
                                                     : "")
                                   : std::string("No damped mode decays otherwise than in the equation.\n");
  }
  if (verdict.worst_phase)
    text += fmt::format("Largest relative error of a frequency: {:.3g} at mode {}.\n",
                        *verdict.worst_phase->phase_error(), verdict.worst_phase->mode);
  if (verdict.aliased > 0)
    text += fmt::format(
        "{} of {} modes turn by more than half a circle in a step: their numerical frequencies are known modulo 2π/h, and "
        "the one next to the exact one is given.\n",
        verdict.aliased, spectrum.rows.size());
  return text;
}

std::string spectrum_table(const Spectrum& spectrum) {
  const std::vector<SpectrumRow>& rows = spectrum.rows;
  if (nothing_happens(rows))
    return premise(spectrum) +
           "It neither damps nor turns: all its rates are zero, in the equation and in the step, and there is nothing to "
           "compare.\n";
  std::string text = premise(spectrum) + "\n";
  fmt::format_to(std::back_inserter(text), "{:<12} {:>13} {:>13} {:>11} {:>13} {:>13} {:>11}\n", "mode", "decay",
                 "numerical", "difference", "frequency", "numerical", "phase error");
  const SpectrumVerdict verdict = judge(spectrum);
  const std::vector<std::span<const SpectrumRow>> modes = by_mode(rows);
  const std::size_t per_mode = (rows.size() + modes.size() - 1) / modes.size();
  const std::size_t shown = shown_rows / std::min(per_mode, shown_rows);
  const std::size_t stride = (modes.size() + shown - 1) / shown;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const bool named = std::any_of(modes[i].begin(), modes[i].end(), [&](const SpectrumRow& row) {
      return &row == verdict.most_spurious || &row == verdict.most_missing || &row == verdict.worst_phase ||
             &row == verdict.worst_relative;
    });
    if (i % stride != 0 && i + 1 != modes.size() && !named) continue;
    for (const SpectrumRow& row : modes[i]) text += line_of(row);
  }
  if (stride > 1)
    text += fmt::format("one of {} modes in each {}, and the worst; --out and --json give all\n", modes.size(), stride);
  return text + "\n" + spectrum_sentence(spectrum);
}

std::string spectrum_json(const Spectrum& spectrum) {
  const SpectrumVerdict verdict = judge(spectrum);
  Json modes = Json::array();
  for (const SpectrumRow& row : spectrum.rows) {
    const auto phase = row.phase_error();
    modes.push_back({{"mode", row.mode},
                     {"exact_decay", number(row.exact_decay)},
                     {"numerical_decay", number(row.numerical_decay)},
                     {"damping_error", number(row.damping_error())},
                     {"exact_frequency", number(row.exact_frequency)},
                     {"numerical_frequency", number(row.numerical_frequency)},
                     {"phase_error", phase ? number(*phase) : Json(nullptr)},
                     {"aliased", row.aliased},
                     {"round_off", number(row.round_off)}});
  }
  const Json document = {{"problem", spectrum.problem},
                         {"method", spectrum.method},
                         {"backend", spectrum.backend},
                         {"h", spectrum.h},
                         {"potential_left_out", spectrum.has_potential},
                         {"drives_left_out", spectrum.has_drives},
                         {"rates_at_start", spectrum.rates_at_start},
                         {"homogeneous", spectrum.is_homogeneous},
                         {"linear", spectrum.is_linear},
                         {"verdict",
                          {{"physical_to_round_off", verdict.is_physical()},
                           {"unresolved_modes", verdict.unresolved},
                           {"largest_spurious_damping", mode_json(verdict.most_spurious)},
                           {"largest_missing_damping", mode_json(verdict.most_missing)},
                           {"largest_relative_error", verdict.worst_relative ? number(verdict.relative) : Json(0.0)},
                           {"largest_phase_error",
                            verdict.worst_phase ? number(*verdict.worst_phase->phase_error()) : Json(nullptr)},
                           {"aliased_modes", verdict.aliased},
                           {"sentence", spectrum_sentence(spectrum)}}},
                         {"modes", std::move(modes)}};
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string spectrum_csv(const Spectrum& spectrum) {
  std::string text =
      "mode,exact_decay,numerical_decay,damping_error,exact_frequency,numerical_frequency,phase_error,aliased,"
      "round_off\n";
  for (const SpectrumRow& row : spectrum.rows) {
    std::string mode = row.mode;  // "(3, -1)" in one cell
    std::erase_if(mode, [](char c) { return c == '(' || c == ')' || c == ','; });
    const auto phase = row.phase_error();
    fmt::format_to(std::back_inserter(text), "{},{},{},{:.6g},{},{},{},{},{:.3g}\n", mode, row.exact_decay,
                   row.numerical_decay, row.damping_error(), row.exact_frequency, row.numerical_frequency,
                   phase ? fmt::format("{:.6g}", *phase) : "", row.aliased ? 1 : 0, row.round_off);
  }
  return text;
}

}  // namespace seiche
