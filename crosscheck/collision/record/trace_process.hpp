#pragma once
#include <memory>

#include "crosscheck/files/opened_file.hpp"
#include "crosscheck/record/reading_process.hpp"

namespace lockstep {

/// Starts the process that reads a trace: it tells the contents (trace_messages.hpp), then a state a request. Throws
/// Error where the system refuses.
std::unique_ptr<ReadingProcess> start_trace_process(const OpenedFile& file);

} // namespace lockstep
