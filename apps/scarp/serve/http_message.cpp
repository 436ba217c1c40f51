#include "serve/http_message.h"

#include <fmt/chrono.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <optional>

namespace scarp::cli {
namespace {

struct Reason {
  int status;
  std::string_view phrase;
};
constexpr Reason kReasons[] = {
    {200, "OK"},
    {204, "No Content"},
    {206, "Partial Content"},
    {304, "Not Modified"},
    {400, "Bad Request"},
    {404, "Not Found"},
    {405, "Method Not Allowed"},
    {413, "Content Too Large"},
    {414, "URI Too Long"},
    {416, "Range Not Satisfiable"},
    {417, "Expectation Failed"},
    {431, "Request Header Fields Too Large"},
    {500, "Internal Server Error"},
    {501, "Not Implemented"},
    {505, "HTTP Version Not Supported"},
};

std::string_view reason_phrase(int status) { return std::ranges::find(kReasons, status, &Reason::status)->phrase; }

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

std::string lowered(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::string_view take_until(std::string_view& text, char separator) {
  const std::size_t end = text.find(separator);
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return part;
}

OpenFile::~OpenFile() { ::close(fd_); }

std::string write_head(const Response& response, bool keeps_alive) {
  std::string head = fmt::format("HTTP/1.1 {} {}\r\nDate: {:%a, %d %b %Y %H:%M:%S} GMT\r\n", response.status,
                                 reason_phrase(response.status), fmt::gmtime(std::time(nullptr)));
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
    std::string_view one = take_until(rest, ',');
    const std::string_view coding = trimmed(take_until(one, ';'));
    const std::string_view weight = trimmed(one);
    // "q=0" and "q=0.0" mean no.
    const bool refused = weight.substr(0, 2) == "q=" && weight.find_first_of("123456789") == std::string_view::npos;
    if (coding == "gzip" || coding == "x-gzip") return !refused;
    if (coding == "*") any = !refused;
  }
  return any;
}

bool matches_tag(const std::string& if_none_match, const std::string& tag) {
  std::string_view rest = if_none_match;
  while (!rest.empty()) {
    std::string_view one = trimmed(take_until(rest, ','));
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
  const std::string_view first = trimmed(take_until(rest, '-')), last = trimmed(rest);
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
