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
  /// Maximum number of open connections, if the process may open twice as many files.
  static constexpr std::size_t kMostConnections = 4096;
  /// Serves until is_over(), which is polled at least twice a second. `answer` is called on `threads` threads, but only
  /// on one at a time for each path. Limits: at most kMostConnections are open, or half as many as the process may open
  /// files. Each has one request at a time. One address may use half of the connections. If all are in use, the
  /// connection longest without progress is closed, unless the server is working on its request. A request has at most
  /// kLongestHead and kLongestBody bytes and must arrive within 10 seconds. A client must receive an answer within 30
  /// seconds, plus one for each 10 kB. If answers of more than 64 MB wait to be received, connections without progress
  /// are closed first. Fails with kOutput.
  Result<void> run(const std::function<Response(const Request&)>& answer, int threads,
                   const std::function<bool()>& is_over);

 private:
  HttpServer(int fd, std::string url) : fd_(fd), url_(std::move(url)) {}

  int fd_ = -1;
  std::string url_;
};

}  // namespace scarp::cli
