#include <seiche/core/base/error.hpp>
#include <seiche/core/base/shortened.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace seiche {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

// Optimal string alignment distance: insert, delete, replace, or swap two neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> two_back;
  std::vector<std::size_t> back(b.size() + 1);
  std::iota(back.begin(), back.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row(b.size() + 1);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool equal = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({back[j] + 1, row[j - 1] + 1, back[j - 1] + (equal ? 0U : 1U)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], two_back[j - 2] + 1);
    }
    two_back = std::move(back);
    back = std::move(row);
  }
  return back[b.size()];
}

// Of names of one or two letters every other one is near, but for the order, number and case of their letters.
bool same_letters(std::string_view a, std::string_view b) {
  const auto has_all = [](std::string_view some, std::string_view all) {
    return std::all_of(some.begin(), some.end(), [&](char x) {
      return std::any_of(all.begin(), all.end(), [x](char y) { return lower(x) == lower(y); });
    });
  };
  return has_all(a, b) && has_all(b, a);
}

std::size_t farthest_help(std::string_view wanted) {
  return wanted.size() <= 3 ? 1 : std::max<std::size_t>(2, wanted.size() / 2);
}

std::string text_of(const ErrorParts& parts) {
  return parts.place.empty() ? parts.sentence : fmt::format("{}: {}", parts.place, parts.sentence);
}

}  // namespace

Error::Error(ErrorParts parts)
    : std::runtime_error(text_of(parts)), parts_(std::make_shared<const ErrorParts>(std::move(parts))) {}

Error Error::at(std::string_view place) const {
  ErrorParts parts = *parts_;
  parts.place = place;
  return Error(std::move(parts));
}

Error Error::under(std::string_view key) const {
  if (!parts_->sentence.starts_with(key)) return *this;
  ErrorParts parts = *parts_;
  parts.key = key;
  return Error(std::move(parts));
}

std::string nearest_name(std::string_view wanted, const std::vector<std::string>& names) {
  std::string best;
  constexpr std::size_t longest = 1000;  // longer is no misspelling, and the effort is that of all pairs of letters
  if (wanted.size() > longest) return best;
  std::size_t best_distance = farthest_help(wanted);
  for (const std::string& name : names) {
    if (wanted.size() <= 2 && !same_letters(wanted, name)) continue;
    const std::size_t distance = edit_distance(wanted, name);
    if (distance < best_distance || (best.empty() && distance == best_distance)) {
      best = name;
      best_distance = distance;
    }
  }
  return best;
}

Error unknown_name(std::string_view what, std::string_view wanted, const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(wanted, names);
  const std::string hint = nearest.empty() ? "." : fmt::format("; did you mean '{}'?", nearest);
  return Error(
      {.sentence = fmt::format("unknown {} '{}'{} Allowed: {}", what, shortened(wanted), hint, fmt::join(names, ", ")),
       .kind = std::string(what),
       .name = shortened(wanted),
       .nearest = nearest,
       .allowed = names});
}

}  // namespace seiche
