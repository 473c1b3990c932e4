#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "crosscheck/collision/record/trace_info.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// What the process that reads a trace tells the one that asked for it (trace_process.hpp). Nothing of it is trusted:
/// the reading process may have been taken over by the file it reads.
enum class MessageKind : std::uint32_t {
    error,         ///< a text
    contents,      ///< JSON: sizes, texts and warnings
    positions,     ///< of the obstacles' corners
    triangles,     ///< their indices
    reciprocals,   ///< int8, root_offsets.hpp
    inverse_sqrts, ///< int8
    particles,     ///< one row: all values of the first field, then of the second, and so on
    cdt,           ///< one frame
};

/// Comes before every message's bytes.
struct MessageHead {
    MessageKind kind = MessageKind::error;
    std::uint32_t index = 0; ///< row or frame
    std::uint64_t bytes = 0;
};

/// Which states are wanted.
struct Request {
    MessageKind kind = MessageKind::particles; ///< particles or cdt
    std::uint32_t index = 0;
};

/// Where messages come from.
class ByteSource {
  public:
    ByteSource() = default;
    virtual ~ByteSource() = default;
    ByteSource(const ByteSource&) = delete;
    ByteSource& operator=(const ByteSource&) = delete;
    /// Fills `into`. Throws Error where there are no more bytes.
    virtual void read(void* into, std::size_t bytes) = 0;
};

/// The first messages of a trace: everything but the states after frames. `file`: named in errors. Throws Error for
/// what the reading process could not read, where anything does not fit together, and for what a file of `file_bytes`
/// may not ask for (asked_memory.hpp).
TraceInfo read_contents(ByteSource& source, const std::string& file, std::uint64_t file_bytes = 0);

/// A state that was asked for. `particles` has the trace's number of them, `cdt` its size.
void read_particles(ByteSource& source, const std::string& file, std::uint32_t row, Particles& particles);
void read_cdt(ByteSource& source, const std::string& file, std::uint32_t frame, CollisionImage& cdt);

} // namespace lockstep
