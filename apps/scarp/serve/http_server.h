// A small server: one thread for many connections, and a few that make answers. No client can hold up the others.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "scarp/result.h"
#include "serve/http_message.h"

namespace scarp::cli {

class HttpServer {
 public:
  /// `host`: an address or a name of this machine. `port`: 0 for any that is free. Fails with kUsage.
  static Result<HttpServer> listen(const std::string& host, int port);
  HttpServer(HttpServer&& other) noexcept;
  HttpServer& operator=(HttpServer&& other) noexcept;
  ~HttpServer();

  /// "http://127.0.0.1:8080/"
  const std::string& url() const { return url_; }
  /// Most connections that are open at a time, where the process may have twice as many files.
  static constexpr std::size_t kMostConnections = 4096;
  /// Serves until is_over(), which is asked at least twice a second. `answer` is called on `threads` threads, for one
  /// path on one of them at a time. At most kMostConnections are open, or half as many as the process may have files,
  /// each with one request; half of them for one address. Where all are in use, the one that has moved no byte for the
  /// longest is closed; requests that the server works at do not count. A request has kLongestHead and kLongestBody
  /// bytes, and 10 seconds to come; an answer 30 seconds, and one more for each 10 kB, to be received. Where answers of
  /// more than 64 MB wait to be received, those without progress are closed first. Fails with kOutput.
  Result<void> run(const std::function<Response(const Request&)>& answer, int threads,
                   const std::function<bool()>& is_over);

 private:
  HttpServer(int fd, std::string url) : fd_(fd), url_(std::move(url)) {}

  int fd_ = -1;
  std::string url_;
};

}  // namespace scarp::cli
