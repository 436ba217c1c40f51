// Asks the caller at intervals whether to continue.
#pragma once

#include <chrono>

#include "scarp/run.h"

namespace scarp::judge {

class ProgressGate {
 public:
  explicit ProgressGate(const ProgressCallback& callback) : callback_(callback) {}

  /// False if the caller wants to stop. The callback is called at most every 0.2 s, and at the start of each pass.
  bool go_on(std::string_view pass, double fraction, double max_error = 0) {
    if (!callback_ || is_stopped_) return !is_stopped_;
    const auto now = std::chrono::steady_clock::now();
    if (pass == pass_ && now - last_ < std::chrono::milliseconds(200)) return true;
    pass_ = pass;
    last_ = now;
    is_stopped_ = !callback_({pass, fraction, 0, max_error});
    return !is_stopped_;
  }

 private:
  const ProgressCallback& callback_;
  std::string_view pass_;
  std::chrono::steady_clock::time_point last_{};
  bool is_stopped_ = false;
};

}  // namespace scarp::judge
