#pragma once
#include <chrono>

#include "crosscheck/files/opened_file.hpp"

namespace lockstep {

/// The process that reads a trace: all that libhdf5 does with a file's bytes happens in it. It has that one file open
/// and can open no other, write none, start no process, and use so much memory and time (syscall_fence.hpp, setrlimit);
/// what it makes of the file it tells through a pipe (trace_messages.hpp). Where it breaks, the asking process gets an
/// Error.
struct TraceProcess {
    int pid = -1;
    int requests = -1; ///< socket: Request after Request; closing it ends the process
    int answers = -1;  ///< pipe: the contents, then one message a request
};

/// Forks. Throws Error where the system refuses.
TraceProcess start_trace_process(const OpenedFile& file);

/// Ends and reaps it, after giving it so long to end by itself. Gives the signal that it then died of, or 0.
int end_trace_process(TraceProcess& process, std::chrono::milliseconds grace);

} // namespace lockstep
