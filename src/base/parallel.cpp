#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace scarp {
namespace {

/// The exception of the lowest index among those thrown by tasks.
class FirstFailure {
 public:
  explicit FirstFailure(std::size_t count) : index_(count) {}

  /// All tasks below the failed ones still run, so the reported failure does not depend on timing.
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

/// Joins its threads on destruction.
class Pool {
 public:
  explicit Pool(std::size_t most) { threads_.reserve(most); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  ~Pool() {
    for (std::thread& thread : threads_) thread.join();
  }

  /// False if no further thread can be created.
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

void parallel_for(std::size_t count, int threads, FunctionRef<void(std::size_t)> task) {
  const std::size_t workers =
      count <= 1 ? count : std::min<std::size_t>(count, static_cast<std::size_t>(thread_count(threads)));
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

void parallel_for_parts(std::size_t count, std::size_t size, int threads,
                        FunctionRef<void(std::size_t first, std::size_t end)> task) {
  parallel_for((count + size - 1) / size, threads,
               [&](std::size_t part) { task(part * size, std::min(count, (part + 1) * size)); });
}

void run_beside(int threads, FunctionRef<void()> beside, FunctionRef<void()> rest) {
  FirstFailure failure(2);
  const auto run = [&](std::size_t i, FunctionRef<void()> task) {
    if (failure.is_needless(i)) return;
    try {
      task();
    } catch (...) {
      failure.keep(i, std::current_exception());
    }
  };
  {
    Pool pool(1);
    const auto first = [&] { run(0, beside); };
    if (thread_count(threads) == 1 || !pool.start(first)) first();
    run(1, rest);
  }
  failure.rethrow();
}

namespace {

/// The started, ended and committed tasks.
class TaskOrder {
 public:
  TaskOrder(std::size_t count, std::size_t ahead) : ended_(count, false), ahead_(ahead) {}

  /// The next task; nothing if none is left. With `may_wait`, waits for commits while too many tasks are uncommitted.
  std::optional<std::size_t> start(bool may_wait) {
    std::unique_lock<std::mutex> lock(mutex_);
    const auto is_free = [this] { return is_over() || next_ < committed_ + ahead_; };
    if (may_wait) changed_.wait(lock, is_free);
    if (is_over() || !is_free()) return std::nullopt;
    return next_++;
  }
  void end(std::size_t i) {
    change([&] { ended_[i] = true; });
  }
  void stop() {
    change([&] { stopped_ = true; });
  }
  void fail(std::size_t i, std::exception_ptr exception) {
    change([&] {
      stopped_ = true;
      if (failure_ && failed_ < i) return;
      failed_ = i;
      failure_ = std::move(exception);
    });
  }
  /// The task to commit next, if it has ended; with `may_wait`, waits for its end. Nothing if no task is left, or all
  /// are stopped.
  std::optional<std::size_t> ready(bool may_wait) {
    std::unique_lock<std::mutex> lock(mutex_);
    const auto is_ready = [this] { return stopped_ || committed_ == ended_.size() || ended_[committed_]; };
    if (may_wait) changed_.wait(lock, is_ready);
    if (stopped_ || committed_ == ended_.size() || !ended_[committed_]) return std::nullopt;
    return committed_;
  }
  void commit() {
    change([&] { ++committed_; });
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  bool is_over() const { return stopped_ || next_ == ended_.size(); }
  template <class Change>
  void change(const Change& apply) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      apply();
    }
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<bool> ended_;
  std::size_t ahead_, next_ = 0, committed_ = 0, failed_ = 0;
  bool stopped_ = false;
  std::exception_ptr failure_;
};

}  // namespace

void parallel_in_order(std::size_t count, int threads, FunctionRef<void(std::size_t, std::size_t)> task,
                       FunctionRef<bool(std::size_t)> commit) {
  const std::size_t workers = std::min<std::size_t>(count, static_cast<std::size_t>(thread_count(threads)));
  TaskOrder order(count, 4 * workers);
  const auto run = [&](std::size_t i, std::size_t worker) {
    try {
      task(i, worker);
      order.end(i);
    } catch (...) {
      order.fail(i, std::current_exception());
    }
  };
  const auto commit_ready = [&](bool may_wait) {
    const auto i = order.ready(may_wait);
    if (!i) return false;
    try {
      if (!commit(*i)) order.stop();
    } catch (...) {
      order.fail(*i, std::current_exception());
    }
    order.commit();
    return true;
  };
  {
    Pool pool(workers);
    for (std::size_t k = 1; k < workers; ++k) {
      const auto work = [&, k] {
        while (const auto i = order.start(true)) run(*i, k);
      };
      if (!pool.start(work)) break;
    }
    for (;;) {
      while (commit_ready(false)) {
      }
      if (const auto i = order.start(false)) {
        run(*i, 0);
      } else if (!commit_ready(true)) {
        break;
      }
    }
  }
  order.rethrow();
}

}  // namespace scarp
