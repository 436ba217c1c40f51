#include "signals.h"

#include <unistd.h>

#include <csignal>

#include "scarp/io.h"

namespace scarp::cli {
namespace {

volatile std::sig_atomic_t g_interrupted = 0;

extern "C" void on_stop_signal(int signal) {
  if (g_interrupted == 0) {
    g_interrupted = 1;
    return;
  }
  const char* half_written = pending_output();
  if (half_written[0] != '\0') unlink(half_written);
  // The default action, so that a shell sees a program ended by the signal. It acts when this handler returns.
  std::signal(signal, SIG_DFL);
  raise(signal);
}

}  // namespace

void install_signal_handlers() {
  struct sigaction stop = {};
  stop.sa_handler = on_stop_signal;
  sigemptyset(&stop.sa_mask);
  stop.sa_flags = SA_RESTART;
  sigaction(SIGINT, &stop, nullptr);
  sigaction(SIGTERM, &stop, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() { return g_interrupted != 0; }

}  // namespace scarp::cli
