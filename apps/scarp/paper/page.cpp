#include "paper/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace scarp::paper {
namespace {

constexpr std::size_t kLineWidth = 120;

/// Characters of UTF-8: bytes that do not continue one.
std::size_t count_characters(std::string_view word) {
  const auto begins = [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0u) != 0x80u; };
  return static_cast<std::size_t>(std::count_if(word.begin(), word.end(), begins));
}

/// The words on lines of `kLineWidth` characters, `indent` before all but the first. No line begins with a single sign,
/// which Markdown could read as the beginning of a list.
std::string wrap_words(const std::string& text, std::size_t indent) {
  std::string lines;
  std::size_t column = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string_view word = std::string_view(text).substr(begin, end - begin);
    if (begin > 0) {
      const bool fits = count_characters(word) == 1 || column + 1 + count_characters(word) <= kLineWidth;
      lines += fits ? std::string(" ") : "\n" + std::string(indent, ' ');
      column = fits ? column + 1 : indent;
    }
    lines += word;
    column += count_characters(word);
    begin = end + 1;
  }
  return lines;
}

}  // namespace

void Page::heading(int level, const std::string& text) {
  text_ += fmt::format("{}{} {}\n", text_.empty() ? "" : "\n", std::string(static_cast<std::size_t>(level), '#'), text);
}

void Page::paragraph(const std::string& text) { text_ += "\n" + wrap_words(text, 0) + "\n"; }

void Page::list(const std::vector<std::string>& items) {
  text_ += "\n";
  for (const std::string& item : items) text_ += wrap_words("- " + item, 2) + "\n";
}

void Page::table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows) {
  const auto line = [&](const std::vector<std::string>& cells) {
    text_ += "|";
    for (std::size_t k = 0; k < header.size(); ++k) text_ += fmt::format(" {} |", k < cells.size() ? cells[k] : "");
    text_ += "\n";
  };
  text_ += "\n";
  line(header);
  text_ += "|";
  for (std::size_t k = 0; k < header.size(); ++k) text_ += k == 0 ? "---|" : "---:|";
  text_ += "\n";
  for (const auto& row : rows) line(row);
}

void Page::picture(const std::string& path, const std::string& caption) {
  text_ += "\n" + wrap_words(fmt::format("![{}]({})", caption, path), 0) + "\n";
}

std::string number(double value) { return fmt::format("{:.4g}", value); }

std::string with_sign(double value, int digits) {
  const std::string size = fmt::format("{:.{}f}", std::abs(value), digits);
  if (size.find_first_not_of("0.") == std::string::npos) return "0";
  return (value < 0 ? "−" : "+") + size;
}

std::string percent_of_change(double ours, double theirs) {
  const double change = 100 * (ours / theirs - 1);
  return with_sign(change, std::abs(change) < 9.95 ? 1 : 0) + " %";
}

std::string beside(double ours, std::optional<double> theirs) {
  if (!theirs) return number(ours);
  return fmt::format("{} ({:g}, {})", number(ours), *theirs, percent_of_change(ours, *theirs));
}

std::string beside_count(std::uint64_t ours, std::optional<double> theirs) {
  if (!theirs) return fmt::format("{}", ours);
  return fmt::format("{} ({:.0f}, {})", ours, *theirs, percent_of_change(static_cast<double>(ours), *theirs));
}

void Differences::add(const std::string& what, double ours, std::optional<double> theirs) {
  if (!theirs) return;
  const double change = 100 * (ours / *theirs - 1);
  if (count_ == 0 || std::abs(change) > largest()) farthest_ = what;
  least_ = count_ == 0 ? change : std::min(least_, change);
  most_ = count_ == 0 ? change : std::max(most_, change);
  ++count_;
  all_.emplace_back(what, change);
}

double Differences::largest() const { return std::max(std::abs(least_), std::abs(most_)); }

std::string Differences::sentence(const std::string& noun) const {
  return fmt::format("{} {} differ from Scape's by {} % to {} %; the farthest is {}.", count_, noun,
                     with_sign(least_, 1), with_sign(most_, 1), farthest_);
}

std::string Differences::list_far(double percent) const {
  std::string list;
  for (const auto& [what, change] : all_) {
    if (std::abs(change) < percent) continue;
    list += fmt::format("{}{} ({} %)", list.empty() ? "" : ", ", what, with_sign(change, 0));
  }
  return list;
}

}  // namespace scarp::paper
