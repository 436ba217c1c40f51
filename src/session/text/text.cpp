#include "session/text/text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace scarp::cli {
namespace {

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool blank = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    if (!blank) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

}  // namespace

std::string format_count(std::uint64_t n) {
  std::string digits = fmt::format("{}", n);
  if (digits.size() < 5) return digits;
  for (std::size_t at = digits.size() - 3;; at -= 3) {
    digits.insert(at, 1, ',');
    if (at <= 3) return digits;
  }
}

std::string format_number(double value) { return fmt::format("{:.6g}", value); }

std::string format_bytes(std::uint64_t bytes) {
  if (bytes < 1'000'000) return fmt::format("{} bytes", format_count(bytes));
  const double mega = static_cast<double>(bytes) / 1e6;
  return mega < 1000 ? fmt::format("{:.2f} MB ({} bytes)", mega, format_count(bytes))
                     : fmt::format("{:.2f} GB ({} bytes)", mega / 1000, format_count(bytes));
}

std::string format_seconds(double seconds) { return fmt::format("{:.2f}", seconds); }

std::string format_share(double part, double whole) {
  return whole > 0 ? fmt::format("{:.3g} %", 100 * part / whole) : "0 %";
}

std::string format_plural(std::uint64_t n, std::string_view noun) {
  return fmt::format("{} {}{}", format_count(n), noun, n == 1 ? "" : "s");
}

std::string base_name(const std::string& path) {
  std::string name = path;
  if (name.find("://") != std::string::npos || name.rfind("/vsi", 0) == 0) name = name.substr(0, name.find('?'));
  const std::size_t slash = name.find_last_of('/');
  return slash == std::string::npos ? name : name.substr(slash + 1);
}

std::string shell_word(const std::string& word) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::strchr("-_./:%+,=@", c) != nullptr;
  };
  bool quote = word.empty();
  for (const char c : word) quote = quote || c == '\0' || !plain(c);
  if (!quote) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string summary_line(const char* name, const std::string& value) {
  return fmt::format("  {:<14}{}\n", name, value);
}

void print_to_stderr(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void print_error(const Error& error) { print_to_stderr(fmt::format("scarp: {}\n", one_line(error.message))); }

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) print_to_stderr(fmt::format("scarp: warning: {}\n", one_line(warning)));
}

Result<void> print_to_stdout(const std::string& text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!written && errno != EPIPE) {
    return fail(ErrorKind::kOutput, fmt::format("standard output cannot be written: {}", std::strerror(errno)));
  }
  return {};
}

Result<void> print_summary(const std::string& text) {
  const bool is_closed = fcntl(STDOUT_FILENO, F_GETFL) < 0 || (fcntl(STDOUT_FILENO, F_GETFL) & O_ACCMODE) == O_RDONLY;
  return is_closed ? Result<void>() : print_to_stdout(text);
}

int exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage:
    case ErrorKind::kMemory:
      return 1;
    case ErrorKind::kInput:
      return 2;
    case ErrorKind::kPromise:
      return 3;
    case ErrorKind::kOutput:
      return 4;
    case ErrorKind::kCancelled:
      return 5;
    case ErrorKind::kInternal:
      break;
  }
  return 70;
}

}  // namespace scarp::cli
