// Ctrl-C and its relatives.
#pragma once

namespace scarp::cli {

/// SIGINT, SIGTERM and SIGHUP (unless nohup has it ignored): the first asks the running call to stop (see
/// interrupted()), the second removes the temporary file that is being written and ends the program at once, as SIGQUIT
/// always does. SIGPIPE and SIGXFSZ are ignored, so that a closed pipe and
/// a full file become errors of the write that met them. Call once, first thing in main().
void install_signal_handlers();

/// True once SIGINT, SIGTERM or SIGHUP has arrived.
bool interrupted();

}  // namespace scarp::cli
