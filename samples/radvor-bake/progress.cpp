#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>

namespace bake {
namespace {

volatile std::sig_atomic_t caught_signal = 0;

void on_signal(int number) {
  caught_signal = number;
  std::signal(number, SIG_DFL);
}

constexpr int k_bar_width = 24;
constexpr double k_redraw_seconds = 0.1;

/// 1234567 as "1.2M".
std::string short_number(double value) {
  std::array<char, 32> text{};
  std::size_t unit = 0;
  constexpr std::array<const char*, 5> k_units{"", "k", "M", "G", "T"};
  while (value >= 999.5 && unit + 1 < k_units.size()) {
    value /= 1000;
    ++unit;
  }
  std::snprintf(text.data(), text.size(), unit == 0 || value >= 99.95 ? "%.0f%s" : "%.1f%s", value, k_units[unit]);
  return text.data();
}

std::string short_time(double seconds) {
  std::array<char, 32> text{};
  const auto whole = static_cast<long>(std::min(std::round(seconds), 359999.0));
  if (whole < 60) {
    std::snprintf(text.data(), text.size(), "%ld s", whole);
  } else if (whole < 3600) {
    std::snprintf(text.data(), text.size(), "%ld:%02ld min", whole / 60, whole % 60);
  } else {
    std::snprintf(text.data(), text.size(), "%ld:%02ld h", whole / 3600, whole / 60 % 60);
  }
  return text.data();
}

}  // namespace

StopSignals::StopSignals() {
  caught_signal = 0;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

StopSignals::~StopSignals() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

int StopSignals::caught() noexcept {
  return caught_signal;
}

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

std::int32_t ProgressLine::call(void* self, const radvor_progress* progress) {
  static_cast<ProgressLine*>(self)->show(*progress);
  return StopSignals::caught() != 0 ? 1 : 0;
}

void ProgressLine::show(const radvor_progress& progress) {
  if (quiet_) {
    return;
  }
  if (terminal_) {
    if (progress.seconds - shown_seconds_ >= k_redraw_seconds || shown_seconds_ < 0) {
      shown_seconds_ = progress.seconds;
      drawn_ = true;
      std::fprintf(stderr, "\r%s\033[K", progress_text(progress, true).c_str());
      std::fflush(stderr);
    }
    return;
  }
  const int tenth = static_cast<int>(std::floor(std::clamp(progress.converged, 0.0, 1.0) * 10));
  if (tenth > shown_tenth_) {
    shown_tenth_ = tenth;
    std::fprintf(stderr, "%s\n", progress_text(progress, false).c_str());
  }
}

void ProgressLine::clear() {
  if (drawn_) {
    std::fprintf(stderr, "\r\033[K");
    std::fflush(stderr);
    drawn_ = false;
  }
}

std::string progress_text(const radvor_progress& progress, bool bar) {
  const double converged = std::clamp(progress.converged, 0.0, 1.0);
  std::string text;
  if (bar) {
    const int full = static_cast<int>(converged * k_bar_width);
    text.append("[").append(static_cast<std::size_t>(full), '#');
    text.append(static_cast<std::size_t>(k_bar_width - full), '.').append("] ");
  }
  std::array<char, 32> percent{};
  std::snprintf(percent.data(), percent.size(), "%5.1f %%", 100 * converged);
  text += percent.data();
  text += "  " + short_number(static_cast<double>(progress.rays)) + " rays  " +
          short_number(static_cast<double>(progress.sites)) + " sites  " + short_time(progress.seconds);
  if (converged > 0.02 && converged < 1) {  // before that the guess is worth nothing
    text += ", " + short_time(progress.seconds * (1 - converged) / converged) + " left";
  }
  return text;
}

}  // namespace bake
