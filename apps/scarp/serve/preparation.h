// Coarse tiles of a set that is made on demand, made in the background while the server has time.
#pragma once

#include <atomic>
#include <future>
#include <thread>

#include "jobs/live_tiles.h"

namespace scarp::cli {

class Preparation {
 public:
  /// Begins at once, on a thread that yields the processor to others. Where it fails, or `set` has no room for all, it
  /// warns. The set must stay alive.
  Preparation(LiveTileSet& set, int threads);
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;
  /// Ends what is not done yet. A tile that is being made cannot be stopped: after a second the program ends with exit
  /// code 0 where it is, for a server has nothing more to do or to write.
  ~Preparation();

 private:
  void prepare(LiveTileSet& set, int threads) const;

  std::atomic<bool> is_over_ = false;
  std::future<void> done_;
  std::thread thread_;
};

}  // namespace scarp::cli
