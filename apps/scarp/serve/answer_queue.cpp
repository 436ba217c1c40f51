#include "serve/answer_queue.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <exception>
#include <system_error>
#include <utility>

namespace scarp::cli {

AnswerQueue::AnswerQueue(int threads, Answer answer) : answer_(std::move(answer)) {
  if (::pipe2(wake_, O_CLOEXEC | O_NONBLOCK) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const int count = threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  for (int k = 0; k < count; ++k) threads_.emplace_back([this] { work(); });
}

AnswerQueue::~AnswerQueue() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  for (const int fd : wake_) ::close(fd);
}

void AnswerQueue::ask(std::uint64_t client, Request request) {
  {
    const std::lock_guard lock(mutex_);
    asked_.push_back({client, std::move(request)});
  }
  changed_.notify_one();
}

void AnswerQueue::forget(std::uint64_t client) {
  const std::lock_guard lock(mutex_);
  asked_.remove_if([&](const Asked& one) { return one.client == client; });
}

std::vector<AnswerQueue::Done> AnswerQueue::take() {
  std::array<char, 256> bytes;
  while (::read(wake_[0], bytes.data(), bytes.size()) > 0) continue;
  const std::lock_guard lock(mutex_);
  return std::exchange(done_, {});
}

std::list<AnswerQueue::Asked>::iterator AnswerQueue::find_next() {
  return std::find_if(asked_.begin(), asked_.end(),
                      [&](const Asked& one) { return paths_at_work_.count(one.request.path) == 0; });
}

void AnswerQueue::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return is_over_ || find_next() != asked_.end(); });
    if (is_over_) return;
    const auto next = find_next();
    Done done{next->client, std::move(next->request), {}};
    asked_.erase(next);
    const std::string path = done.request.path;
    paths_at_work_.insert(path);
    lock.unlock();
    try {
      done.response = answer_(done.request);
    } catch (const std::exception&) {
      done.response = text_response(500, "this machine has not the memory for it just now");
    }
    lock.lock();
    paths_at_work_.erase(path);
    done_.push_back(std::move(done));
    // Another request for this path may be waiting.
    changed_.notify_all();
    const char byte = 0;
    // A full pipe also wakes the reader.
    [[maybe_unused]] const ssize_t woken = ::write(wake_[1], &byte, 1);
  }
}

}  // namespace scarp::cli
