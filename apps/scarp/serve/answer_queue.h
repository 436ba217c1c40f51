// A few threads make the answers, so that a slow answer delays no other client.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "serve/http_message.h"

namespace scarp::cli {

class AnswerQueue {
 public:
  using Answer = std::function<Response(const Request&)>;
  struct Done {
    std::uint64_t client = 0;
    Request request;
    Response response;
  };

  /// `threads`: 0 for all cores. `answer` is called concurrently, but only on one thread for each path, so that later
  /// requests use the finished tile. An exception becomes an answer with status 500.
  AnswerQueue(int threads, Answer answer);
  AnswerQueue(const AnswerQueue&) = delete;
  AnswerQueue& operator=(const AnswerQueue&) = delete;
  /// Waits for answers in progress and drops the others.
  ~AnswerQueue();

  /// Becomes readable when an answer is ready.
  int wake_fd() const { return wake_[0]; }
  /// Queues a request. REQUIRES: no other request of the client is queued.
  void ask(std::uint64_t client, Request request);
  /// Drops the client's request unless work on it has begun.
  void forget(std::uint64_t client);
  std::vector<Done> take();

 private:
  struct Asked {
    std::uint64_t client = 0;
    Request request;
  };
  void work();
  /// The first request for a path on which no thread is working.
  std::list<Asked>::iterator find_next();

  Answer answer_;
  int wake_[2] = {-1, -1};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<Asked> asked_;
  std::set<std::string> paths_at_work_;
  std::vector<Done> done_;
  bool is_over_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace scarp::cli
