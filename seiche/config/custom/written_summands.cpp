#include <seiche/config/custom/written_summands.hpp>
#include <seiche/core/text/characters.hpp>
#include <seiche/formula/formula_text.hpp>

namespace seiche {
namespace {

// On one line, with one blank where there is any.
std::string in_a_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (!is_space(c))
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  if (line.ends_with(' ')) line.pop_back();
  return line;
}

bool ends_value(const FormulaToken& token) {
  return token.kind == FormulaToken::Kind::number || token.kind == FormulaToken::Kind::name || token.is(')');
}

}  // namespace

std::vector<WrittenSummand> written_summands(std::string_view formula) {
  const std::vector<FormulaToken> tokens = tokenise_formula(formula);
  std::vector<WrittenSummand> summands;
  int depth = 0;
  std::size_t begin = 0;
  bool is_subtracted = false;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const FormulaToken& token = tokens[i];
    if (token.is('(')) ++depth;
    if (token.is(')')) --depth;
    const bool is_end = token.kind == FormulaToken::Kind::end;
    const bool is_sign = depth == 0 && (token.is('+') || token.is('-')) && (i == 0 || ends_value(tokens[i - 1]));
    if (!is_end && !is_sign) continue;
    if (i > 0) summands.push_back({is_subtracted, in_a_line(formula.substr(begin, token.position - begin))});
    is_subtracted = token.is('-');
    begin = token.position + 1;
  }
  return summands;
}

std::string sum_text(const std::vector<WrittenSummand>& summands) {
  std::string text;
  for (const auto& [is_subtracted, summand] : summands)
    text += (text.empty() ? (is_subtracted ? "-" : "") : (is_subtracted ? " - " : " + ")) +
            (summand.starts_with('-') || summand.starts_with('+') ? "(" + summand + ")" : summand);
  return text.empty() ? "0" : text;
}

}  // namespace seiche
