// The one place that knows threads.
#pragma once

#include <cstddef>
#include <functional>

namespace scarp {

/// Worker threads meant by an option: `requested` if positive, else the machine's cores.
int thread_count(int requested);

/// Calls task(0) … task(count − 1), each once, on `threads` threads (on fewer if the machine gives no more); returns
/// when all have ended. The order of calls is not defined: a task writes to its own place only, and the caller combines
/// places in index order, so that results never depend on `threads`. If tasks throw, the exception of the lowest index
/// is rethrown here once all threads have ended; tasks of higher indices may then have been left out.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& task);

}  // namespace scarp
