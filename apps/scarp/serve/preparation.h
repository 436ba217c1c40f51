// Prepares coarse tiles of a set on demand in the background while the server is idle.
#pragma once

#include <atomic>
#include <future>
#include <thread>

#include "jobs/live_tiles.h"

namespace scarp::cli {

class Preparation {
 public:
  /// Starts immediately, on a thread of low priority. Warns if preparation fails or `set` has no room for all tiles.
  /// Borrows `set`.
  Preparation(jobs::LiveTileSet& set, int threads);
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;
  /// Abandons the remaining tiles. A tile in progress cannot be stopped, so after waiting a second the destructor ends
  /// the program with exit code 0. A server has nothing left to write.
  ~Preparation();

 private:
  void prepare(jobs::LiveTileSet& set, int threads) const;

  std::atomic<bool> is_over_ = false;
  std::future<void> done_;
  std::thread thread_;
};

}  // namespace scarp::cli
