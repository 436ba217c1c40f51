// The only code that creates threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>

#include "base/function_ref.h"

namespace scarp {

/// Number of worker threads for an option: `requested` if positive, else the machine's cores.
int thread_count(int requested);

/// Calls task(0) … task(count − 1), each once, on `threads` threads (fewer if the machine allows no more). Returns when
/// all have ended. The order of calls is undefined. Each task writes only to its own slot and the caller combines slots
/// in index order, so results never depend on `threads`. If tasks throw, the exception of the lowest index is rethrown
/// once all threads have ended; tasks of higher indices may then have been skipped.
void parallel_for(std::size_t count, int threads, FunctionRef<void(std::size_t)> task);

/// Like parallel_for(), but calls task(first, end) for parts [first, end) of 0 … count − 1; each part except the last
/// has `size` elements.
void parallel_for_parts(std::size_t count, std::size_t size, int threads,
                        FunctionRef<void(std::size_t first, std::size_t end)> task);

/// Calls task(i, worker) for i in 0 … count − 1 as parallel_for() does. `worker`, in 0 … thread_count(threads) − 1,
/// identifies the thread (for scratch memory). Once task i has ended, commit(i) is called on the calling thread, in
/// ascending order; commit() returns false to stop everything. Only a few tasks per thread start ahead of the next
/// commit, so few results wait. Exceptions: as for parallel_for(); an exception of commit() also ends the loop.
void parallel_in_order(std::size_t count, int threads, FunctionRef<void(std::size_t, std::size_t)> task,
                       FunctionRef<bool(std::size_t)> commit);

/// Calls beside() on another thread while the calling thread calls rest(); returns when both have ended. With one
/// thread, or if the machine allows only one, beside() runs first. Neither function may read data that the other
/// writes. Exceptions: as for parallel_for(), with beside() as the lower index.
void run_beside(int threads, FunctionRef<void()> beside, FunctionRef<void()> rest);

/// Lowers `value` to `least` if it is larger. Threads may call this concurrently if none accesses the value in another
/// way.
inline void lower_together(std::uint32_t& value, std::uint32_t least) {
  // std::atomic_ref is missing from some libraries.
  std::uint32_t now = __atomic_load_n(&value, __ATOMIC_RELAXED);
  while (least < now && !__atomic_compare_exchange_n(&value, &now, least, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
  }
}

#ifdef SCARP_WITHOUT_THREADS
struct Mutex {
  void lock() {}
  void unlock() {}
};
#else
using Mutex = std::mutex;
#endif

/// A value that threads access in turn.
template <class T>
class Shared {
 public:
  /// Returns use(value) under the lock.
  template <class Use>
  auto with(Use use) {
    const std::lock_guard<Mutex> lock(mutex_);
    return use(value_);
  }

 private:
  Mutex mutex_;
  T value_;
};

}  // namespace scarp
