#include <seiche/core/text/characters.hpp>
#include <seiche/core/text/toml_depth.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace seiche {
namespace {

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  TomlComplaint complaint() {
    while (at_ < text_.size()) {
      if (!step()) return here();
    }
    return {};
  }

 private:
  // Past a text, a comment, or one sign; false where it is the one too many.
  bool step() {
    const char c = text_[at_];
    if (c == '"' || c == '\'') {
      skip_text(c);
      return true;
    }
    if (c == '#') {
      at_ = std::min(text_.find('\n', at_), text_.size());
      return true;
    }
    if (c == '.' && !is_value_ && ++dots_ >= most_key_parts) {
      sentence_ = fmt::format("a key has more than {} parts", most_key_parts);
      return false;
    }
    if (c == '[' || c == '{') {
      is_header_ = is_header_ || (c == '[' && depth_ == 0 && begins_line());
      if (++depth_ > deepest_toml) {
        sentence_ = fmt::format("lists and tables stand in each other more than {} deep", deepest_toml);
        return false;
      }
    } else if ((c == ']' || c == '}') && depth_ > 0) {
      --depth_;
    } else if (c == '\n' && is_header_) {  // which ends with its line
      depth_ = 0;
      is_header_ = false;
    }
    if (c == '=') is_value_ = true;
    if (c == ',' || c == '{' || c == '\n') is_value_ = false;
    if (!may_stand_in_key(c)) dots_ = 0;
    ++at_;
    return true;
  }

  static bool may_stand_in_key(char c) {
    return is_letter(c) || is_digit(c) || std::string_view("_-. \t").find(c) != std::string_view::npos;
  }

  bool begins_line() const {
    std::size_t before = at_;
    while (before > 0 && (text_[before - 1] == ' ' || text_[before - 1] == '\t')) --before;
    return before == 0 || text_[before - 1] == '\n';
  }

  // at_ stands on the first quote. In double quotes a backslash takes the next sign with it.
  void skip_text(char quote) {
    const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
    const bool has_lines = text_.substr(at_, 3) == three;
    at_ += has_lines ? 3 : 1;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '\\' && quote == '"') {
        ++at_;
      } else if (c == '\n' && !has_lines) {
        return;  // a mistake, which the parser names
      } else if (c == quote && !has_lines) {
        ++at_;
        return;
      } else if (c == quote && text_.substr(at_, 3) == three) {
        at_ += 3;
        for (int more = 0; more < 2 && at_ < text_.size() && text_[at_] == quote; ++more) ++at_;  // belong to the text
        return;
      }
    }
    at_ = std::min(at_, text_.size());
  }

  TomlComplaint here() const {
    const std::string_view before = text_.substr(0, at_);
    const std::size_t line_begin = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    const std::string_view line = before.substr(line_begin);
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
    return {.sentence = sentence_,
            .line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1,
            .column = line.size() - static_cast<std::size_t>(std::count_if(line.begin(), line.end(), continues)) + 1};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int dots_ = 0;   // since the last sign that stands in no key
  int depth_ = 0;  // of open brackets
  bool is_header_ = false;
  bool is_value_ = false;  // behind "=", where dots are those of numbers
  std::string sentence_;
};

}  // namespace

TomlComplaint toml_depth_complaint(std::string_view text) { return Scanner(text).complaint(); }

}  // namespace seiche
