// The text of a formula cut into tokens, and errors that point into it. Our own, because computer algebra parsers
// report no position, guess at products, and do not end on input of a hostile size.
#pragma once

#include <seiche/core/base/error.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace seiche {

inline constexpr std::size_t longest_formula = 4000;  // bytes

struct FormulaToken {
  enum class Kind { number, name, symbol, end };  // symbol: one of + - * / ^ ( ) ,
  Kind kind;
  std::string_view text;
  std::size_t position;  // in bytes from the start
  double value = 0.0;    // of a number

  bool is(char c) const { return kind == Kind::symbol && text.front() == c; }
  bool starts_value() const { return kind == Kind::number || kind == Kind::name || is('('); }
};

// "formula, column 2: a multiplication sign is missing: write 2*u (in "1 + 2u")", with what stands around the place.
Error formula_error(std::string_view text, std::size_t position, std::string_view sentence);

// Of u[j+1] and u(j+1): which of `names` stands for the difference to the next point, or for a derivative; "" where
// none does.
std::string hint_on_neighbours(std::string_view name, const std::vector<std::string>& names);

// The tokens, an `end` last; they look into `text`, which must outlive them. Throws Error at the first bad character;
// of `names` it gives that hint.
std::vector<FormulaToken> tokenise_formula(std::string_view text, const std::vector<std::string>& names = {});

}  // namespace seiche
