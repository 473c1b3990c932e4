#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// What a particle may meet in the listing's search, and mistakes show in.
enum class Situation : std::uint8_t {
    search, ///< one whose base texel lies in the image
    hit,
    two_in_range,   ///< a hit that had two or more to choose from
    equally_near,   ///< a hit whose nearest are two or more
    at_range,       ///< a neighbour exactly at the collision range
    at_no_distance, ///< a neighbour at distance 0
    at_border,      ///< a search that reaches over the image's border
    timer_at_zero,  ///< a neighbour in range of one whose collide time is 0
    waiting,        ///< the same of one whose collide time is above 0
    left_of_image,  ///< an image position between -1 and 0, of one that searches
    behind_camera,  ///< clip w <= 0
    not_a_number,   ///< a position with a NaN
};
inline constexpr std::size_t situation_count = static_cast<std::size_t>(Situation::not_a_number) + 1;

/// How many particles of one frame, or several, were in each, and some of the last frame's, by index.
struct Situations {
    static constexpr std::size_t kept = 512; ///< of each block of 4096
    std::array<std::uint64_t, situation_count> count{};
    std::array<std::vector<std::size_t>, situation_count> some;

    [[nodiscard]] std::uint64_t of(Situation situation) const { return count[static_cast<std::size_t>(situation)]; }
};

/// Whether a particle searched and found something, by its collide times before and after a step: a time that runs down
/// can come to the collision time, too.
inline bool is_hit(float time_before, float time_after, float collision_time) {
    return time_before < 0.0F && time_after == collision_time;
}
std::uint64_t count_hits(std::span<const float> before, std::span<const float> after, float collision_time);

/// Of a step from `before` that read `cdt` and led to `after`. Hits, borders, what is behind the camera and NaN are
/// counted over all particles; of those without a hit, `looked_at` or so have their neighbours looked at.
Situations situations_of(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                         const Profile& profile, const Particles& after, std::size_t looked_at);

} // namespace lockstep
