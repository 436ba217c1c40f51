#include "paper/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scarp::paper {

void Page::heading(int level, const std::string& text) {
  text_ += fmt::format("{}{} {}\n", text_.empty() ? "" : "\n", std::string(static_cast<std::size_t>(level), '#'), text);
}

void Page::paragraph(const std::string& text) { text_ += "\n" + text + "\n"; }

void Page::list(const std::vector<std::string>& items) {
  text_ += "\n";
  for (const std::string& item : items) text_ += "- " + item + "\n";
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
  text_ += fmt::format("\n![{}]({})\n", caption, path);
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
}

double Differences::largest() const { return std::max(std::abs(least_), std::abs(most_)); }

std::string Differences::sentence(const std::string& noun) const {
  return fmt::format("{} {} differ from Scape's by {} % to {} %; the farthest is {}.", count_, noun,
                     with_sign(least_, 1), with_sign(most_, 1), farthest_);
}

}  // namespace scarp::paper
