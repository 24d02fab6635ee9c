#include <seiche/config/custom/custom_names.hpp>
#include <seiche/config/data/case_value.hpp>
#include <seiche/figure/equation.hpp>
#include <seiche/figure/html.hpp>
#include <seiche/figure/mathml.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <string_view>

namespace seiche {
namespace {

std::string printed(std::string_view text) { return mathml_part(text, Notation::printed); }

std::string line(const std::string& left, const std::string& right) {
  constexpr std::size_t most = 50'000;  // bytes of MathML
  const std::string shown = right.size() > most ? "<mtext>as in the case below</mtext>" : right;
  return fmt::format("<math display=\"block\"><mrow>{}<mo>=</mo>{}</mrow></math>\n", left, shown);
}

// The energy is that of a point, and H the sum over all points.
std::string energy(const std::string& formula, bool has_grid) {
  std::string density = mathml_part(formula, Notation::case_file);
  if (!has_grid) return density;
  return "<munder><mo>∑</mo><mtext>points</mtext></munder><mrow><mo>(</mo>" + density + "<mo>)</mo></mrow>";
}

std::string written_down(const CustomProblem& custom, bool has_grid) {
  const std::vector<std::string> fields = field_names(custom);
  std::string z;
  for (const std::string& field : fields)
    z += (z.empty() ? "" : "<mo>,</mo>") + mathml_part(field, Notation::case_file);
  std::string text = line(printed("ż"), printed(custom.D.empty() ? "S∇H(z)" : "S∇H(z) − Dz") + printed(",  z = ") +
                                            "<mo>(</mo>" + z + "<mo>)</mo>");
  if (custom.H.empty()) {
    text += line(printed("H"), printed("½zᵀMz") + (custom.V.empty() ? "" : "<mo>+</mo>" + energy(custom.V, has_grid)));
    if (!custom.M.empty()) text += line(printed("M"), mathml_matrix(custom.M));
  } else {
    text += line(printed("H"), energy(custom.H, has_grid));
  }
  if (!custom.S.empty()) text += line(printed("S"), mathml_matrix(custom.S));
  if (!custom.D.empty()) text += line(printed("D"), mathml_matrix(custom.D));
  return text;
}

std::string drives(const DriveSpec& spec) {
  std::string text;
  if (spec.friction) {
    std::vector<std::string> parts;
    for (const auto& [key, value] : spec.friction->texts)
      parts.push_back(mathml_part(key, Notation::case_file) + "<mo>=</mo>" + mathml_part(value, Notation::case_file));
    text += fmt::format("<p>Friction: {}, <math><mrow>{}</mrow></math></p>\n", html_escaped(spec.friction->kind),
                        fmt::join(parts, "<mo>,</mo>"));
  }
  for (const auto& [field, formula] : spec.forces)
    text += fmt::format("<p>Force{}: {}</p>\n", field.empty() ? "" : " on " + mathml(field, Notation::case_file),
                        mathml(formula, Notation::case_file));
  return text;
}

bool has_grid(const RunSpec& spec) { return spec.parameter_texts.find("length") != spec.parameter_texts.end(); }

}  // namespace

std::string equation_html(const RunSpec& spec) {
  const std::string equation = spec.custom ? written_down(*spec.custom, has_grid(spec))
                                           : fmt::format("<math display=\"block\"><mrow>{}</mrow></math>\n",
                                                         printed(problem_entry(spec).equation));
  return fmt::format("<div class=\"equation\">\n{}{}</div>\n", equation, drives(spec.drives));
}

std::string parameter_rows(const RunSpec& spec) {
  std::string rows;
  for (const Parameter& parameter : problem_entry(spec).parameters) {
    const auto text = spec.parameter_texts.find(parameter.name);
    if (text == spec.parameter_texts.end() || text->second.empty()) continue;
    using enum ParameterKind;
    const bool is_formula = (parameter.kind == real || parameter.kind == rate || parameter.kind == function) &&
                            !is_toml_number(text->second) && text->second.front() != '[';
    rows += fmt::format("<tr><th scope=\"row\"><code>{}</code></th><td>{}</td><td>{}</td></tr>\n",
                        html_escaped(parameter.name),
                        is_formula ? mathml(text->second, Notation::case_file) : html_text(text->second),
                        html_text(parameter.meaning));
  }
  return rows;
}

}  // namespace seiche
