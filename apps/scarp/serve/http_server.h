// A small server: one thread for all connections, and a few threads that make answers. No client can block the others.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "scarp/result.h"
#include "serve/http_message.h"

namespace scarp::cli {

class HttpServer {
 public:
  /// `host`: an address or name of this machine. `port`: 0 for any free port. Fails with kUsage.
  static Result<HttpServer> listen(const std::string& host, int port);
  HttpServer(HttpServer&& other) noexcept;
  HttpServer& operator=(HttpServer&& other) noexcept;
  ~HttpServer();

  /// "http://127.0.0.1:8080/"
  const std::string& url() const { return url_; }
  /// Maximum of open connections, if the process may open twice as many files.
  static constexpr std::size_t kMostConnections = 4096;
  /// Serves until is_over(), polled at least twice a second. `answer` is called on `threads` threads, but only on one
  /// at a time for each path.
  /// Limits: kMostConnections, or half of the files that the process may open, each with one request; half of them for
  /// one address. If all are in use, the connection longest without progress is closed, unless the server is working on
  /// its request. A request has at most kLongestHead and kLongestBody bytes and 10 seconds to arrive. An answer has 30
  /// seconds to be received, plus one for each 10 kB. If answers of more than 64 MB wait to be received, connections
  /// without progress are closed first. Fails with kOutput.
  Result<void> run(const std::function<Response(const Request&)>& answer, int threads,
                   const std::function<bool()>& is_over);

 private:
  HttpServer(int fd, std::string url) : fd_(fd), url_(std::move(url)) {}

  int fd_ = -1;
  std::string url_;
};

}  // namespace scarp::cli
