// One line on a terminal that is drawn over itself, at most ten times per second. NO_COLOR is honoured.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <string_view>

namespace seiche {

class ProgressBar {
 public:
  explicit ProgressBar(std::FILE* terminal);
  // True if stderr is a terminal that may be drawn on.
  static bool is_wanted(bool quiet);

  void begin() { begin_ = Clock::now(); }  // anew: what came before was no work that it shows
  bool is_time_to_draw() const;
  void draw(double share, std::string_view text);  // share: 0 … 1
  void wipe();
  double seconds() const;                     // since `begin`, or since the bar was made
  std::string time_left(double share) const;  // "1:23", guessed from what was done so far

 private:
  using Clock = std::chrono::steady_clock;
  void show(const std::string& text) const;
  std::FILE* terminal_;
  bool colour_;
  Clock::time_point begin_, last_draw_;
  std::size_t width_ = 0;  // of the last line, to be covered by the next
};

}  // namespace seiche
