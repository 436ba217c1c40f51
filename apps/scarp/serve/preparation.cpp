#include "serve/preparation.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "session/text/text.h"

namespace scarp::cli {
namespace {

constexpr std::chrono::seconds kPatience{1};
#ifdef __linux__
constexpr int kLeastUrgent = 19;
#endif

}  // namespace

Preparation::Preparation(jobs::LiveTileSet& set, int threads) {
  std::promise<void> promise;
  done_ = promise.get_future();
  thread_ = std::thread([this, &set, threads, promise = std::move(promise)]() mutable {
    prepare(set, threads);
    promise.set_value();
  });
}

Preparation::~Preparation() {
  is_over_ = true;
  if (done_.wait_for(kPatience) != std::future_status::ready) {
    std::fflush(nullptr);
    std::_Exit(0);
  }
  thread_.join();
}

void Preparation::prepare(jobs::LiveTileSet& set, int threads) const {
#ifdef __linux__
  // Sets the priority of this thread and its children; other systems would change the whole process.
  setpriority(PRIO_PROCESS, 0, kLeastUrgent);
#endif
  const Result<bool> all = set.prepare(threads, [&] { return is_over_.load(); });
  if (is_over_) return;
  if (!all)
    print_warnings({fmt::format("coarse tiles are not prepared: {}", all.error().message)});
  else if (!*all)
    print_warnings({"--memory has no room for all coarse tiles: those left are slow when they are first asked for"});
}

}  // namespace scarp::cli
