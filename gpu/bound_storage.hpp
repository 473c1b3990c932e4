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
#include "gpu/interface_block.hpp"
#include "gpu/object.hpp"
#include "gpu/program.hpp"
#include "gpu/record_buffer.hpp"

namespace lockstep {

/// Two copies of a buffer of ours by the names of their storage blocks.
struct RecordBlocks {
    std::string before, after;
    const RecordLayout* layout = nullptr;
    std::string both = {}; ///< of the two where a block is changed in place; may be empty if there is one buffer
};

/// Storage blocks of a shader from elsewhere, filled and read back member by member, whatever their layout (std430,
/// std140, shared): GL says where each member lies (GL_BUFFER_VARIABLE). Copies on the CPU before and after a dispatch.
class BoundStorage {
  public:
    BoundStorage() = default; ///< of nothing
    /// The active blocks of `program` that its bindings bind by member. A member is an array, or in an array of
    /// structures: element i is of item i. It holds "Before.speed", "After.speed", or "speed" of a block that is
    /// changed in place ("Both.speed" where there are several buffers); numbers; or "count", how many items there are.
    /// `layouts` of `ours` outlive this. Throws Error with the file and the path in it for a member that the block does
    /// not have, or that has no value, for a name that is none of ours, for types that do not fit, and for a field of
    /// ours that is written in part, or twice.
    BoundStorage(const Program& program, std::vector<RecordBlocks> ours);

    /// Whether it has blocks that take a state, but none that gives one back.
    [[nodiscard]] bool only_reads() const { return !reads_.empty() && writes_.empty(); }

    /// Fills the blocks from our buffers, one each of `ours`, and binds each to the binding point of its own.
    void fill(std::span<const RecordBuffer* const> before, std::span<const RecordBuffer* const> after) const;
    /// What the blocks hold now, into our buffers. Throws Error, its text after `when`, where the program wrote behind
    /// the items of a block.
    void collect(std::span<const RecordBuffer* const> after, std::string_view when = "") const;

  private:
    /// Where a word of each item comes from, and goes to.
    struct Word {
        enum class Kind : std::uint8_t { before, after, in_place, constant, count };
        Kind kind = Kind::constant;
        std::size_t ours = 0, place = 0; ///< word of a record
        std::uint32_t bits = 0;          ///< of a constant
        bool as_float = false;           ///< of a count
        std::size_t at = 0;              ///< words behind the element's first
    };
    struct Member {
        std::string name, path;
        GLenum type = 0;
        std::size_t offset = 0, stride = 0;    ///< in words, from item to item; stride 0: one for all items
        std::size_t elements = 0;              ///< items there is room for; 0: no size is declared
        std::size_t parts = 1, part_words = 0; ///< of an array in each item
        bool plain = false;                    ///< an array, not of structures
        std::vector<Word> words = {};
    };
    struct Block {
        std::string name;
        GLuint binding = 0;
        std::size_t least = 0;       ///< words that GL asks for
        bool ends_with_last = false; ///< the length() of an array of it is asked for
        std::vector<Member> members = {};
        GlBuffer buffer = {};
    };

    /// A field of ours, as the file names it.
    struct Name {
        std::string name;
        Word::Kind kind;
        std::size_t ours, place; ///< word of a record
        Scalar scalar;
        int components;
        bool listed; ///< where an error says what is right
    };

    void add_names(std::size_t ours);
    void add_block(const InterfaceBlock& block, const StorageBlockBinding& binding, bool ends_with_last);
    void add_words(Member& member, const MemberBinding& binding);
    void add_name(Member& member, const std::string& path, const std::string& name);
    void settle_counts(Block& block, const std::string& path) const;
    void check_written() const;
    [[nodiscard]] static std::size_t items_of(const Block& block, std::span<const RecordBuffer* const> buffers);
    [[nodiscard]] std::size_t words_of(const Block& block, std::size_t items) const;
    [[nodiscard]] std::size_t margin_words(const Block& block) const;
    void check_end(const Block& block, const std::vector<std::uint32_t>& words,
                   std::span<const RecordBuffer* const> buffers, std::string_view when) const;

    std::shared_ptr<const Bindings> bindings_;
    std::string writer_;    ///< the program and its file
    std::size_t group_ = 1; ///< invocations
    std::vector<RecordBlocks> ours_;
    std::vector<Name> names_;
    std::vector<Block> blocks_;
    std::set<std::size_t> reads_, writes_;
};

/// An active storage block of a program, by the bindings beside its shaders.
struct StorageBlock {
    std::string name; ///< the shader's
    std::string ours; ///< empty: bound by member; the same name where the bindings do not have it
    bool bound;       ///< the bindings have it
};

/// Whether a program asks the length() of an array of its block, by binding points 0 to `points` - 1.
std::vector<bool> lengths_asked(const Program& program, std::size_t points);

/// Those of a program, in GL's order. Throws Error with the file and the path in it for one that is bound to what is
/// none of `ours`.
std::vector<StorageBlock> storage_blocks(const Program& program, std::span<const std::string> ours);

/// Gives each storage block of a program its binding point: a block that the bindings beside it say is `ours[i]` gets
/// i, one that they bind by member of `records` a point behind `reserved`, which the result fills; others keep theirs.
/// Throws Error for a block at a point that is none of these, and for one that has, it seems, no point of its own.
BoundStorage bind_storage(const Program& program, std::span<const std::string> ours, std::size_t reserved,
                          const RecordBlocks& records);

} // namespace lockstep
