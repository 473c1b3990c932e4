#pragma once
#include <cstddef>

namespace lockstep::test {

/// A float of the state that the GPU computed, changed in its buffer once it is written: what a broken cell or a stray
/// write would do. The next frame starts from it.
struct Fault {
    int frame = 0;
    std::size_t particle = 0;
    int component = 0; ///< of a record: position, speed, direction, collide time
    int ulps = 0;      ///< to move it by; 0: its sign is flipped
};

/// Plants a fault in the simulation that is run next, whose first `repeated_frames` frames run twice; for the lifetime
/// of the object, in the current context.
class PlantedFault {
  public:
    PlantedFault(const Fault& fault, int repeated_frames);
    ~PlantedFault();
    PlantedFault(const PlantedFault&) = delete;
    PlantedFault& operator=(const PlantedFault&) = delete;

    /// The float before and after.
    [[nodiscard]] float before() const;
    [[nodiscard]] float after() const;
};

} // namespace lockstep::test
