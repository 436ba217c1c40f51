#include "terminal/progress_display.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "session/text/text.h"
#include "session/text/time_left.h"
#include "terminal/signals.h"

namespace scarp::cli {
namespace {

constexpr double kQuietSeconds = 1.0;
constexpr double kMinInterval = 0.2;

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

std::size_t terminal_width() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

std::string format_duration(double seconds) {
  const auto whole = static_cast<std::uint64_t>(seconds + 0.5);
  const std::uint64_t hours = whole / 3600, minutes = whole / 60 % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                   : fmt::format("{}:{:02}", minutes, whole % 60);
}

}  // namespace

ProgressDisplay::ProgressDisplay(Style style)
    : style_(style), start_(Clock::now()), pass_start_(start_), last_shown_(start_) {}

ProgressDisplay::~ProgressDisplay() { erase_line(); }

ProgressDisplay::Style ProgressDisplay::choose(bool json, bool quiet) {
  if (json) return Style::kJson;
  return !quiet && isatty(STDERR_FILENO) == 1 ? Style::kLine : Style::kSilent;
}

ProgressCallback ProgressDisplay::callback() {
  return [this](const Progress& progress) { return show(progress); };
}

bool ProgressDisplay::show(const Progress& progress) {
  if (interrupted() && !(progress.pass == finished_by_interrupt_ && content_with_interrupt())) return false;
  if (style_ == Style::kSilent) return true;
  const Clock::time_point now = Clock::now();
  const bool new_pass = !has_pass_ || progress.pass != pass_;
  if (new_pass) {
    end_pass();
    has_pass_ = true;
    pass_ = progress.pass;
    pass_start_ = now;
  }
  fraction_ = std::clamp(progress.fraction, 0.0, 1.0);
  vertices_ = progress.vertices;
  max_error_ = progress.max_error;

  if (seconds_between(last_shown_, now) < kMinInterval) return true;
  if (style_ == Style::kJson) {
    if (fraction_ >= 1) return true;  // the end of a pass has a line of its own
    print_json(fraction_);
  } else {
    if (seconds_between(start_, now) < kQuietSeconds) return true;
    print_line();
  }
  last_shown_ = now;
  return true;
}

void ProgressDisplay::end_pass() {
  if (has_pass_ && style_ == Style::kJson) print_json(1);
  has_pass_ = false;
}

void ProgressDisplay::finish() {
  end_pass();
  erase_line();
}

std::optional<double> ProgressDisplay::seconds_left() const {
  return find_seconds_left(seconds_between(pass_start_, Clock::now()), fraction_);
}

void ProgressDisplay::print_line() {
  std::string line = fmt::format("{} {:3.0f} %", pass_, 100 * fraction_);
  if (counts_tiles())
    line +=
        fmt::format("  {}  {:.1f} MB", format_plural(tiles_->tiles, "tile"), static_cast<double>(tiles_->bytes) / 1e6);
  else if (vertices_ > 0)
    line += fmt::format("  {} vertices", format_count(vertices_));
  if (max_error_ > 0) line += fmt::format("  error {:.4g}", max_error_);
  if (const auto left = seconds_left()) line += fmt::format("  {} left", format_duration(*left));
  line.resize(std::min(line.size(), terminal_width() - 1));
  print_to_stderr(fmt::format("\r{}\x1b[K", line));
  line_shown_ = true;
}

void ProgressDisplay::print_json(double fraction) const {
  nlohmann::ordered_json line;
  line["pass"] = pass_;
  line["fraction"] = fraction;
  if (counts_tiles()) {
    line["tiles"] = tiles_->tiles;
    line["bytes"] = tiles_->bytes;
  } else {
    line["vertices"] = vertices_;
    line["max_error"] = max_error_;
  }
  line["seconds"] = seconds_between(start_, Clock::now());
  if (counts_tiles()) {
    const auto left = fraction >= 1 ? 0 : seconds_left();
    line["seconds_left"] = left ? nlohmann::ordered_json(*left) : nlohmann::ordered_json(nullptr);
  }
  print_to_stderr(line.dump() + "\n");
}

void ProgressDisplay::erase_line() {
  if (!line_shown_) return;
  print_to_stderr("\r\x1b[K");
  line_shown_ = false;
}

}  // namespace scarp::cli
