#pragma once
#include <array>
#include <compare>
#include <cstdint>
#include <vector>

namespace lockstep::text {

/// Invocations that dispatches and stages run at once, and the most that a subgroup has.
inline constexpr int lanes_at_once = 32;

/// An invocation's place in its dispatch.
struct Invocation {
    std::array<std::uint32_t, 3> group{}, local{};
    std::uint32_t number = 0; ///< group by group, local index after local index
};

struct StageVariable;

/// The words of an invocation's input, of a stage that has inputs.
struct GivenInput {
    const StageVariable* input = nullptr;
    std::vector<std::uint32_t> words;
};

/// Where an invocation wrote a word.
struct WrittenPlace {
    /// Changed: by atomic operations, with what tells their operands as the word; what comes of it others share in.
    enum class Space : std::uint8_t { block, shared, texel, output, changed_block, changed_texel, changed_shared };
    Space space = Space::block;
    std::uint32_t number = 0; ///< of the block or image
    std::uint64_t word = 0;   ///< in it; of an image its texels' components, row after row; of outputs the cell
    [[nodiscard]] bool is_of_block() const { return space == Space::block || space == Space::changed_block; }
    [[nodiscard]] bool is_of_group() const { return space == Space::shared || space == Space::changed_shared; }
    [[nodiscard]] bool is_of_image() const { return space == Space::texel || space == Space::changed_texel; }
    friend auto operator<=>(const WrittenPlace&, const WrittenPlace&) = default;
};

} // namespace lockstep::text
