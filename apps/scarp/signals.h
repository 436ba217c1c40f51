// Ctrl-C and its relatives.
#pragma once

namespace scarp::cli {

/// SIGINT and SIGTERM: the first asks the running call to stop (see interrupted()), the second removes the temporary
/// file that is being written and ends the program at once. SIGPIPE and SIGXFSZ are ignored, so that a closed pipe and
/// a full file become errors of the write that met them. Call once, first thing in main().
void install_signal_handlers();

/// True once SIGINT or SIGTERM has arrived.
bool interrupted();

}  // namespace scarp::cli
