// HTTP/1.1, as far as a server of files needs it.
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
  std::string path;                            ///< decoded, from the first slash on; "*" or empty of the whole server
  std::string query;                           ///< behind the question mark, as it is
  std::map<std::string, std::string> headers;  ///< names in small letters
  bool keeps_alive = true;

  /// Empty if it is not there.
  std::string header(const std::string& name) const;
};

/// Closed after the last answer that uses it.
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

/// A part of a file, in place of a body.
struct FilePart {
  std::shared_ptr<const OpenFile> file;
  std::uint64_t offset = 0, length = 0;
};

struct Response {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers;
  std::vector<std::uint8_t> body;
  FilePart file;  ///< in place of the body where it has a file

  std::uint64_t length() const { return file.file ? file.length : body.size(); }
};

std::string lowered(std::string_view text);
/// Without the spaces and tabs around it.
std::string_view trimmed(std::string_view text);
/// The text before the separator, or all; both are removed from the text.
std::string_view take_until(std::string_view& text, char separator);

/// Status and headers, Date, Content-Length and Connection included.
std::string write_head(const Response& response, bool keeps_alive);

/// A sentence for people.
Response text_response(int status, const std::string& sentence);

/// True if Accept-Encoding accepts gzip.
bool accepts_gzip(const std::string& accept_encoding);
/// True if If-None-Match names the tag.
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
