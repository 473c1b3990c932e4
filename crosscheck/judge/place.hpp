#pragma once
#include <cstddef>
#include <cstdint>

namespace lockstep {

/// Where a verdict belongs.
struct Place {
    int frame = 0;
    std::uint8_t resource = 0; ///< of the schema
    std::size_t index = 0;
};

} // namespace lockstep
