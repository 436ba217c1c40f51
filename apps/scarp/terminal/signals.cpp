#include "terminal/signals.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

#include "scarp/io.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

// These are lock-free, so that handlers may use them.
std::atomic<int> g_signals = 0;
std::atomic<bool> g_is_content = false, g_is_told = false;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

constexpr unsigned kSecondsToStop = 2;

void remove_half_written() {
  for (int place = 0; place < scarp::kPendingOutputs; ++place) {
    const char* half_written = pending_output(place);
    if (half_written[0] != '\0') unlink(half_written);
  }
}

/// Deletes half-written files, then performs the default action, so that a shell sees the signal.
extern "C" void on_end_signal(int signal) {
  remove_half_written();
  std::signal(signal, SIG_DFL);
  raise(signal);  // acts when this handler returns
}

/// Ends a run that did not stop by itself because it waits in a library or for a pipe.
extern "C" void on_late_stop(int) {
  if (outputs_naming() == Naming::kNow) {
    alarm(1);
    return;
  }
  remove_half_written();
  constexpr std::string_view kNothing = "scarp: interrupted; nothing was written\n", kSome = "scarp: interrupted\n";
  const std::string_view sentence = outputs_naming() == Naming::kDone ? kSome : kNothing;
  [[maybe_unused]] const ssize_t said = g_is_told ? 0 : write(STDERR_FILENO, sentence.data(), sentence.size());
  _exit(exit_code(ErrorKind::kCancelled));
}

extern "C" void on_stop_signal(int signal) {
  const int taken = g_is_content ? 1 : 0;
  if (g_signals.fetch_add(1) > taken) {
    on_end_signal(signal);
  } else {
    alarm(kSecondsToStop);
  }
}

}  // namespace

void install_signal_handlers() {
  struct sigaction action = {};
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  action.sa_handler = on_end_signal;
  sigaction(SIGQUIT, &action, nullptr);
  action.sa_handler = on_late_stop;
  sigaction(SIGALRM, &action, nullptr);
  action.sa_handler = on_stop_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction inherited = {};
  const bool is_nohup = sigaction(SIGHUP, nullptr, &inherited) == 0 && inherited.sa_handler == SIG_IGN;
  if (!is_nohup) sigaction(SIGHUP, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

// Loaded libraries need time for initialization before main(), so handlers are installed even earlier if the system
// allows. Sanitizers are not ready that early.
#if defined(__has_feature)
#define SCARP_HAS_FEATURE(name) __has_feature(name)
#else
#define SCARP_HAS_FEATURE(name) 0
#endif
#if defined(__ELF__) && defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && \
    !SCARP_HAS_FEATURE(address_sanitizer) && !SCARP_HAS_FEATURE(thread_sanitizer) &&                             \
    !SCARP_HAS_FEATURE(memory_sanitizer)
[[gnu::used, gnu::section(".preinit_array")]] static void (*const g_first_of_all)() = install_signal_handlers;
#endif

bool interrupted() { return g_signals > (g_is_content ? 1 : 0); }

bool content_with_interrupt() {
  if (g_signals > 0 && !g_is_content.exchange(true)) alarm(0);
  return g_is_content;
}

void keep_interrupts_quiet() { g_is_told = true; }

}  // namespace scarp::cli
