#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gpu/object.hpp"
#include "gpu/program.hpp"
#include "gpu/storage_range.hpp"
#include "reference/model/schema.hpp"
#include "reference/model/state_view.hpp"

namespace lockstep {

/// How a GL buffer holds fields of a buffer of a schema: a record an item, one field after the other without gaps, or
/// where the schema says (Field::at).
struct RecordLayout {
    struct Member {
        std::uint8_t field = 0;
        std::string name; ///< in shaders, after a_, v_ or out_: "Position"
    };
    const Schema* schema = nullptr;
    std::uint8_t resource = 0;
    std::vector<Member> members;

    [[nodiscard]] const Resource& about() const { return schema->resources[resource]; }
    [[nodiscard]] const Field& field(const Member& member) const { return about().fields[member.field]; }
    [[nodiscard]] std::size_t words() const; ///< of a record
    [[nodiscard]] bool has_gaps() const;     ///< words that are no member's
    [[nodiscard]] std::size_t bytes() const { return words() * sizeof(std::uint32_t); }
    /// Calls `visit(member, its first word in a record)`.
    template <class Visit> void for_each_member(const Visit& visit) const {
        std::size_t next = 0;
        for (const Member& member : members) {
            const std::size_t first = field(member).at.value_or(static_cast<std::uint32_t>(next));
            visit(member, first);
            next = first + static_cast<std::size_t>(field(member).components);
        }
    }
    [[nodiscard]] bool has(FieldId id) const;

    /// What a program that writes such records captures: out_ and the name, in the records' order.
    [[nodiscard]] std::vector<Capture> captures() const;
};

/// GL_FLOAT_VEC3 of three floats.
GLenum gl_type(const Field& field);

struct StagedSlices; ///< the host's memory that a large buffer is read through

/// `count` records in GL memory; record i at byte i * layout.bytes(). Contents are undefined at first.
class RecordBuffer {
  public:
    /// `layout` outlives this. `spare` records more lie behind, a margin. Throws Error if GL has not the memory.
    RecordBuffer(const RecordLayout& layout, std::size_t count, std::size_t spare = 0);
    RecordBuffer(RecordBuffer&&) noexcept;
    RecordBuffer& operator=(RecordBuffer&&) noexcept;
    ~RecordBuffer();

    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] GLuint id() const { return buffer_.id(); }
    [[nodiscard]] const RecordLayout& layout() const { return *layout_; }

    /// Bit for bit; `state` has size() items.
    void upload(const View& state);
    void read(const WritableView& state) const;

    /// Whether it has exactly these bits, without a copy.
    [[nodiscard]] bool holds(const View& state) const;

    /// Every 32-bit word becomes `word`: what a pass did not write then shows.
    void fill(std::uint32_t word);

    /// The same records as `other`, of its layout and size. The spare ones stay.
    void copy(const RecordBuffer& other);

    /// As a storage block of this name; its margin is the spare records.
    [[nodiscard]] StorageRange range(std::string block) const;

    /// Three words from byte `place` on.
    [[nodiscard]] std::array<std::uint32_t, 3> three_words(std::size_t place) const;

    /// Binds the buffer as what transform feedback writes to.
    void bind_capture() const;

  private:
    GlBuffer buffer_;
    const RecordLayout* layout_;
    std::size_t count_, spare_;
    mutable std::unique_ptr<StagedSlices> staged_; ///< once a large one was read
};

/// Whether buffers that have the fields of `state` among them have exactly its bits, and none of its floats is NaN.
bool hold_numbers(std::span<const RecordBuffer* const> buffers, const View& state);

/// Feeds a_Position and so on of `program` from `buffer`. Throws Error if one has a wrong type.
GlVertexArray vertex_array(const RecordBuffer& buffer, const Program& program);
/// The same from several buffers, a record an instance.
GlVertexArray instance_array(std::span<const RecordBuffer* const> buffers, const Program& program);

} // namespace lockstep
