#include <seiche/core/text/characters.hpp>
#include <seiche/figure/html.hpp>
#include <seiche/figure/mathml.hpp>
#include <seiche/formula/formula_function.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace seiche {
namespace {

using Pair = std::pair<std::string_view, std::string_view>;

constexpr std::array<Pair, 33> greek = {
    {{"alpha", "α"},  {"beta", "β"},  {"gamma", "γ"},    {"delta", "δ"}, {"epsilon", "ε"}, {"zeta", "ζ"},
     {"eta", "η"},    {"theta", "θ"}, {"iota", "ι"},     {"kappa", "κ"}, {"lambda", "λ"},  {"mu", "μ"},
     {"nu", "ν"},     {"xi", "ξ"},    {"pi", "π"},       {"rho", "ρ"},   {"sigma", "σ"},   {"tau", "τ"},
     {"phi", "φ"},    {"chi", "χ"},   {"psi", "ψ"},      {"omega", "ω"}, {"Omega", "Ω"},   {"Gamma", "Γ"},
     {"Delta", "Δ"},  {"Theta", "Θ"}, {"Lambda", "Λ"},   {"Sigma", "Σ"}, {"Phi", "Φ"},     {"Psi", "Ψ"},
     {"varphi", "φ"}, {"Pi", "π"},    {"laplacian", "Δ"}}};
constexpr std::array<Pair, 19> raised = {{{"⁰", "0"},
                                          {"¹", "1"},
                                          {"²", "2"},
                                          {"³", "3"},
                                          {"⁴", "4"},
                                          {"⁵", "5"},
                                          {"⁶", "6"},
                                          {"⁷", "7"},
                                          {"⁸", "8"},
                                          {"⁹", "9"},
                                          {"⁻", "−"},
                                          {"⁺", "+"},
                                          {"ᵀ", "T"},
                                          {"ᵏ", "k"},
                                          {"ⁿ", "n"},
                                          {"ᵖ", "p"},
                                          {"ᵐ", "m"},
                                          {"⁽", "("},
                                          {"⁾", ")"}}};
constexpr std::array<Pair, 14> lowered = {{{"₀", "0"},
                                           {"₁", "1"},
                                           {"₂", "2"},
                                           {"₃", "3"},
                                           {"₄", "4"},
                                           {"₅", "5"},
                                           {"₆", "6"},
                                           {"₇", "7"},
                                           {"₈", "8"},
                                           {"₉", "9"},
                                           {"₊", "+"},
                                           {"₋", "−"},
                                           {"ₙ", "n"},
                                           {"ₖ", "k"}}};
constexpr std::array<Pair, 4> fractions = {{{"½", "12"}, {"¼", "14"}, {"¾", "34"}, {"⅓", "13"}}};
constexpr std::array<Pair, 10> accented = {{{"ż", "z\u0307"},
                                            {"ẋ", "x\u0307"},
                                            {"ẏ", "y\u0307"},
                                            {"ṗ", "p\u0307"},
                                            {"ḋ", "d\u0307"},
                                            {"ė", "e\u0307"},
                                            {"ü", "u\u0308"},
                                            {"ẍ", "x\u0308"},
                                            {"ẑ", "z\u0302"},
                                            {"ū", "u\u0304"}}};
constexpr std::array<std::string_view, 4> combining = {"\u0307", "\u0308", "\u0302", "\u0304"};
constexpr const char* partial = "<mi mathvariant=\"normal\">∂</mi>";
constexpr std::string_view operators = "=<>+-−±×∘·≥≤⪰⪯≠→⇒∈,;:";

template <std::size_t n>
std::string_view found(const std::array<Pair, n>& pairs, std::string_view key) {
  const auto pair = std::find_if(pairs.begin(), pairs.end(), [&](const Pair& p) { return p.first == key; });
  return pair == pairs.end() ? std::string_view() : pair->second;
}

std::string tag(std::string_view name, std::string_view inside) { return fmt::format("<{0}>{1}</{0}>", name, inside); }
std::string op(std::string_view sign) { return tag("mo", html_escaped(sign)); }

// Letters of a symbol or an index, each in italics; words and digits upright.
std::string letters(std::string_view text) {
  if (text.size() > 2 && text.find_first_not_of("xyztijk") != std::string_view::npos)
    return tag("mtext", html_escaped(text));
  std::string out;
  for (const char c : text) out += tag(is_digit(c) ? "mn" : "mi", html_escaped(std::string_view(&c, 1)));
  return text.size() == 1 ? out : tag("mrow", out);
}

// In italics, which a browser gives single letters alone, with the accent as the font puts it there.
std::string accented_letter(char letter, std::string_view accent) {
  constexpr unsigned capital = 0x1D434, small = 0x1D44E;  // 𝐴, 𝑎
  const unsigned code =
      letter <= 'Z' ? capital + static_cast<unsigned>(letter - 'A') : small + static_cast<unsigned>(letter - 'a');
  return tag("mi", fmt::format("&#x{:X};{}", letter == 'h' ? 0x210EU : code, accent));
}

// A formula as far as it is typeset: one element; what stands between its parentheses where it is in some; an index
// that is still to be put below it.
struct Part {
  std::string element, inside = {}, below = {};
  bool is_power = false;  // which needs parentheses before it is raised again
  const std::string& bare() const { return inside.empty() ? element : inside; }
};

class Typesetter {
 public:
  Typesetter(std::string_view text, Notation notation) : rest_(text), printed_(notation == Notation::printed) {}

  std::string all() {
    std::string out = sum();
    while (!rest_.empty()) out += op(take()) + sum();  // a parenthesis without its partner
    return out;
  }

 private:
  // The next character, with its following bytes in UTF-8.
  std::string_view next() const {
    std::size_t size = 1;
    while (size < rest_.size() && (static_cast<unsigned char>(rest_[size]) & 0xC0U) == 0x80U) ++size;
    return rest_.substr(0, std::min(size, rest_.size()));
  }
  std::string_view take() {
    const std::string_view character = next();
    rest_.remove_prefix(character.size());
    return character;
  }
  std::size_t skip_blanks() {
    const std::size_t blanks = std::min(rest_.find_first_not_of(" \t\n\r"), rest_.size());
    rest_.remove_prefix(blanks);
    return blanks;
  }
  bool is_operator() const { return !rest_.empty() && operators.find(next()) != std::string_view::npos; }
  bool is_closing() const {
    return rest_.empty() || rest_.front() == ')' || rest_.front() == ']' || rest_.front() == '}' ||
           (in_bars_ && rest_.front() == '|');
  }
  bool begins_function(std::string_view word) const { return find_formula_function(word) != nullptr; }

  std::string sum() {
    std::string out;
    for (skip_blanks(); !is_closing(); skip_blanks()) {
      if (!is_operator()) {
        out += product().element;
        continue;
      }
      const std::string_view sign = take();
      out += op(sign == "-" ? "−" : sign);
      skip_blanks();
      if (!printed_ && !is_closing() && (rest_.front() == '-' || rest_.front() == '+'))
        out += signed_in_parentheses().element;
      if (sign == "," && skip_blanks() > 1) out += "<mspace width=\"1em\"/>";
    }
    return out;
  }

  Part product() {
    Part left = factor();
    for (;;) {
      skip_blanks();
      if (is_closing() || is_operator()) return left;
      if (rest_.front() == '/') {
        take();
        left = {tag("mfrac", tag("mrow", left.bare()) + tag("mrow", factor().bare()))};
      } else if (rest_.front() == '*') {
        take();
        skip_blanks();
        const bool number = !rest_.empty() && is_digit(rest_.front());
        left = {left.element + (number ? op("·") : "<mo>&#x2062;</mo>") + signed_in_parentheses().element};
      } else {
        left = {left.element + factor().element};
      }
    }
  }

  // Behind another factor, or a sign, a sign needs parentheses.
  Part signed_in_parentheses() {
    skip_blanks();
    const bool has_sign = !rest_.empty() && (rest_.front() == '-' || rest_.front() == '+');
    Part part = factor();
    return has_sign ? in_parentheses(part.element) : part;
  }
  static Part in_parentheses(const std::string& element) {
    return {tag("mrow", op("(") + element + op(")")), tag("mrow", element)};
  }

  // With its sign, index and power.
  Part factor() {
    skip_blanks();
    if (!rest_.empty() && (rest_.front() == '-' || rest_.front() == '+')) {
      const std::string sign = op(take() == "-" ? "−" : "+");
      return {tag("mrow", sign + signed_in_parentheses().element)};
    }
    Part base = primary();
    std::string below = std::move(base.below), above;
    while (!rest_.empty()) {
      if (std::find(combining.begin(), combining.end(), next()) != combining.end()) {
        base = {tag("mover", base.element + op(take()))};
      } else if (printed_ && rest_.front() == '_') {
        take();
        below += index();
      } else if (!found(lowered, next()).empty()) {
        below += small(lowered);
      } else if (!found(raised, next()).empty()) {
        above += small(raised);
      } else if (rest_.front() == '^' || rest_.starts_with("**")) {
        rest_.remove_prefix(rest_.front() == '^' ? 1 : 2);
        if (base.is_power) base = in_parentheses(base.element);
        above += exponent();
      } else {
        break;
      }
    }
    if (below.empty() && above.empty()) return base;
    const std::string whole = tag("mrow", base.element), under = tag("mrow", below), over = tag("mrow", above);
    if (above.empty()) return {tag("msub", whole + under)};
    return {below.empty() ? tag("msup", whole + over) : tag("msubsup", whole + under + over)};
  }

  template <std::size_t n>
  std::string small(const std::array<Pair, n>& pairs) {
    std::string out;
    for (std::string_view sign; !rest_.empty() && !(sign = found(pairs, next())).empty(); take()) {
      const char c = sign.front();
      out += is_digit(c) ? tag("mn", sign) : is_letter(c) ? tag("mi", sign) : op(sign);
    }
    return out;
  }

  std::string index() {
    if (!rest_.empty() && rest_.front() == '{') return group('}').inside;
    std::size_t size = 0;
    while (size < rest_.size() && (is_letter(rest_[size]) || is_digit(rest_[size]))) ++size;
    std::string out = letters(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return out;
  }
  std::string exponent() {
    if (!rest_.empty() && rest_.front() == '{') return group('}').inside;
    return factor().bare();
  }

  // From an opening to its closing character.
  Part group(char closing) {
    const std::string open(take());
    const bool was_in_bars = std::exchange(in_bars_, closing == '|');
    const std::string inside = sum();
    in_bars_ = was_in_bars;
    std::string close;
    if (!rest_.empty() && rest_.front() == closing) close = take();
    return {tag("mrow", op(open) + inside + op(close)), tag("mrow", inside)};
  }

  Part primary() {
    if (rest_.empty()) return {""};
    const char c = rest_.front();
    if (c == '(') return group(')');
    if (c == '[') return group(']');
    if (c == '{') return group('}');
    if (c == '|') return {group('|').element};
    if (is_digit(c) || c == '.') return number();
    if (begins_name(c)) return printed_ ? printed_word() : name();
    const std::string_view character = take();
    if (const std::string_view parts = found(fractions, character); !parts.empty())
      return {tag("mfrac", tag("mn", parts.substr(0, 1)) + tag("mn", parts.substr(1)))};
    if (const std::string_view parts = found(accented, character); !parts.empty())
      return {accented_letter(parts.front(), parts.substr(1))};
    if (character == "∂") return {partial};
    if (character == "Σ" || character == "∫" || character == "∇") return {op(character)};
    if (character == "Δ") return {"<mi mathvariant=\"normal\">Δ</mi>"};
    const bool letter = character.size() == 2;  // Greek, of which UTF-8 makes two bytes
    return {tag(letter || character == "ℓ" ? "mi" : "mtext", html_escaped(character))};
  }

  // 12, 0.5, 1e-3 as 10⁻³.
  Part number() {
    std::size_t size = std::min(rest_.find_first_not_of("0123456789."), rest_.size());
    const std::string mantissa(rest_.substr(0, size));
    rest_.remove_prefix(size);
    if (rest_.size() < 2 || (rest_.front() != 'e' && rest_.front() != 'E')) return {tag("mn", mantissa)};
    const std::size_t sign = rest_[1] == '-' || rest_[1] == '+' ? 2 : 1;
    size = std::min(rest_.find_first_not_of("0123456789", sign), rest_.size());
    if (size == sign) return {tag("mn", mantissa)};
    const std::string power = tag("msup", "<mn>10</mn>" + tag("mrow", (rest_[1] == '-' ? op("−") : "") +
                                                                          tag("mn", rest_.substr(sign, size - sign))));
    rest_.remove_prefix(size);
    return {mantissa == "1" ? power : tag("mrow", tag("mn", mantissa) + op("·") + power), {}, {}, true};
  }

  std::string_view word() {
    std::size_t size = 0;
    while (size < rest_.size() &&
           (is_letter(rest_[size]) || (!printed_ && (is_digit(rest_[size]) || rest_[size] == '_'))))
      ++size;
    return rest_.substr(0, size);
  }

  // sin u; a word; or the first of letters that stand for themselves.
  Part printed_word() {
    const std::string_view whole = word();
    if (begins_function(whole)) {
      rest_.remove_prefix(whole.size());
      const char* gap = rest_.starts_with("(") ? "" : "<mspace width=\".17em\"/>";
      return {fmt::format("{}<mi>{}</mi>{}", gap, whole, gap)};
    }
    if (!is_word(whole)) {
      const char letter = take().front();
      if (std::find(combining.begin(), combining.end(), next()) == combining.end())
        return {tag("mi", std::string(1, letter))};
      return {accented_letter(letter, take())};
    }
    std::string words;
    for (std::string_view next = whole; is_word(next); next = word()) {
      words += fmt::format("&#xA0;{}", next);
      rest_.remove_prefix(next.size());
      if (skip_blanks() == 0) return {tag("mtext", words)};
    }
    return {tag("mtext", words + "&#xA0;")};
  }
  static bool is_word(std::string_view text) {
    for (const char* small : {"at", "by", "of", "in", "on"})
      if (text == small) return true;
    return text.size() > 2 && std::all_of(text.begin(), text.end(), [](char c) { return c >= 'a' && c <= 'z'; });
  }

  Part name() {
    const std::string_view whole = word();
    rest_.remove_prefix(std::max<std::size_t>(whole.size(), 1));
    skip_blanks();
    if (rest_.starts_with("(") && begins_function(whole)) {
      if (whole == "abs") {
        const std::string inside = group(')').inside;
        return {tag("mrow", op("|") + inside + op("|"))};
      }
      const Part argument = group(')');
      if (whole == "sqrt") return {tag("msqrt", argument.inside)};
      return {tag("mrow", tag("mi", whole) + argument.element)};
    }
    return symbol(whole);
  }

  // omega_squared, u_xx, a3, kappa, d_x.
  static Part symbol(std::string_view whole) {
    const std::size_t bar = whole.find('_', 1);
    std::string_view base = whole.substr(0, bar);
    std::string_view below = bar == std::string_view::npos ? std::string_view() : whole.substr(bar + 1);
    if (whole == "omega_squared") return {tag("msup", "<mi>ω</mi><mn>2</mn>"), {}, {}, true};
    const std::size_t digits = base.find_last_not_of("0123456789") + 1;
    if (below.empty() && digits > 0 && digits < base.size()) {
      below = base.substr(digits);
      base = base.substr(0, digits);
    }
    const bool derivative = base == "d" && below.find_first_not_of("xyz") == std::string_view::npos && !below.empty();
    return {derivative ? partial : base_symbol(base), {}, below.empty() ? "" : letters(below)};
  }
  static std::string base_symbol(std::string_view base) {
    const std::string_view letter = found(greek, base);
    if (base == "laplacian") return "<mi mathvariant=\"normal\">Δ</mi>";
    return tag("mi", letter.empty() ? html_escaped(base) : std::string(letter));
  }

  std::string_view rest_;
  bool printed_;
  bool in_bars_ = false;
};

}  // namespace

std::string mathml_part(std::string_view text, Notation notation) { return Typesetter(text, notation).all(); }

std::string mathml(std::string_view text, Notation notation) {
  return "<math>" + tag("mrow", mathml_part(text, notation)) + "</math>";
}

std::string mathml_matrix(const std::vector<std::vector<std::string>>& rows) {
  std::string table;
  for (const std::vector<std::string>& row : rows) {
    std::string cells;
    for (const std::string& entry : row) cells += tag("mtd", mathml_part(entry, Notation::case_file));
    table += tag("mtr", cells);
  }
  return "<mtable class=\"matrix\">" + table + "</mtable>";
}

}  // namespace seiche
