// Ctrl-C and its relatives.
#pragma once

namespace scarp::cli {

/// SIGINT, SIGTERM and SIGHUP (unless nohup has it ignored): the first asks the running call to stop (see
/// interrupted()). What has not stopped two seconds later, such as a library that waits for a server, is ended with the
/// sentence and the exit code of an interrupted run, without the temporary files that are being written. The second
/// signal ends the program so at once, as SIGQUIT always does. SIGPIPE and SIGXFSZ are ignored, so that a closed pipe
/// and a full file become errors of the write that met them. Call first thing in main(); with glibc it has been called
/// before, as the first of all code once libraries are loaded.
void install_signal_handlers();

/// True once SIGINT, SIGTERM or SIGHUP has arrived, but for one that content_with_interrupt() took.
bool interrupted();

/// Takes the first of these signals, if it has arrived, as a wish for what there is by now: the run goes on to write
/// it, and the next signal counts as the first. Returns true from then on. May be called by any thread.
bool content_with_interrupt();

/// The run has said its last sentence: what ends it from now on says none.
void keep_interrupts_quiet();

}  // namespace scarp::cli
