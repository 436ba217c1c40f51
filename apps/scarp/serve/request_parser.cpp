#include "serve/request_parser.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scarp::cli {
namespace {

constexpr Refusal kBareLf{400, "a line ends in LF alone: CR LF ends a line of HTTP"};
constexpr Refusal kNoRequestLine{400, "the first line is no request line: METHOD, target and version, one space apart"};
constexpr Refusal kBadMethod{400, "the method is no token"};
constexpr Refusal kBadVersion{400, "the request line does not end in a version such as HTTP/1.1"};
constexpr Refusal kOtherVersion{505, "this server speaks HTTP/1.1 and HTTP/1.0"};
constexpr Refusal kBadTarget{400, "the target is no path, no http URL, and nothing else that its method may have"};
constexpr Refusal kTargetCharacter{400, "the target has a fragment, or characters that no URL has"};
constexpr Refusal kBadPercent{400, "a percent sign in the target begins no code, or that of NUL"};
constexpr Refusal kLongTarget{414, "the request line is too long"};
constexpr Refusal kLongHead{431, "the headers are too long"};
constexpr Refusal kFold{400, "a header line begins with a space: folded lines are obsolete"};
constexpr Refusal kNoColon{400, "a header line has no colon"};
constexpr Refusal kBadName{400, "the name of a header is empty, or has a space or another character that no token has"};
constexpr Refusal kBadValue{400, "a header has a control character"};
constexpr Refusal kNoHost{400, "a request of HTTP/1.1 needs the header Host"};
constexpr Refusal kBadHost{400, "the header Host is no host with or without a port, or is given twice"};
constexpr Refusal kBadLength{400, "the header Content-Length is no count, or is given twice"};
constexpr Refusal kTwoLengths{400, "Content-Length and Transfer-Encoding contradict each other"};
constexpr Refusal kOldCoding{400, "HTTP/1.0 has no Transfer-Encoding"};
constexpr Refusal kBadCoding{400, "Transfer-Encoding must end in chunked, once"};
constexpr Refusal kOtherCoding{501, "of Transfer-Encoding this server reads chunked alone"};
constexpr Refusal kLongBody{413, "the body is too long: no request here needs one"};
constexpr Refusal kBadChunk{400, "a chunk's size is no hexadecimal count with well-formed extensions"};
constexpr Refusal kBadChunkEnd{400, "a chunk is not followed by CR LF"};
constexpr Refusal kExpects{417, "this server expects no body: send the request without Expect"};

/// Sets of characters by RFC 9110 and RFC 3986.
enum CharacterSet : std::uint8_t { kToken = 1, kText = 2, kTarget = 4, kHost = 8, kDigit = 16, kHex = 32 };

constexpr std::array<std::uint8_t, 256> make_character_sets() {
  std::array<std::uint8_t, 256> sets{};
  const auto add = [&](std::string_view characters, int set) {
    for (const char c : characters) sets[static_cast<std::uint8_t>(c)] |= static_cast<std::uint8_t>(set);
  };
  // Targets may contain characters that browsers do not escape, such as "|".
  for (std::size_t c = '!'; c <= '~'; ++c) sets[c] |= c == '#' ? kText : kText | kTarget;
  for (std::size_t c = 0x80; c <= 0xff; ++c) sets[c] |= kText;
  add(" \t", kText);
  add("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789", kToken | kHost);
  add("!#$%&'*+-.^_`|~", kToken);
  add("-._~!$&'()*+;=%", kHost);
  add("0123456789", kDigit | kHex);
  add("abcdefABCDEF", kHex);
  return sets;
}
constexpr std::array<std::uint8_t, 256> kCharacterSets = make_character_sets();

bool is_of(char c, CharacterSet set) { return (kCharacterSets[static_cast<std::uint8_t>(c)] & set) != 0; }
bool are_of(std::string_view text, CharacterSet set) {
  return std::ranges::all_of(text, [&](char c) { return is_of(c, set); });
}
/// True for at least one character, all from the set.
bool is_word(std::string_view text, CharacterSet set) { return !text.empty() && are_of(text, set); }

/// Decodes "%41" to "A". Nothing for an incomplete code or code 0.
std::optional<std::string> decode_percent(std::string_view text) {
  std::string plain;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '%') {
      plain += text[k];
      continue;
    }
    const std::string code(text.substr(k + 1, 2));
    if (code.size() != 2 || !are_of(code, kHex)) return {};
    plain += static_cast<char>(std::stoi(code, nullptr, 16));
    if (plain.back() == '\0') return {};
    k += 2;
  }
  return plain;
}

bool is_port(std::string_view text) {
  constexpr int kMostDigits = 5, kMostPort = 65535;
  return text.empty() ||
         (text.size() <= kMostDigits && are_of(text, kDigit) && std::stoi(std::string(text)) <= kMostPort);
}

/// "example.org", "127.0.0.1:8080", "[::1]:8080".
bool is_host(std::string_view text) {
  if (text.substr(0, 1) != "[") {
    const std::string_view host = take_until(text, ':');
    return is_word(host, kHost) && decode_percent(host) && is_port(text);
  }
  text.remove_prefix(1);
  in6_addr address{};
  if (text.find(']') == std::string_view::npos) return false;
  if (::inet_pton(AF_INET6, std::string(take_until(text, ']')).c_str(), &address) != 1) return false;
  return text.empty() || (text.front() == ':' && is_port(text.substr(1)));
}

/// The text after a chunk's size: *( BWS ";" BWS name [ BWS "=" BWS ( token / quoted-string ) ] ).
bool are_chunk_extensions(std::string_view text) {
  const auto skip_blanks = [&] { text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size())); };
  const auto skip_token = [&] {
    const auto end = std::ranges::find_if_not(text, [](char c) { return is_of(c, kToken); });
    const auto length = static_cast<std::size_t>(end - text.begin());
    text.remove_prefix(length);
    return length > 0;
  };
  const auto skip_quoted = [&] {
    std::size_t k = 1;
    while (k < text.size() && text[k] != '"') k += text[k] == '\\' ? 2 : 1;
    if (k >= text.size()) return false;
    text.remove_prefix(k + 1);
    return true;
  };
  if (!are_of(text, kText)) return false;
  while (!text.empty()) {
    skip_blanks();
    if (text.empty() || text.front() != ';') return false;
    text.remove_prefix(1);
    skip_blanks();
    if (!skip_token()) return false;
    const std::string_view behind = text;
    skip_blanks();
    if (text.empty() || text.front() != '=') {
      text = behind;
      continue;
    }
    text.remove_prefix(1);
    skip_blanks();
    if (!(text.substr(0, 1) == "\"" ? skip_quoted() : skip_token())) return false;
  }
  return true;
}

std::vector<std::string> split_list(std::string_view text) {
  std::vector<std::string> parts;
  for (bool more = true; more;) {
    more = text.find(',') != std::string_view::npos;
    parts.push_back(lowered(trimmed(take_until(text, ','))));
  }
  return parts;
}

class RequestParser {
 public:
  explicit RequestParser(std::string_view bytes) : rest_(bytes), room_(kLongestHead) {}

  ParsedRequest parse() {
    const std::size_t all = rest_.size();
    if (read_request_line() && read_fields() && check_fields() && read_body()) {
      parsed_.state = ParsedRequest::State::kWhole;
      parsed_.length = all - rest_.size();
    }
    return std::move(parsed_);
  }

 private:
  // All return false if the request is refused or more bytes are needed.

  bool refuse(const Refusal& refusal) {
    parsed_.state = ParsedRequest::State::kRefused;
    parsed_.refusal = refusal;
    return false;
  }
  bool require(bool is_so, const Refusal& refusal) { return is_so || refuse(refusal); }

  void skip(std::size_t count) {
    rest_.remove_prefix(count);
    room_ -= count;
  }

  bool read_line(std::string_view& line, const Refusal& too_long) {
    const std::string_view seen = rest_.substr(0, room_);
    const std::size_t end = seen.find('\n');
    if (end == std::string_view::npos) return seen.size() == room_ && refuse(too_long);
    if (end == 0 || seen[end - 1] != '\r') return refuse(kBareLf);
    line = seen.substr(0, end - 1);
    skip(end + 1);
    return true;
  }

  bool read_request_line() {
    std::string_view line;
    if (!read_line(line, kLongTarget)) return false;
    // Some clients send an empty line after a body.
    if (line.empty() && !read_line(line, kLongTarget)) return false;
    if (!require(std::ranges::count(line, ' ') == 2, kNoRequestLine)) return false;
    const std::string_view method = take_until(line, ' '), target = take_until(line, ' ');
    if (!require(is_word(method, kToken), kBadMethod)) return false;
    constexpr std::string_view kName = "HTTP/";
    const bool is_version = line.size() == 8 && line.substr(0, kName.size()) == kName && is_of(line[5], kDigit) &&
                            line[6] == '.' && is_of(line[7], kDigit);
    if (!require(is_version, kBadVersion) || !require(line[5] == '1', kOtherVersion)) return false;
    is_old_ = line[7] == '0';
    parsed_.request.method = method;
    return read_target(target);
  }

  bool read_target(std::string_view target) {
    Request& request = parsed_.request;
    if (!require(!target.empty(), kNoRequestLine) || !require(are_of(target, kTarget), kTargetCharacter)) return false;
    if (request.method == "CONNECT") return require(is_host(target) && target.back() != ':', kBadTarget);
    if (target == "*") {
      request.path = target;
      return require(request.method == "OPTIONS", kBadTarget);
    }
    if (target.front() != '/') {
      constexpr std::string_view kScheme = "http://";
      if (!require(lowered(target.substr(0, kScheme.size())) == kScheme, kBadTarget)) return false;
      target.remove_prefix(kScheme.size());
      const std::size_t end = std::min(target.find_first_of("/?"), target.size());
      if (!require(is_host(target.substr(0, end)), kBadTarget)) return false;
      target.remove_prefix(end);
    }
    const auto path = decode_percent(take_until(target, '?'));
    if (!require(path && decode_percent(target), kBadPercent)) return false;
    request.path = path->empty() ? "/" : *path;
    request.query = target;
    return true;
  }

  /// Reads header fields up to the empty line.
  bool read_fields() {
    while (true) {
      std::string_view line;
      if (!read_line(line, kLongHead)) return false;
      if (line.empty()) return true;
      if (!require(line.front() != ' ' && line.front() != '\t', kFold)) return false;
      if (!require(line.find(':') != std::string_view::npos, kNoColon)) return false;
      const std::string_view name = take_until(line, ':'), value = trimmed(line);
      if (!require(is_word(name, kToken), kBadName) || !require(are_of(value, kText), kBadValue)) return false;
      if (is_in_trailer_) continue;
      auto [at, is_new] = parsed_.request.headers.try_emplace(lowered(name), value);
      if (!is_new) at->second.append(", ").append(value);
      ++counts_[at->first];
    }
  }

  bool check_fields() {
    Request& request = parsed_.request;
    const auto count = [&](const char* name) { return counts_.count(name) > 0 ? counts_.at(name) : 0; };
    if (!require(count("host") > 0 || is_old_, kNoHost)) return false;
    if (count("host") > 0 && !require(count("host") == 1 && is_host(request.header("host")), kBadHost)) return false;
    constexpr std::size_t kMostDigits = 18;
    const std::string length = request.header("content-length");
    const bool is_count = count("content-length") == 1 && length.size() <= kMostDigits && is_word(length, kDigit);
    if (!require(count("content-length") == 0 || is_count, kBadLength)) return false;
    if (is_count) body_ = std::stoull(length);
    if (count("transfer-encoding") > 0) {
      if (!require(!is_old_, kOldCoding) || !require(!is_count, kTwoLengths)) return false;
      if (!check_codings(split_list(request.header("transfer-encoding")))) return false;
      is_chunked_ = true;
    }
    if (!require(is_old_ || count("expect") == 0, kExpects)) return false;
    const std::vector<std::string> options = split_list(request.header("connection"));
    const auto has = [&](const char* option) { return std::ranges::count(options, option) > 0; };
    request.keeps_alive = !has("close") && (!is_old_ || has("keep-alive")) && request.method != "CONNECT";
    return true;
  }

  bool check_codings(const std::vector<std::string>& codings) {
    constexpr std::array kOthers{"gzip", "x-gzip", "deflate", "compress", "x-compress", "identity"};
    const auto chunked = std::ranges::count(codings, "chunked");
    if (codings.back() == "chunked")
      return require(chunked == 1, kBadCoding) && require(codings.size() == 1, kOtherCoding);
    const bool is_known = std::ranges::count(kOthers, codings.back()) > 0;
    return refuse(chunked > 0 || is_known || !is_word(codings.back(), kToken) ? kBadCoding : kOtherCoding);
  }

  bool read_body() {
    room_ = kLongestBody;
    if (is_chunked_) return read_chunks();
    if (!require(body_ <= room_, kLongBody) || rest_.size() < body_) return false;
    skip(static_cast<std::size_t>(body_));
    return true;
  }

  bool read_chunks() {
    constexpr std::size_t kMostDigits = 15;
    constexpr std::string_view kEnd = "\r\n";
    while (true) {
      std::string_view line;
      if (!read_line(line, kLongBody)) return false;
      const auto behind = std::ranges::find_if_not(line, [](char c) { return is_of(c, kHex); });
      const auto digits = static_cast<std::size_t>(behind - line.begin());
      const bool is_size = digits > 0 && digits <= kMostDigits && are_chunk_extensions(line.substr(digits));
      if (!require(is_size, kBadChunk)) return false;
      const std::uint64_t size = std::stoull(std::string(line.substr(0, digits)), nullptr, 16);
      if (size == 0) {
        is_in_trailer_ = true;
        return read_fields();
      }
      if (!require(size + kEnd.size() <= room_, kLongBody)) return false;
      if (rest_.size() < size + kEnd.size()) return false;
      if (!require(rest_.substr(size, kEnd.size()) == kEnd, kBadChunkEnd)) return false;
      skip(size + kEnd.size());
    }
  }

  std::string_view rest_;
  std::size_t room_;  ///< remaining bytes of head or body
  bool is_old_ = false, is_chunked_ = false, is_in_trailer_ = false;
  std::uint64_t body_ = 0;
  std::map<std::string, int> counts_;
  ParsedRequest parsed_;
};

}  // namespace

ParsedRequest parse_request(std::string_view bytes) { return RequestParser(bytes).parse(); }

}  // namespace scarp::cli
