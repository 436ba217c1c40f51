#include "serve/http_message.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace scarp::cli {
namespace {

std::string lowered(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

/// What stands before the separator, which goes with it.
std::string_view take(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

/// "%41" is "A". Nothing for half a code and for code 0.
std::optional<std::string> decode_percent(std::string_view text) {
  std::string plain;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '%') {
      plain += text[k];
      continue;
    }
    if (k + 2 >= text.size() || !std::isxdigit(static_cast<unsigned char>(text[k + 1])) ||
        !std::isxdigit(static_cast<unsigned char>(text[k + 2])))
      return {};
    plain += static_cast<char>(std::stoi(std::string(text.substr(k + 1, 2)), nullptr, 16));
    if (plain.back() == '\0') return {};
    k += 2;
  }
  return plain;
}

std::string_view reason_phrase(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 204:
      return "No Content";
    case 206:
      return "Partial Content";
    case 304:
      return "Not Modified";
    case 400:
      return "Bad Request";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 416:
      return "Range Not Satisfiable";
    case 431:
      return "Request Header Fields Too Large";
    default:
      return "Internal Server Error";
  }
}

std::optional<std::uint64_t> find_count(std::string_view text) {
  if (text.empty() || text.size() > 18) return {};
  std::uint64_t count = 0;
  for (const char digit : text) {
    if (digit < '0' || digit > '9') return {};
    count = 10 * count + static_cast<std::uint64_t>(digit - '0');
  }
  return count;
}

}  // namespace

std::string Request::header(const std::string& name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? std::string() : found->second;
}

std::optional<std::size_t> find_request_end(std::string_view bytes) {
  const std::size_t end = bytes.find("\r\n\r\n");
  if (end == std::string_view::npos) return {};
  return end + 4;
}

std::optional<Request> parse_request(std::string_view head) {
  Request request;
  std::string_view line = trimmed(take(head, '\n'));
  request.method = take(line, ' ');
  std::string_view target = take(line, ' ');
  if (request.method.empty() || target.empty() || target[0] != '/' || (line != "HTTP/1.1" && line != "HTTP/1.0"))
    return {};
  const auto path = decode_percent(take(target, '?'));
  if (!path) return {};
  request.path = *path;
  request.query = target;
  request.keeps_alive = line == "HTTP/1.1";
  while (!head.empty()) {
    std::string_view field = trimmed(take(head, '\n'));
    if (field.empty()) continue;
    if (field.find(':') == std::string_view::npos) return {};
    const std::string name = lowered(take(field, ':'));
    std::string& value = request.headers[name];
    value += (value.empty() ? "" : ", ") + std::string(trimmed(field));
  }
  if (request.headers.count("transfer-encoding") > 0) return {};
  const std::string length = request.header("content-length");
  if (!length.empty() && length != "0") return {};
  const std::string connection = lowered(request.header("connection"));
  if (connection.find("close") != std::string::npos) request.keeps_alive = false;
  if (connection.find("keep-alive") != std::string::npos) request.keeps_alive = true;
  return request;
}

std::string write_head(const Response& response, bool keeps_alive) {
  std::string head = fmt::format("HTTP/1.1 {} {}\r\n", response.status, reason_phrase(response.status));
  for (const auto& [name, value] : response.headers) head += fmt::format("{}: {}\r\n", name, value);
  if (response.status != 304 && response.status != 204)
    head += fmt::format("Content-Length: {}\r\n", response.length());
  head += fmt::format("Connection: {}\r\n\r\n", keeps_alive ? "keep-alive" : "close");
  return head;
}

Response text_response(int status, const std::string& sentence) {
  Response response;
  response.status = status;
  response.headers.push_back({"Content-Type", "text/plain; charset=utf-8"});
  response.body.assign(sentence.begin(), sentence.end());
  response.body.push_back('\n');
  return response;
}

bool accepts_gzip(const std::string& accept_encoding) {
  const std::string all = lowered(accept_encoding);
  std::string_view rest = all;
  bool any = false;
  while (!rest.empty()) {
    std::string_view one = take(rest, ',');
    const std::string_view coding = trimmed(take(one, ';'));
    const std::string_view weight = trimmed(one);
    // "q=0", "q=0.0": no.
    const bool refused = weight.substr(0, 2) == "q=" && weight.find_first_of("123456789") == std::string_view::npos;
    if (coding == "gzip" || coding == "x-gzip") return !refused;
    if (coding == "*") any = !refused;
  }
  return any;
}

bool matches_tag(const std::string& if_none_match, const std::string& tag) {
  std::string_view rest = if_none_match;
  while (!rest.empty()) {
    std::string_view one = trimmed(take(rest, ','));
    if (one.substr(0, 2) == "W/") one.remove_prefix(2);
    if (one == "*" || one == tag) return true;
  }
  return false;
}

RangeKind parse_range(const std::string& header, std::uint64_t size, ByteRange& range) {
  constexpr std::string_view kUnit = "bytes=";
  std::string_view rest = header;
  if (rest.substr(0, kUnit.size()) != kUnit || rest.find(',') != std::string_view::npos) return RangeKind::kWhole;
  rest.remove_prefix(kUnit.size());
  if (rest.find('-') == std::string_view::npos) return RangeKind::kWhole;
  const std::string_view first = trimmed(take(rest, '-')), last = trimmed(rest);
  const auto from = find_count(first), to = find_count(last);
  if (first.empty()) {  // the last bytes
    if (!to) return RangeKind::kWhole;
    if (*to == 0 || size == 0) return RangeKind::kOutOfReach;
    range = {size - std::min(*to, size), size - 1};
    return RangeKind::kPart;
  }
  if (!from || (!to && !last.empty()) || (to && *to < *from)) return RangeKind::kWhole;
  if (*from >= size) return RangeKind::kOutOfReach;
  range = {*from, std::min(to.value_or(size - 1), size - 1)};
  return RangeKind::kPart;
}

}  // namespace scarp::cli
