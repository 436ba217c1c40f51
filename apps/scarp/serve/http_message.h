// The subset of HTTP/1.1 that a file server needs.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scarp::cli {

struct Request {
  std::string method;
  std::string path;                            ///< decoded, from the first slash; "*" or empty for the whole server
  std::string query;                           ///< after the question mark, not decoded
  std::map<std::string, std::string> headers;  ///< lower-case names
  bool keeps_alive = true;

  /// Empty if absent.
  std::string header(const std::string& name) const;
};

/// A file that is closed after the last answer that uses it.
class OpenFile {
 public:
  explicit OpenFile(int fd) : fd_(fd) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile();
  int fd() const { return fd_; }

 private:
  int fd_;
};

/// A part of a file, sent instead of a body.
struct FilePart {
  std::shared_ptr<const OpenFile> file;
  std::uint64_t offset = 0, length = 0;
};

struct Response {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers;
  std::vector<std::uint8_t> body;
  FilePart file;  ///< replaces the body if it has a file

  std::uint64_t length() const { return file.file ? file.length : body.size(); }
};

std::string lowered(std::string_view text);
/// The text without leading and trailing spaces and tabs.
std::string_view trimmed(std::string_view text);
/// Returns the text before the separator, or all text without one. Removes the result and the separator from `text`.
std::string_view take_until(std::string_view& text, char separator);

/// Status and headers, including Date, Content-Length and Connection.
std::string write_head(const Response& response, bool keeps_alive);

/// A response with a sentence for people.
Response text_response(int status, const std::string& sentence);

/// True if Accept-Encoding accepts gzip.
bool accepts_gzip(const std::string& accept_encoding);
/// True if If-None-Match names the tag.
bool matches_tag(const std::string& if_none_match, const std::string& tag);

/// The bytes that a Range header requests.
struct ByteRange {
  std::uint64_t first = 0, last = 0;  ///< inclusive
};
enum class RangeKind {
  kWhole,       ///< no range, several ranges, or an unknown unit: the answer is the whole file
  kPart,        ///< `range` is set
  kOutOfReach,  ///< starts after the end of the file
};
RangeKind parse_range(const std::string& header, std::uint64_t size, ByteRange& range);

}  // namespace scarp::cli
