#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "gpu/bound_storage.hpp"
#include "gpu/gl_system.hpp"
#include "gpu/program.hpp"
#include "gpu/record_buffer.hpp"

namespace lockstep {

/// The fields of a buffer that lie in one GL buffer: all of them in two copies, or those of a block, changed in place.
struct SystemStorage {
    RecordLayout layout;
    std::string block; ///< empty: BufferBefore and BufferAfter
};

/// The storages of a schema, buffer by buffer.
std::vector<SystemStorage> storages_of(const Schema& schema);

/// The storage block through which a pass reads it, or writes it.
std::string block_of(const Schema& schema, const SystemStorage& storage, bool after);

/// A storage block of a program, at the binding point of its place among them.
struct BoundBlock {
    enum class Kind : std::uint8_t { before, after, in_place, data };
    Kind kind;
    std::size_t storage = 0; ///< its number
    std::string name;        ///< of data
};

/// Those in two copies, which a shader's own blocks can be bound to by member.
std::vector<RecordBlocks> blocks_of_records(const Schema& schema, const std::vector<SystemStorage>& storages);

/// Gives every storage block of the program its binding point, by name or by the bindings beside the shader; those
/// bound by member have the last. Throws Error for one that nothing is given for.
std::vector<BoundBlock> bind_blocks(const Program& program, const Schema& schema,
                                    const std::vector<SystemStorage>& storages, const GlPass& pass);

} // namespace lockstep
