#include "reference/model/lights/settings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep::lights {
namespace {

template <class... Parts> void expect(bool right, fmt::format_string<Parts...> text, Parts&&... parts) {
    if (!right)
        throw Error("lights: " + fmt::format(text, std::forward<Parts>(parts)...));
}

bool is_power_of_two(int n) { return n > 0 && (n & (n - 1)) == 0; }

/// Bits of a word that a sum may fill.
int bits_of_a_sum(Accumulate accumulate) { return accumulate == Accumulate::fixed32 ? 31 : 24; }

/// No sum can be larger.
double largest_sum(const Settings& s) { return static_cast<double>(s.lights.size()) * largest_addend(s); }

void check_grid(const Grid& grid, Accumulate accumulate) {
    int exponent = 0;
    expect(std::frexp(grid.voxel, &exponent) == 0.5F && grid.voxel >= 0.25F && grid.voxel <= 4.0F,
           "grid: a voxel of {} m; right is a power of two, 0.25 to 4", grid.voxel);
    for (int axis = 0; axis < 3; ++axis) {
        expect(is_power_of_two(grid.size[axis]) && grid.size[axis] >= 2 && grid.size[axis] <= 256,
               "grid: size.{} is {} voxels; right is a power of two, 2 to 256", "xyz"[axis], grid.size[axis]);
        const float steps = grid.origin[axis] / grid.voxel;
        expect(steps == std::floor(steps) && std::abs(steps) <= 65536.0F,
               "grid: origin.{} is {} m; right is a multiple of a voxel, {} m", "xyz"[axis], grid.origin[axis],
               grid.voxel);
    }
    expect(accumulate != Accumulate::fixed64 || grid.size.z <= 128,
           "grid: size.z is {} voxels; right for accumulate fixed64 is up to 128: its 15 words lie behind each other",
           grid.size.z);
}

void check_light(const Settings& s, std::size_t i) {
    const Light& light = s.lights[i];
    expect(light.range > 0.000001F, "lights: {} has a range of {} m; right is above 0.000001", i, light.range);
    expect(!(light.range > 14.0F * s.grid.voxel), "lights: {} has a range of {} m; right is up to 14 voxels, {} m", i,
           light.range, 14.0F * s.grid.voxel);
}

} // namespace

double largest_addend(const Settings& s) {
    double largest = 1.0;
    for (const Light& light : s.lights) {
        for (int c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(double{light.colour[c]}));
        if (s.switches.direction == Direction::raw)
            largest = std::max(largest, double{light.range});
    }
    return largest;
}

int most_fixed_bits(const Settings& s) {
    const double most = largest_sum(s);
    int k = bits_of_a_sum(s.switches.accumulate);
    while (most * std::ldexp(1.0, k) >= std::ldexp(1.0, bits_of_a_sum(s.switches.accumulate)))
        --k;
    return k;
}

void check(const Settings& s) {
    expect(!s.lights.empty() && s.lights.size() <= most_lights, "{} lights; right is 1 to {}", s.lights.size(),
           most_lights);
    check_grid(s.grid, s.switches.accumulate);
    for (std::size_t i = 0; i < s.lights.size(); ++i)
        check_light(s, i);
    expect(s.width >= 1 && s.height >= 1 && s.width <= 8192 && s.height <= 8192,
           "image: {} x {} pixels; right is 1 to 8192 a side", s.width, s.height);
    expect(!s.obstacles.mesh.indices.empty(), "obstacles: there are none, so nothing is lit");
    for (const glm::ivec3& albedo : s.obstacles.albedo)
        for (int c = 0; c < 3; ++c)
            expect(albedo[c] >= 0 && albedo[c] <= 255, "obstacles: an albedo of {} / 256; right is up to 255 / 256",
                   albedo[c]);
    expect(s.tick >= 0.0F && std::isfinite(s.tick), "tick is {} s; right is 0 or above", s.tick);
    expect(s.glow_radius > 0.0F && std::isfinite(s.glow_radius), "glow_radius is {} m; right is above 0",
           s.glow_radius);
    expect(s.switches.shading == Shading::single ||
               (s.switches.direction == Direction::unit && s.switches.direction_weight == DirectionWeight::attenuation),
           "shading directionality goes with direction unit and direction_weight attenuation");
    const bool has_bits =
        s.switches.accumulate == Accumulate::fixed32 || s.switches.accumulate == Accumulate::blend_exact;
    expect(s.switches.accumulate != Accumulate::fixed64 || largest_sum(s) < 0x1p31,
           "lights: their sums are beyond accumulate fixed64; right is below 2^31, and {} of up to {:.6g} make {:.6g}",
           s.lights.size(), largest_addend(s), largest_sum(s));
    expect(!has_bits || most_fixed_bits(s) >= 0,
           "lights: their sums are beyond a fixed-point word; right is below 2^{}, and {} of up to {:.6g} make {:.6g}",
           bits_of_a_sum(s.switches.accumulate), s.lights.size(), largest_addend(s), largest_sum(s));
    expect(!has_bits || !s.fixed_bits || (*s.fixed_bits >= 0 && *s.fixed_bits <= most_fixed_bits(s)),
           "fixed_bits is {}: {} lights of up to {} would overflow; right is 0 to {}", s.fixed_bits.value_or(0),
           s.lights.size(), largest_addend(s), most_fixed_bits(s));
}

} // namespace lockstep::lights
