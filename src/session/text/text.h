// Numbers and sentences for people.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/result.h"

namespace scarp::cli {

/// 3122, 27,577, 1,234,567: groups of three if there are five digits or more.
std::string format_count(std::uint64_t n);
/// Up to six significant digits, no trailing zeros.
std::string format_number(double value);
/// "84,212 bytes" or "1.24 MB (1,240,332 bytes)".
std::string format_bytes(std::uint64_t bytes);
/// Seconds with two digits after the point.
std::string format_seconds(double seconds);
/// part / whole as a percentage with three significant digits, "0 %" if whole is 0.
std::string format_share(double part, double whole);
/// "1 triangle", "2 triangles".
std::string format_plural(std::uint64_t n, std::string_view noun);

/// The last component of a path or URL, without a URL's query, which may contain a key.
std::string base_name(const std::string& path);
/// Quotes the word for a POSIX shell if it has more than letters, digits and plain punctuation.
std::string shell_word(const std::string& word);

/// A line of a summary.
std::string summary_line(const char* name, const std::string& value);

/// Writes `text` to stderr. Ignores failures, which cannot be reported.
void print_to_stderr(std::string_view text);
/// `scarp: SENTENCE` on stderr, always in one line.
void print_error(const Error& error);
/// `scarp: warning: SENTENCE` on stderr, one line each.
void print_warnings(const std::vector<std::string>& warnings);
/// Writes `text` to stdout. kOutput if that fails, unless the reader has closed its pipe.
Result<void> print_to_stdout(const std::string& text);
/// Prints the summary of written files like print_to_stdout(); nothing if the caller has closed stdout.
Result<void> print_summary(const std::string& text);

/// The exit code of an error: 1 usage, 2 input, 3 promise, 4 output, 5 cancelled, 70 internal.
int exit_code(ErrorKind kind);

}  // namespace scarp::cli
