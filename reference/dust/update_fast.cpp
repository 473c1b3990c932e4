#include "reference/dust/update_fast.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include <glm/common.hpp>

#include "reference/dust/fast_blocks.hpp"
#include "reference/model/dust/schema.hpp"
#include "reference/plain_arithmetic.hpp"
#include "reference/readings/number.hpp"
#include "reference/vector_loops.hpp"

namespace lockstep::dust {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Sixteen grains' vectors, one after the other: all axes fly alike.
constexpr std::size_t row = 48;
constexpr std::size_t words = 3 * block_size;
using Row = std::array<float, row>;

/// What is the same for all grains of a frame.
struct Flight {
    Row acceleration, low, high; ///< a grain between low and high, both excluded, comes to no wall
    float resistance = 0.0F, dt = 0.0F;
};

struct Sphere {
    float x = 0.0F, y = 0.0F, z = 0.0F, sqr_reach = 0.0F;
};

struct OrientedBox {
    glm::mat4 to_local{1.0F};
    glm::vec3 half_grain{0.0F}; ///< in the box's own units
};

/// Grown by a grain and by more than rounding: who is outside does not touch the box.
struct AlignedBox {
    glm::vec3 low{0.0F}, high{0.0F};
};

struct Block {
    alignas(64) std::array<float, words> position, velocity, next;
    std::array<std::uint32_t, words> at_wall;
    std::array<std::uint32_t, block_size> touches; ///< a collider, or may be sucked
    std::array<std::int32_t, block_size> alive;
};

Row of_axes(const std::array<float, 3>& axes) {
    Row all{};
    for (std::size_t k = 0; k < row; ++k)
        all[k] = axes[k % 3];
    return all;
}

template <class Number> Flight flight_of(const Host& host, const FrameValues& values) {
    const Settings& s = host.settings();
    std::array<float, 3> a{}, low{-infinity, -infinity, -infinity}, high{infinity, infinity, infinity};
    for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        a[axis] = static_cast<float>(Number(0.0F) + Number(s.gravity[k]));
        if (host.switches().world != World::box)
            continue;
        low[axis] = static_cast<float>(Number(s.world.min[k]) + Number(host.radius()));
        high[axis] = static_cast<float>(Number(s.world.max[k]) - Number(host.radius()));
    }
    if (host.switches().world == World::floor_bounce)
        low[1] = host.radius();
    return {of_axes(a), of_axes(low), of_axes(high), s.air_resistance, values.dt};
}

template <class Number> Sphere sphere_of(const Host& host, const ColliderMatrices& collider) {
    const Number reach = Number(host.radius()) + Number(collider.scale.x) * Number(0.5F);
    const glm::vec4& centre = collider.local_to_world[3];
    return {centre.x, centre.y, centre.z, static_cast<float>(reach * reach)};
}

/// Half a grain's size is a quotient, and that the arithmetic's.
template <class A> OrientedBox box_of(A fp, const Host& host, const ColliderMatrices& collider) {
    const float radius = host.radius();
    return {collider.world_to_local,
            {fp.divide(radius, collider.scale.x), fp.divide(radius, collider.scale.y),
             fp.divide(radius, collider.scale.z)}};
}

AlignedBox aligned_box_of(const Host& host, const ColliderMatrices& collider) {
    const glm::vec3 centre(collider.local_to_world[3]);
    const glm::vec3 margin = 1e-3F * (glm::abs(centre) + collider.scale + host.radius());
    const glm::vec3 reach = collider.scale * 0.5F + host.radius() + margin;
    return {centre - reach, centre + reach};
}

template <class Number> void fly(Block& block, const Flight& flight) {
    const Number resistance = flight.resistance, dt = flight.dt;
    for (std::size_t first = 0; first < words; first += row) {
        LOCKSTEP_VECTOR_LOOP
        for (std::size_t k = 0; k < row; ++k) {
            const Number before = block.velocity[first + k];
            const Number velocity = before + (Number(flight.acceleration[k]) - before * resistance) * dt;
            const auto next = static_cast<float>(Number(block.position[first + k]) + velocity * dt);
            block.velocity[first + k] = static_cast<float>(velocity);
            block.next[first + k] = next;
            block.at_wall[first + k] = 1U - (static_cast<std::uint32_t>(next > flight.low[k]) &
                                             static_cast<std::uint32_t>(next < flight.high[k]));
        }
    }
}

template <class Number> void meet(Block& block, const Sphere& sphere) {
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < block_size; ++i) {
        const Number x = Number(block.next[3 * i]) - Number(sphere.x),
                     y = Number(block.next[3 * i + 1]) - Number(sphere.y);
        const Number z = Number(block.next[3 * i + 2]) - Number(sphere.z);
        const auto d2 = static_cast<float>((x * x + y * y) + z * z);
        block.touches[i] |= 1U - static_cast<std::uint32_t>(d2 > sphere.sqr_reach);
    }
}

template <class Number> void meet(Block& block, const OrientedBox& box) {
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < block_size; ++i) {
        const Number x = block.next[3 * i], y = block.next[3 * i + 1], z = block.next[3 * i + 2];
        std::uint32_t misses = 0;
        for (int k = 0; k < 3; ++k) {
            const Number half = box.half_grain[k];
            const Number turned =
                (x * Number(box.to_local[0][k]) + y * Number(box.to_local[1][k])) + z * Number(box.to_local[2][k]);
            const Number local = turned + Number(box.to_local[3][k]);
            misses |= static_cast<std::uint32_t>(static_cast<float>(local + half) < -0.5F) |
                      static_cast<std::uint32_t>(static_cast<float>(local - half) > 0.5F);
        }
        block.touches[i] |= 1U - misses;
    }
}

/// A floor that only stops: nothing else changes there.
LOCKSTEP_VECTOR_CLONES void stop(Block& block, float floor) {
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < block_size; ++i) {
        const float y = block.next[3 * i + 1];
        block.next[3 * i + 1] = y > floor ? y : floor;
    }
}

/// The height of a floor that only stops.
std::optional<float> stopping_floor(const Host& host) {
    if (host.switches().world == World::floor_clamp)
        return 0.0F;
    return host.switches().world == World::floor_radius ? std::optional(host.radius()) : std::nullopt;
}

LOCKSTEP_VECTOR_CLONES void meet(Block& block, const AlignedBox& box) {
    LOCKSTEP_VECTOR_LOOP
    for (std::size_t i = 0; i < block_size; ++i) {
        std::uint32_t misses = 0;
        for (int k = 0; k < 3; ++k) {
            const float x = block.next[3 * i + static_cast<std::size_t>(k)];
            misses |= static_cast<std::uint32_t>(x < box.low[k]) | static_cast<std::uint32_t>(x > box.high[k]);
        }
        block.touches[i] |= 1U - misses;
    }
}

LOCKSTEP_VECTOR_CLONES void fly_plain(Block& block, const Flight& flight) { fly<float>(block, flight); }
LOCKSTEP_VECTOR_CLONES void fly_exact(Block& block, const Flight& flight) {
    fly<FlushingNumber<Portable>>(block, flight);
}
LOCKSTEP_VECTOR_CLONES void meet_plain(Block& block, const Sphere& sphere) { meet<float>(block, sphere); }
LOCKSTEP_VECTOR_CLONES void meet_exact(Block& block, const Sphere& sphere) {
    meet<FlushingNumber<Portable>>(block, sphere);
}

LOCKSTEP_VECTOR_CLONES void meet_plain(Block& block, const OrientedBox& box) { meet<float>(block, box); }
LOCKSTEP_VECTOR_CLONES void meet_exact(Block& block, const OrientedBox& box) {
    meet<FlushingNumber<Portable>>(block, box);
}

template <std::size_t size> void flush(std::array<float, size>& values) {
    for (float& x : values)
        x = Portable::flush(x);
}

/// Grains first to last of the block, the last excluded, are those of the state from `to` on.
void store(const Block& block, std::size_t first, std::size_t last, const View& before, const WritableView& after,
           std::size_t to, bool exact) {
    const std::size_t bytes = 3 * (last - first) * sizeof(float);
    std::memcpy(words_at(after, field::position, to), block.next.data() + 3 * first, bytes);
    std::memcpy(words_at(after, field::velocity, to), block.velocity.data() + 3 * first, bytes);
    std::byte* colour = has(after, field::colour) ? words_at(after, field::colour, to) : nullptr;
    if (exact && colour != nullptr) {
        std::array<float, words> flushed{};
        std::memcpy(flushed.data(), words_at(before, field::colour, to), bytes);
        flush(flushed);
        std::memcpy(colour, flushed.data(), bytes);
    } else if (const std::byte* kept = words_at(before, field::colour, to); colour != nullptr && kept != colour) {
        std::memcpy(colour, kept, bytes);
    }
    if (has(after, field::alive))
        std::memcpy(words_at(after, field::alive, to), block.alive.data() + first,
                    (last - first) * sizeof(std::int32_t));
}

} // namespace

bool has_update_fast(const Host& host) {
    const Switches& s = host.switches();
    return s.drag == Drag::free && s.drag_step == DragStep::off && s.sweep == OffOn::off;
}

void update_fast(const Host& host, const PassInput& in, const Profile& profile, std::size_t first, std::size_t last,
                 const WritableView& after, std::vector<std::size_t>& left) {
    const bool exact = host.settings().arithmetic == ArithmeticSwitch::exact;
    const FrameValues values = host.at(in.frame);
    const Flight flight = exact ? flight_of<FlushingNumber<Portable>>(host, values) : flight_of<float>(host, values);
    const bool sucks = host.update_kills(in.frame);
    const Reach cone = cone_of(host.at(host.pulled_in(in.frame)));
    const std::optional<float> floor = stopping_floor(host);
    const PlainArithmetic plain(profile);
    const View& before = in.before[grain_buffer];
    Block block{};
    for (; first < last; first += block_size) {
        const std::size_t count = std::min(block_size, last - first), bytes = 3 * count * sizeof(float);
        std::memcpy(block.position.data(), words_at(before, field::position, first), bytes);
        std::memcpy(block.velocity.data(), words_at(before, field::velocity, first), bytes);
        std::memcpy(block.alive.data(), words_at(before, field::alive, first), count * sizeof(std::int32_t));
        if (exact) {
            flush(block.position);
            flush(block.velocity);
        }
        exact ? fly_exact(block, flight) : fly_plain(block, flight);
        if (sucks)
            mark(cone, block.position.data(), block.touches.data());
        else
            block.touches.fill(0);
        if (floor && host.switches().world_order == WorldOrder::first)
            stop(block, *floor);
        for (const ColliderMatrices& one : host.spheres())
            exact ? meet_exact(block, sphere_of<FlushingNumber<Portable>>(host, one))
                  : meet_plain(block, sphere_of<float>(host, one));
        for (const ColliderMatrices& one : host.boxes())
            if (host.switches().box_kind == BoxKind::aabb)
                meet(block, aligned_box_of(host, one));
            else
                exact ? meet_exact(block, box_of(Portable{}, host, one)) : meet_plain(block, box_of(plain, host, one));
        if (floor && host.switches().world_order == WorldOrder::last)
            stop(block, *floor);
        std::size_t stored = 0;
        for (std::size_t i = 0; i <= count; ++i) {
            const bool flies =
                i < count && block.alive[i] == 1 &&
                (block.touches[i] | block.at_wall[3 * i] | block.at_wall[3 * i + 1] | block.at_wall[3 * i + 2]) == 0;
            if (flies)
                continue;
            if (stored < i)
                store(block, stored, i, before, after, first + stored, exact);
            stored = i + 1;
            if (i < count)
                left.push_back(first + i);
        }
    }
}

} // namespace lockstep::dust
