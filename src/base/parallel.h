// The one place that knows threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>

#include "base/function_ref.h"

namespace scarp {

/// Worker threads meant by an option: `requested` if positive, else the machine's cores.
int thread_count(int requested);

/// Calls task(0) … task(count − 1), each once, on `threads` threads (on fewer if the machine gives no more); returns
/// when all have ended. The order of calls is not defined: a task writes to its own place only, and the caller combines
/// places in index order, so that results never depend on `threads`. If tasks throw, the exception of the lowest index
/// is rethrown here once all threads have ended; tasks of higher indices may then have been skipped.
void parallel_for(std::size_t count, int threads, FunctionRef<void(std::size_t)> task);

/// Calls task(first, end) for the parts [first, end) of 0 … count − 1, each of `size` but the last, as parallel_for()
/// does.
void parallel_for_parts(std::size_t count, std::size_t size, int threads,
                        FunctionRef<void(std::size_t first, std::size_t end)> task);

/// Calls task(i, worker) for i in 0 … count − 1 as parallel_for() does, with worker in 0 … thread_count(threads) − 1
/// naming the thread (for scratch memory), and commit(i) in ascending order, on the calling thread only, once task i
/// has ended; commit returns false to stop everything. No task starts more than a few places per thread before the next
/// commit, so that uncommitted results stay few. Exceptions: as parallel_for(); those of commit end the loop too.
void parallel_in_order(std::size_t count, int threads, FunctionRef<void(std::size_t, std::size_t)> task,
                       FunctionRef<bool(std::size_t)> commit);

/// Calls beside() on a thread of its own while the calling thread calls rest(); returns when both have ended. With one
/// thread (or where the machine gives no more) beside() comes first. Neither reads what the other writes. Exceptions:
/// as parallel_for(), beside() being of the lower index.
void run_beside(int threads, FunctionRef<void()> beside, FunctionRef<void()> rest);

/// Lowers `value` to `least` if it is larger. Threads may do this at once while none reads or writes it otherwise.
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

/// A value that threads use one after the other.
template <class T>
class Shared {
 public:
  /// Returns use(value) while no other thread has it.
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
