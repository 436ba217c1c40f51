#include "signals.h"

#include <unistd.h>

#include <csignal>

#include "scarp/io.h"

namespace scarp::cli {
namespace {

volatile std::sig_atomic_t g_interrupted = 0;

/// The default action, so that a shell sees a program ended by the signal, but without half a file left.
extern "C" void on_end_signal(int signal) {
  const char* half_written = pending_output();
  if (half_written[0] != '\0') unlink(half_written);
  std::signal(signal, SIG_DFL);
  raise(signal);  // acts when this handler returns
}

extern "C" void on_stop_signal(int signal) {
  if (g_interrupted != 0) return on_end_signal(signal);
  g_interrupted = 1;
}

}  // namespace

void install_signal_handlers() {
  struct sigaction action = {};
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  action.sa_handler = on_end_signal;
  sigaction(SIGQUIT, &action, nullptr);
  action.sa_handler = on_stop_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction inherited = {};
  const bool is_nohup = sigaction(SIGHUP, nullptr, &inherited) == 0 && inherited.sa_handler == SIG_IGN;
  if (!is_nohup) sigaction(SIGHUP, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() { return g_interrupted != 0; }

}  // namespace scarp::cli
