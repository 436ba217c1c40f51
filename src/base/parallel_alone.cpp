// parallel.cpp for a machine without threads: runs on the calling thread.
#include <algorithm>

#include "base/parallel.h"

namespace scarp {

int thread_count(int) { return 1; }

void parallel_for(std::size_t count, int, FunctionRef<void(std::size_t)> task) {
  for (std::size_t i = 0; i < count; ++i) task(i);
}

void parallel_for_parts(std::size_t count, std::size_t size, int,
                        FunctionRef<void(std::size_t first, std::size_t end)> task) {
  for (std::size_t first = 0; first < count; first += size) task(first, std::min(count, first + size));
}

void parallel_in_order(std::size_t count, int, FunctionRef<void(std::size_t, std::size_t)> task,
                       FunctionRef<bool(std::size_t)> commit) {
  for (std::size_t i = 0; i < count; ++i) {
    task(i, 0);
    if (!commit(i)) return;
  }
}

void run_beside(int, FunctionRef<void()> beside, FunctionRef<void()> rest) {
  beside();
  rest();
}

}  // namespace scarp
