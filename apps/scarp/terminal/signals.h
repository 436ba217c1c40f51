// Ctrl-C and its relatives.
#pragma once

namespace scarp::cli {

/// SIGINT, SIGTERM and SIGHUP (unless nohup has it ignored): the first asks the running call to stop (see
/// interrupted()). A run that has not stopped two seconds later, such as a library that waits for a server, is ended
/// with the sentence and the exit code of an interrupted run, without the temporary files that are being written. The
/// second signal ends the program so at once, as SIGQUIT always does. SIGPIPE and SIGXFSZ are ignored, so that a closed
/// pipe and a full file become errors of the write that met them. Call first thing in main(); with glibc it has been
/// called before, as the first of all code once libraries are loaded.
void install_signal_handlers();

/// True once SIGINT, SIGTERM or SIGHUP has arrived, but for one that content_with_interrupt() used up.
bool interrupted();

/// Treats the first of these signals, if it has arrived, as a request for the result so far: the run continues and
/// writes it, and the next signal counts as the first. Returns true from then on. May be called by any thread.
bool content_with_interrupt();

/// The run has printed its last sentence: a signal from now on prints none.
void keep_interrupts_quiet();

}  // namespace scarp::cli
