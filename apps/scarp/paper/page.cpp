#include "page.h"

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

std::string percent_of_change(double ours, double theirs) {
  const double change = 100 * (ours / theirs - 1);
  if (std::abs(change) < 0.05) return "0 %";
  const std::string digits =
      std::abs(change) < 10 ? fmt::format("{:.1f}", std::abs(change)) : fmt::format("{:.0f}", std::abs(change));
  return (change < 0 ? "−" : "+") + digits + " %";
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
  if (count_ == 1) return fmt::format("The {} differs from Scape's by {:+.1f} %.", noun, least_);
  return fmt::format("{} {} differ from Scape's by {:+.1f} % to {:+.1f} %; the farthest is {}.", count_, noun, least_,
                     most_, farthest_);
}

}  // namespace scarp::paper
