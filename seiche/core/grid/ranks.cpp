#include <seiche/core/base/error.hpp>
#include <seiche/core/grid/ranks.hpp>

#include <algorithm>
#include <cstring>
#include <exception>
#include <optional>
#include <vector>

namespace seiche {
namespace {

// numbers ← join of those of all processes, in the order of ranks.
template <class Join>
void reduce(const Ranks& ranks, std::span<double> numbers, const Join& join) {
  thread_local std::vector<Index> counts;  // no step allocates
  thread_local std::vector<double> all;
  const std::size_t k = numbers.size();
  counts.assign(static_cast<std::size_t>(ranks.here().count), static_cast<Index>(k));
  all.resize(counts.size() * k);
  ranks.gather(numbers, counts, all);
  std::copy_n(all.begin(), k, numbers.begin());
  for (std::size_t i = k; i < all.size(); ++i) numbers[i % k] = join(numbers[i % k], all[i]);
}

}  // namespace

void Ranks::sum(std::span<double> numbers) const {
  reduce(*this, numbers, [](double a, double b) { return a + b; });
}

void Ranks::max(std::span<double> numbers) const {
  reduce(*this, numbers, [](double a, double b) { return b <= a ? a : b; });
}

void Ranks::join(const FieldPart& field, std::span<const double> mine,
                 FunctionRef<void(std::span<const double> piece)> take) const {
  constexpr Index longest = Index{1} << 20;
  const auto [index, count] = here();
  std::exception_ptr failure;
  const auto passes = [&](std::span<const double> piece) {
    if (failure) return;
    try {
      take(piece);
    } catch (...) {
      failure = std::current_exception();
    }
  };
  double all = static_cast<double>(mine.size());
  sum({&all, 1});
  const Index fields = static_cast<Index>(all) / field.of;
  std::vector<Index> sent(static_cast<std::size_t>(count)), received(sent);
  std::vector<double> piece;
  for (Index f = 0; f < fields; ++f) {
    for (int rank = 0; rank < count; ++rank) {
      const Index numbers = slab_of(field.units.whole(), {rank, count}).planes * field.plane();
      for (Index at = 0; at < numbers; at += longest) {
        const Index length = std::min(longest, numbers - at);
        const auto part =
            rank == index ? mine.subspan(static_cast<std::size_t>(f * numbers + at), static_cast<std::size_t>(length))
                          : std::span<const double>();
        if (rank == 0) {
          if (index == 0) passes(part);
          continue;
        }
        sent.front() = std::ssize(part);
        received[static_cast<std::size_t>(rank)] = index == 0 ? length : 0;
        piece.resize(static_cast<std::size_t>(index == 0 ? length : 0));
        exchange(part, sent, piece, received);
        received[static_cast<std::size_t>(rank)] = 0;
        if (index == 0) passes(piece);
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
}

std::string Ranks::from_first(const std::string& text) const { return any(here().index == 0 ? text : ""); }

std::string Ranks::any(const std::string& text) const {
  const auto [index, count] = here();
  double highest = text.empty() ? 0 : count - index;  // of those that have one; 0 where none has
  max({&highest, 1});
  if (highest == 0) return "";
  const int rank = count - static_cast<int>(highest);
  double size = index == rank ? static_cast<double>(text.size()) : 0;
  max({&size, 1});
  const auto length = static_cast<std::size_t>(size);
  std::vector<double> packed((length + sizeof(double) - 1) / sizeof(double));  // bits that no one computes with
  std::vector<Index> counts(static_cast<std::size_t>(count), 0);
  counts[static_cast<std::size_t>(rank)] = std::ssize(packed);
  std::vector<double> mine;
  if (index == rank) {
    mine = packed;
    std::memcpy(mine.data(), text.data(), length);
  }
  gather(mine, counts, packed);
  std::string received(length, '\0');
  std::memcpy(received.data(), packed.data(), length);
  return received;
}

void Ranks::together(FunctionRef<void()> action) const {
  std::optional<Error> failure;
  try {
    action();
  } catch (const Error& error) {
    failure = error;
  }
  const std::string sentence = any(failure ? failure->what() : "");
  if (sentence.empty()) return;
  if (failure && failure->what() == sentence) throw Error(*failure);
  throw Error(std::string_view(sentence));
}

void Ranks::on_first(FunctionRef<void()> action) const {
  together([&] {
    if (here().index == 0) action();
  });
}

}  // namespace seiche
