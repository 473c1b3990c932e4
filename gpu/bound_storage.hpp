#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/bindings.hpp"
#include "gpu/gl.hpp"
#include "gpu/object.hpp"
#include "gpu/record_buffer.hpp"

namespace lockstep {

/// Two copies of a buffer of ours by the names of their storage blocks.
struct RecordBlocks {
    std::string before, after;
    const RecordLayout* layout = nullptr;
};

/// Storage blocks of a shader from elsewhere, filled and read back member by member, whatever their layout (std430,
/// std140, shared): GL says where each member lies (GL_BUFFER_VARIABLE). Copies on the CPU before and after a dispatch.
class BoundStorage {
  public:
    BoundStorage() = default; ///< of nothing
    /// The active blocks of `program` that `bindings` bind by member. Their members are "Before.speed", "After.speed",
    /// or "speed" of a block that is changed in place; numbers; or "count", how many items there are. `layouts` of
    /// `ours` outlive this. Throws Error with the file and the path in it for a member that the block does not have, or
    /// that has no value, for a name that is none of ours, for types that do not fit, and for a field of ours that a
    /// block takes in part.
    BoundStorage(GLuint program, std::shared_ptr<const Bindings> bindings, std::vector<RecordBlocks> ours);

    /// Whether the program has the block, and it is one of these.
    [[nodiscard]] bool has(std::string_view block) const;

    /// Whether a member of any of them reads, or writes, the buffer.
    [[nodiscard]] bool reads(std::size_t ours) const { return reads_.contains(ours); }
    [[nodiscard]] bool writes(std::size_t ours) const { return writes_.contains(ours); }

    /// Fills the blocks from our buffers, one each of `ours`, and binds each to the binding point of its own.
    void fill(std::span<const RecordBuffer* const> before, std::span<const RecordBuffer* const> after) const;
    /// What the blocks hold now, into our buffers.
    void collect(std::span<const RecordBuffer* const> after) const;

  private:
    /// Where a word of each item comes from, and goes to.
    struct Word {
        enum class Kind : std::uint8_t { before, after, in_place, constant, count };
        Kind kind = Kind::constant;
        std::size_t ours = 0, place = 0; ///< word of a record
        std::uint32_t bits = 0;
    };
    struct Member {
        std::string name, path;
        GLenum type = 0;
        std::size_t offset = 0, stride = 0; ///< in words; stride 0: one for all items
        std::size_t elements = 0;           ///< 0: as many as there are
        std::vector<Word> words;
    };
    struct Block {
        std::string name;
        GLuint binding = 0;
        std::vector<Member> members;
        GlBuffer buffer = {};
    };

    /// A field of ours, as the file names it.
    struct Name {
        std::string name;
        Word::Kind kind;
        std::size_t ours, place; ///< word of a record
        Scalar scalar;
        int components;
        bool whole; ///< field, not one component of it
    };

    void add_names(std::size_t ours);
    void add_block(GLuint program, GLuint block, const std::string& name, const StorageBlockBinding& binding);
    [[nodiscard]] Member member_of(GLuint program, GLuint variable) const;
    void add_words(Member& member, const UniformBinding& binding);
    void check_written() const;
    [[nodiscard]] std::size_t words_in(const Block& block, std::size_t items) const;

    std::shared_ptr<const Bindings> bindings_;
    std::vector<RecordBlocks> ours_;
    std::vector<Name> names_;
    std::vector<Block> blocks_;
    std::set<std::size_t> reads_, writes_;
};

} // namespace lockstep
