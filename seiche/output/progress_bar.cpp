#include <seiche/output/progress_bar.hpp>

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace seiche {
namespace {

constexpr auto redraw_every = std::chrono::milliseconds(100);
constexpr int bar_width = 30;

bool no_colour() {
  const char* value = std::getenv("NO_COLOR");
  return value && *value != '\0';
}

}  // namespace

ProgressBar::ProgressBar(std::FILE* terminal)
    : terminal_(terminal), colour_(!no_colour()), begin_(Clock::now()), last_draw_(begin_) {}

bool ProgressBar::is_wanted(bool quiet) {
  const char* kind = std::getenv("TERM");
  return !quiet && isatty(STDERR_FILENO) != 0 && !(kind && std::string_view(kind) == "dumb");
}

bool ProgressBar::is_time_to_draw() const { return Clock::now() - last_draw_ >= redraw_every; }

void ProgressBar::draw(double share, std::string_view text) {
  share = std::clamp(share, 0.0, 1.0);
  const int filled = static_cast<int>(share * bar_width);
  const char* bright = colour_ ? "\x1b[32m" : "";
  const char* plain = colour_ ? "\x1b[0m" : "";
  show(fmt::format("\r{:>3.0f} % {}{:━<{}}{}{:<{}} {:<{}}", 100 * share, bright, "", filled, plain, "",
                   bar_width - filled, text, width_));
  width_ = std::max(width_, text.size());
  last_draw_ = Clock::now();
}

void ProgressBar::wipe() {
  if (width_ == 0) return;  // nothing was drawn
  show(fmt::format("\r{:<{}}\r", "", bar_width + 7 + width_));
  width_ = 0;
}

// A terminal that went away must not end the run.
void ProgressBar::show(const std::string& text) const {
  std::fputs(text.c_str(), terminal_);
  std::fflush(terminal_);
}

double ProgressBar::seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

std::string ProgressBar::time_left(double share) const {
  if (share <= 0) return "?";
  const long left = std::lround(std::min(1e9, (1 - share) / share * seconds()));
  if (left >= 3600) return fmt::format("{}:{:02}:{:02}", left / 3600, left / 60 % 60, left % 60);
  return fmt::format("{}:{:02}", left / 60, left % 60);
}

}  // namespace seiche
