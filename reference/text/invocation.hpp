#pragma once
#include <array>
#include <compare>
#include <cstdint>

namespace lockstep::text {

/// An invocation's place in its dispatch.
struct Invocation {
    std::array<std::uint32_t, 3> group{}, local{};
    std::uint32_t number = 0; ///< group by group, local index after local index
};

/// Where an invocation wrote a word.
struct WrittenPlace {
    enum class Space : std::uint8_t { block, shared, texel };
    Space space = Space::block;
    std::uint32_t number = 0; ///< of the block or image
    std::uint64_t word = 0;   ///< in it; of an image its texels' components, row after row
    friend auto operator<=>(const WrittenPlace&, const WrittenPlace&) = default;
};

} // namespace lockstep::text
