#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gpu/gl.hpp"
#include "gpu/object.hpp"
#include "gpu/program.hpp"

namespace lockstep {

/// What lies behind the end of a storage buffer. Another word than the canary's: a value that was read there is known.
inline constexpr std::uint32_t margin_word = 0xca7ca7cd;

/// Memory behind the items of a storage buffer. A dispatch is rounded up to whole groups, so that a stage without a
/// guard writes there: a margin has room for the items of a group.
struct Margin {
    GLuint buffer = 0;
    std::size_t from = 0, bytes = 0;
};

/// Every word becomes margin_word.
void lay(const Margin& margin);

/// The first byte, counted from the margin's own, of a word that is margin_word no more.
std::optional<std::size_t> first_written(const Margin& margin);

/// The invocations of the largest group that the context has; 0 where it has no compute shaders.
std::size_t largest_group();

/// The items of a buffer as a storage block, from its first byte on.
struct StorageRange {
    std::string block; ///< as messages name it
    std::string item;  ///< one of them: "particle"
    std::size_t count = 0, item_bytes = 0;
    Margin margin;

    /// `ends_with_last`: the block is as long as its items, for an array whose length() is asked for.
    void bind(GLuint point, bool ends_with_last) const;
};

/// "PASS (FILE) wrote past the end of BLOCK (100 particles), at item 104; ..."
std::string past_end_text(const Program& program, const StorageRange& range, std::size_t item);

/// Throws Error, its text after `when`, if the program wrote behind the items.
void check_margin(const Program& program, const StorageRange& range, std::string_view when = "");

/// A storage buffer with a margin.
class StorageBuffer {
  public:
    /// `items` from memory, or undefined where `memory` is null; `spare` items more are the margin. Binds it.
    void allocate(StorageRange items, std::size_t spare, const void* memory, GLenum usage);
    [[nodiscard]] GLuint id() const { return buffer_.id(); }
    [[nodiscard]] const StorageRange& range() const { return range_; }

  private:
    GlBuffer buffer_;
    StorageRange range_;
};

} // namespace lockstep
