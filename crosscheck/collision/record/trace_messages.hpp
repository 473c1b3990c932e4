#pragma once
#include <cstdint>
#include <string>

#include "crosscheck/collision/record/trace_info.hpp"
#include "crosscheck/record/messages.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// The first messages of a trace: everything but the states after frames. `file`: named in errors. Throws Error for
/// what the reading process could not read, where anything does not fit together, and for what a file of `file_bytes`
/// may not ask for (asked_memory.hpp).
TraceInfo read_contents(ByteSource& source, const std::string& file, std::uint64_t file_bytes = 0);

/// A state that was asked for. `particles` has the trace's number of them, `cdt` its size.
void read_particles(ByteSource& source, const std::string& file, std::uint32_t row, Particles& particles);
void read_cdt(ByteSource& source, const std::string& file, std::uint32_t frame, CollisionImage& cdt);

} // namespace lockstep
