#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "reference/model/image.hpp"
#include "reference/model/particles.hpp"

namespace lockstep {

/// What is compared. Equality is of bits; two NaNs are equal (spec, "The listing"). There is no tolerance.
enum class Field { position, direction, speed, collide_time, texel };
inline constexpr std::array<std::string_view, 5> field_names{"position", "direction", "speed", "collide_time", "texel"};

/// One differing float.
struct Difference {
    Field field = Field::position;
    std::size_t index = 0; ///< particle, or texel counted row by row from the bottom
    int component = 0;     ///< x, y, z, w
    float reference = 0.0F;
    float gpu = 0.0F;
    std::int64_t ulp = 0; ///< 0 only for -0 against +0; INT64_MAX for NaN against a number
};

struct FieldCount {
    std::uint64_t compared = 0;  ///< floats
    std::uint64_t differing = 0; ///< floats whose bits differ
    std::uint64_t nan = 0;       ///< floats that are NaN on the GPU
};

/// The comparison of one frame, or the sum over several.
struct Comparison {
    std::array<FieldCount, field_names.size()> fields;
    std::uint64_t differing_particles = 0;
    std::uint64_t differing_texels = 0;
    std::vector<Difference> worst; ///< at most worst_kept, the largest ULP first, then field and index

    static constexpr std::size_t worst_kept = 8;

    [[nodiscard]] bool agree() const { return differing_particles == 0 && differing_texels == 0; }
    [[nodiscard]] std::uint64_t compared() const;
    [[nodiscard]] FieldCount& operator[](Field field) { return fields[static_cast<std::size_t>(field)]; }
    [[nodiscard]] const FieldCount& operator[](Field field) const { return fields[static_cast<std::size_t>(field)]; }
    void add(const Comparison& other);
};

/// Compares every float of two states of the same size. The same answer for any thread count.
Comparison compare(const Particles& reference, const Particles& gpu);

/// Compares every component of two images of the same size.
Comparison compare(const CollisionImage& reference, const CollisionImage& gpu);

/// The indices of particles, or texels, that are not bit-equal, in order.
std::vector<std::size_t> differing_particles(const Particles& reference, const Particles& gpu);
std::vector<std::size_t> differing_texels(const CollisionImage& reference, const CollisionImage& gpu);

} // namespace lockstep
