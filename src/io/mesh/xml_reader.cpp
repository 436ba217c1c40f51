#include "io/mesh/xml_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/mesh/mesh_file_text.h"

namespace scarp::io {
namespace {

bool is_xml_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

bool ends_name(char c) {
  return is_xml_blank(c) || c == '/' || c == '>' || c == '=' || c == '<' || c == '"' || c == '\'';
}

std::string_view without_prefix(std::string_view name) { return name.substr(name.find(':') + 1); }

void append_utf8(std::uint32_t code, std::string& text) {
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) {
    add(code);
  } else if (code < 0x800) {
    add(0xC0 | code >> 6);
    add(0x80 | (code & 63));
  } else if (code < 0x10000) {
    add(0xE0 | code >> 12);
    add(0x80 | (code >> 6 & 63));
    add(0x80 | (code & 63));
  } else {
    add(0xF0 | code >> 18);
    add(0x80 | (code >> 12 & 63));
    add(0x80 | (code >> 6 & 63));
    add(0x80 | (code & 63));
  }
}

/// The character encoded by "#65" or "#x41"; 0 if invalid.
std::uint32_t character_number(std::string_view entity) {
  const bool hex = entity.starts_with("#x");
  entity.remove_prefix(hex ? 2 : 1);
  std::uint32_t code = 0;
  for (const char c : entity) {
    const char low = c >= 'A' && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c;
    const bool digit = c >= '0' && c <= '9';
    if (!digit && !(hex && low >= 'a' && low <= 'f')) return 0;
    code = code * (hex ? 16 : 10) + static_cast<std::uint32_t>(digit ? c - '0' : low - 'a' + 10);
    if (code > 0x10FFFF) return 0;
  }
  return code;
}

}  // namespace

std::string undo_entities(std::string_view text) {
  constexpr std::pair<std::string_view, char> kNamed[] = {
      {"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}};
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t end = text[i] == '&' ? text.substr(0, i + 12).find(';', i) : std::string_view::npos;
    const std::size_t before = plain.size();
    if (end != std::string_view::npos) {
      const std::string_view entity = text.substr(i + 1, end - i - 1);
      for (const auto& [name, character] : kNamed) {
        if (entity == name) plain += character;
      }
      if (entity.starts_with('#')) {
        if (const std::uint32_t code = character_number(entity); code != 0) append_utf8(code, plain);
      }
    }
    if (plain.size() == before) {
      plain += text[i];
    } else {
      i = end;
    }
  }
  return plain;
}

std::string with_entities(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '&':
        escaped += "&amp;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string XmlReader::attribute(std::string_view name) const {
  for (const auto& [known, value] : attributes_) {
    if (known == name) return undo_entities(value);
  }
  return {};
}

std::size_t XmlReader::line() const {
  const std::string_view before = text_.substr(0, std::min(at_, text_.size()));
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

XmlReader::Event XmlReader::broken(std::string why) {
  complaint_ = std::move(why);
  return Event::kBroken;
}

void XmlReader::skip_blanks() {
  while (at_ < text_.size() && is_xml_blank(text_[at_])) ++at_;
}

std::string_view XmlReader::read_name() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && !ends_name(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

bool XmlReader::read_attributes() {
  attributes_.clear();
  for (;;) {
    skip_blanks();
    if (at_ >= text_.size()) return false;
    if (text_[at_] == '>' || text_[at_] == '/') return true;
    const std::string_view name = read_name();
    skip_blanks();
    if (name.empty() || at_ >= text_.size() || text_[at_] != '=') return false;
    ++at_;
    skip_blanks();
    if (at_ >= text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) return false;
    const std::size_t begin = at_ + 1;
    const std::size_t end = text_.find(text_[at_], begin);
    if (end == std::string_view::npos) return false;
    attributes_.emplace_back(without_prefix(name), text_.substr(begin, end - begin));
    at_ = end + 1;
  }
}

XmlReader::Event XmlReader::read_tag() {
  const std::size_t start = at_++;
  const bool closes = at_ < text_.size() && text_[at_] == '/';
  if (closes) ++at_;
  const std::string_view name = read_name();
  if (name.empty() && at_ < text_.size()) return broken(fmt::format("line {}: a tag has no name", line()));
  if (closes) {
    skip_blanks();
    if (at_ >= text_.size()) return broken("it ends within a tag: it was cut off");
    if (text_[at_] != '>' || open_.empty() || open_.back() != name) {
      return broken(fmt::format("line {}: {} ends, which was not the last to begin", line(), in_quotes(name)));
    }
    ++at_;
    open_.pop_back();
    name_ = without_prefix(name);
    return Event::kEnd;
  }
  if (open_.empty() && has_root_) return broken(fmt::format("line {}: a second root begins", line()));
  if (!read_attributes()) {
    at_ = start;
    return broken(fmt::format("line {}: the tag {} is broken or cut off", line(), in_quotes(name)));
  }
  if (text_[at_] == '/') {
    if (at_ + 1 >= text_.size() || text_[at_ + 1] != '>') {
      return broken(fmt::format("line {}: the tag {} is broken or cut off", line(), in_quotes(name)));
    }
    ends_at_once_ = true;
    ++at_;
  }
  ++at_;
  has_root_ = true;
  open_.push_back(name);
  name_ = without_prefix(name);
  return Event::kStart;
}

XmlReader::Event XmlReader::next() {
  if (ends_at_once_) {
    ends_at_once_ = false;
    name_ = without_prefix(open_.back());
    open_.pop_back();
    return Event::kEnd;
  }
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (at_ == 0 && text_.starts_with(kMark)) at_ = kMark.size();
  for (;;) {
    if (at_ >= text_.size()) {
      if (has_root_ && open_.empty()) return Event::kDone;
      return broken(open_.empty() ? "it holds no element"
                                  : fmt::format("it ends within {}: it was cut off", in_quotes(open_.back())));
    }
    if (text_[at_] != '<') {
      const std::size_t end = std::min(text_.find('<', at_), text_.size());
      content_ = text_.substr(at_, end - at_);
      at_ = end;
      if (!open_.empty()) return Event::kText;
      if (!std::all_of(content_.begin(), content_.end(), is_xml_blank)) {
        return broken(fmt::format("line {}: there is text outside of the root", line()));
      }
      continue;
    }
    const std::string_view rest = text_.substr(at_);
    const auto take_until = [&](std::size_t head, std::string_view tail) {
      const std::size_t end = text_.find(tail, at_ + head);
      if (end == std::string_view::npos) return false;
      content_ = text_.substr(at_ + head, end - at_ - head);
      at_ = end + tail.size();
      return true;
    };
    if (rest.starts_with("<!--")) {
      if (!take_until(4, "-->")) return broken("it ends within a comment: it was cut off");
      return Event::kComment;
    }
    if (rest.starts_with("<?")) {
      if (!take_until(2, "?>")) return broken("it ends within an instruction: it was cut off");
      continue;
    }
    if (rest.starts_with("<![CDATA[")) {
      if (!take_until(9, "]]>")) return broken("it ends within character data: it was cut off");
      return Event::kText;
    }
    if (rest.starts_with("<!")) return broken(fmt::format("line {}: document types are not read", line()));
    return read_tag();
  }
}

}  // namespace scarp::io
