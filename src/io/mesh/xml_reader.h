// An event-based XML reader for arbitrary bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scarp::io {

/// Reads XML in UTF-8 or ASCII and checks that elements are closed in order, down to the root. Document types are
/// rejected, so the only entities are XML's own five and numeric ones. Names are returned without their prefix.
class XmlReader {
 public:
  enum class Event {
    kStart,    ///< start of an element: name(), attribute()
    kEnd,      ///< end of an element: name(); also for <one/>
    kText,     ///< text(), with unresolved entities
    kComment,  ///< text()
    kDone,     ///< the root has ended
    kBroken,   ///< complaint()
  };

  explicit XmlReader(std::span<const std::uint8_t> bytes)
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()) {}

  Event next();
  std::string_view name() const { return name_; }
  /// The attribute's value with entities resolved; empty if absent.
  std::string attribute(std::string_view name) const;
  std::string_view text() const { return content_; }
  const std::string& complaint() const { return complaint_; }

  /// The position of the next event, in bytes from the start. With jump() it serves to skip content that is not XML.
  std::size_t position() const { return at_; }
  void jump(std::size_t position) { at_ = position; }
  /// The 1-based line of position(). Cost: O(position()).
  std::size_t line() const;

 private:
  Event broken(std::string why);
  Event read_tag();
  bool read_attributes();
  void skip_blanks();
  std::string_view read_name();

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<std::string_view> open_;  // full names, outermost first
  std::vector<std::pair<std::string_view, std::string_view>> attributes_;
  std::string_view name_, content_;
  std::string complaint_;
  bool ends_at_once_ = false, has_root_ = false;
};

/// Reads to the end of the root. `start`, `text` and `end` are called for their events. A non-empty string from `end`
/// is a complaint and ends reading. Returns that complaint, or the reader's, or an empty string.
template <class Start, class Text, class End>
std::string read_events(XmlReader& xml, Start&& start, Text&& text, End&& end) {
  for (;;) {
    switch (xml.next()) {
      case XmlReader::Event::kStart:
        start();
        break;
      case XmlReader::Event::kText:
        text();
        break;
      case XmlReader::Event::kEnd:
        if (std::string why = end(); !why.empty()) return why;
        break;
      case XmlReader::Event::kComment:
        break;
      case XmlReader::Event::kDone:
        return {};
      case XmlReader::Event::kBroken:
        return xml.complaint();
    }
  }
}

/// Resolves "&lt;", "&#10;" …; unknown entities are unchanged.
std::string undo_entities(std::string_view text);
/// Escapes text for an attribute in double quotes or an element.
std::string with_entities(std::string_view text);

}  // namespace scarp::io
