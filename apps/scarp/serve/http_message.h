// HTTP/1.1, as far as a server of files needs it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scarp::cli {

struct Request {
  std::string method;
  std::string path;                            ///< decoded, from the first slash on
  std::string query;                           ///< behind the question mark, as it is
  std::map<std::string, std::string> headers;  ///< names in small letters
  bool keeps_alive = true;

  /// Empty if it is not there.
  std::string header(const std::string& name) const;
};

/// A part of a file, in place of a body.
struct FilePart {
  int fd = -1;
  std::uint64_t offset = 0, length = 0;
};

struct Response {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers;
  std::vector<std::uint8_t> body;
  FilePart file;  ///< in place of the body where fd is one

  std::uint64_t length() const { return file.fd >= 0 ? file.length : body.size(); }
};

/// The end of the first request in the bytes, or nothing if it is not complete.
std::optional<std::size_t> find_request_end(std::string_view bytes);
/// Nothing for what is no request, and for one that has a body.
std::optional<Request> parse_request(std::string_view head);

/// Status and headers, Content-Length and Connection included.
std::string write_head(const Response& response, bool keeps_alive);

/// A sentence for people.
Response text_response(int status, const std::string& sentence);

/// Whether Accept-Encoding takes gzip.
bool accepts_gzip(const std::string& accept_encoding);
/// Whether If-None-Match names the tag.
bool matches_tag(const std::string& if_none_match, const std::string& tag);

/// The bytes that a Range header asks for.
struct ByteRange {
  std::uint64_t first = 0, last = 0;  ///< both included
};
enum class RangeKind {
  kWhole,       ///< no range, several, or none that is understood: the whole file is an answer
  kPart,        ///< `range` is set
  kOutOfReach,  ///< none of its bytes is in the file
};
RangeKind parse_range(const std::string& header, std::uint64_t size, ByteRange& range);

}  // namespace scarp::cli
