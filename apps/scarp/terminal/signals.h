// Ctrl-C and similar signals.
#pragma once

namespace scarp::cli {

/// Handles SIGINT, SIGTERM and SIGHUP (unless nohup ignores it). The first signal asks the running call to stop (see
/// interrupted()). If the call still runs two seconds later, for example waiting for a server, the program ends with
/// the message and exit code of an interrupted run and deletes its temporary files. A second signal, or SIGQUIT, ends
/// the program immediately in this way. SIGPIPE and SIGXFSZ are ignored: writes to a closed pipe or a full file fail
/// instead. Call first in main(); with glibc it runs even earlier, before all other code.
void install_signal_handlers();

/// True after SIGINT, SIGTERM or SIGHUP, unless content_with_interrupt() consumed it.
bool interrupted();

/// Treats the first of these signals, if any, as a request for the result so far: the run continues and writes it. The
/// next signal counts as the first. Returns true from then on. May be called on any thread.
bool content_with_interrupt();

/// Call after the last message: later signals print none.
void keep_interrupts_quiet();

}  // namespace scarp::cli
