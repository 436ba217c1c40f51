// A page of Markdown that is written from top to bottom, in lines of 120 characters but for tables.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace scarp::paper {

class Page {
 public:
  void heading(int level, const std::string& text);
  void paragraph(const std::string& text);
  void list(const std::vector<std::string>& items);
  /// A table whose first column is text; a row that is short is filled up with empty cells.
  void table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows);
  /// `path` is relative to the page.
  void picture(const std::string& path, const std::string& caption);

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Four significant digits.
std::string number(double value);
/// "7.06", or with a figure to compare with "7.06 (7.08, −0.3 %)".
std::string beside(double ours, std::optional<double> theirs);
/// The same for whole numbers.
std::string beside_count(std::uint64_t ours, std::optional<double> theirs);
/// "+3.1", "−3.1", "0": so many digits behind the point, the sign always there.
std::string with_sign(double value, int digits);
/// "+3.1 %"
std::string percent_of_change(double ours, double theirs);

/// How far our figures lie from others, over a section.
class Differences {
 public:
  void add(const std::string& what, double ours, std::optional<double> theirs);
  bool empty() const { return count_ == 0; }
  /// In percent, absolute.
  double largest() const;
  /// "12 figures differ from Scape's by −0.5 % to +2.1 %; the farthest is …". REQUIRES: not empty.
  std::string sentence(const std::string& noun) const;
  /// Those that lie so many percent or more from the other: "random on westUS (+86 %), …". Empty if none does.
  std::string list_far(double percent) const;

 private:
  std::size_t count_ = 0;
  double least_ = 0, most_ = 0;
  std::string farthest_;
  std::vector<std::pair<std::string, double>> all_;  ///< name, change in percent
};

}  // namespace scarp::paper
