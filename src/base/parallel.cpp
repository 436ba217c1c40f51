#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace scarp {
namespace {

/// The exception of the lowest index among those that tasks threw.
class FirstFailure {
 public:
  explicit FirstFailure(std::size_t count) : index_(count) {}

  /// Every task below the failed ones still runs, so that the one that is kept does not depend on timing.
  bool is_needless(std::size_t i) const { return i > index_.load(); }
  void keep(std::size_t i, std::exception_ptr exception) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (i >= index_.load()) return;
    index_ = i;
    exception_ = std::move(exception);
  }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::atomic<std::size_t> index_;
  std::mutex mutex_;
  std::exception_ptr exception_;
};

/// Joins what it started, whatever happens in between.
class Pool {
 public:
  explicit Pool(std::size_t most) { threads_.reserve(most); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  ~Pool() {
    for (std::thread& thread : threads_) thread.join();
  }

  /// False if the machine has no room for another thread.
  template <class Work>
  bool start(const Work& work) {
    try {
      threads_.emplace_back(work);
      return true;
    } catch (const std::exception&) {
      return false;
    }
  }

 private:
  std::vector<std::thread> threads_;
};

}  // namespace

int thread_count(int requested) {
  if (requested > 0) return requested;
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& task) {
  const std::size_t workers = std::min<std::size_t>(count, static_cast<std::size_t>(thread_count(threads)));
  if (workers <= 1) {
    for (std::size_t i = 0; i < count; ++i) task(i);
    return;
  }
  FirstFailure failure(count);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next.fetch_add(1); i < count; i = next.fetch_add(1)) {
      if (failure.is_needless(i)) continue;
      try {
        task(i);
      } catch (...) {
        failure.keep(i, std::current_exception());
      }
    }
  };
  {
    Pool pool(workers - 1);
    for (std::size_t k = 1; k < workers && pool.start(std::cref(work)); ++k) {
    }
    work();
  }
  failure.rethrow();
}

}  // namespace scarp
