#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "gpu/probe/image_stage.hpp"
#include "gpu/probe/inputs.hpp"
#include "gpu/probe/rows.hpp"
#include "reference/model/random.hpp"

namespace lockstep::probing {
namespace {

constexpr int volume_side = 8; ///< of the volume
constexpr int places_side = 64;
constexpr std::size_t places = std::size_t{places_side} * places_side;

using Weight = float (*)(float f);
using Mix = float (*)(float a, float b, float f);

struct NamedWeight {
    const char* name;
    Weight weight;
};
constexpr std::array weights{
    NamedWeight{"all bits", [](float f) { return f; }},
    NamedWeight{"8 bits, rounded", [](float f) { return std::floor(256.0F * f + 0.5F) / 256.0F; }},
    NamedWeight{"8 bits, cut", [](float f) { return std::floor(256.0F * f) / 256.0F; }}};

struct NamedMix {
    const char* name;
    Mix mix;
};
constexpr std::array mixes{
    NamedMix{"fma(f, b - a, a)", [](float a, float b, float f) { return std::fma(f, b - a, a); }},
    NamedMix{"a + f*(b - a)", [](float a, float b, float f) { return a + f * (b - a); }},
    NamedMix{"a*(1 - f) + b*f", [](float a, float b, float f) { return a * (1.0F - f) + b * f; }}};

/// volume_side^3 texels of four floats, x fastest.
struct Volume {
    Floats texels;

    [[nodiscard]] float at(int x, int y, int z, std::size_t c, bool black) const {
        const auto clamped = [](int i) { return i < 0 ? 0 : i >= volume_side ? volume_side - 1 : i; };
        if (black && (clamped(x) != x || clamped(y) != y || clamped(z) != z))
            return 0.0F;
        return texels[static_cast<std::size_t>((clamped(z) * volume_side + clamped(y)) * volume_side + clamped(x)) * 4 +
                      c];
    }
};

/// What texture() makes of places, x, y, z and a spare a place, 0 to 1.
Floats filtered(const Volume& volume, const Floats& where, GLenum wrap, GLint stored = GL_RGBA32F) {
    const GlTexture texture;
    gl::ActiveTexture(GL_TEXTURE1);
    gl::BindTexture(GL_TEXTURE_3D, texture.id());
    gl::TexImage3D(GL_TEXTURE_3D, 0, stored, volume_side, volume_side, volume_side, 0, GL_RGBA, GL_FLOAT,
                   volume.texels.data());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl::TexParameteri(GL_TEXTURE_3D, filter, GL_LINEAR);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        gl::TexParameteri(GL_TEXTURE_3D, axis, static_cast<GLint>(wrap));
    const ImageStage stage("probe/filter");
    stage.program().set_unit("u_Volume", 1, GL_SAMPLER_3D);
    const GlTexture source = make_texture(rgba32f, places_side, places_side, where.data()),
                    target = make_texture(rgba32f, places_side, places_side, nullptr);
    stage.run(places_side, places_side, std::array{&source}, std::array{&target});
    gl::ActiveTexture(GL_TEXTURE1);
    gl::BindTexture(GL_TEXTURE_3D, 0);
    gl::ActiveTexture(GL_TEXTURE0);
    return read_texture<float>(target, rgba32f, places * 4);
}

/// Along x, then y, then z.
Floats joined(const Volume& volume, const Floats& where, bool black, const NamedWeight& weight, const NamedMix& mix) {
    Floats values;
    for (std::size_t i = 0; i < where.size(); i += 4) {
        std::array<int, 3> base{};
        std::array<float, 3> f{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float t = where[i + axis] * volume_side - 0.5F;
            base[axis] = static_cast<int>(std::floor(t));
            f[axis] = weight.weight(t - std::floor(t));
        }
        for (std::size_t c = 0; c < 4; ++c) {
            const auto along_x = [&](int dy, int dz) {
                const auto texel = [&](int dx) {
                    return volume.at(base[0] + dx, base[1] + dy, base[2] + dz, c, black);
                };
                return mix.mix(texel(0), texel(1), f[0]);
            };
            const auto along_y = [&](int dz) { return mix.mix(along_x(0, dz), along_x(1, dz), f[1]); };
            values.push_back(mix.mix(along_y(0), along_y(1), f[2]));
        }
    }
    return values;
}

/// In fixed point, of texels that have few enough exponents for a double to hold every sum: `kept` bits of a plane's
/// texels below the greatest, `rounded` of the result. How many bits of one plane are kept below the other's is not
/// known: either way is taken that gives what was measured.
Floats aligned(const Volume& volume, const Floats& where, bool black, int kept, int rounded, const Floats& measured) {
    Floats values;
    for (std::size_t i = 0; i < where.size(); i += 4) {
        int at[3], base[3], f[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            at[axis] = static_cast<int>(std::floor((double{where[i + axis]} * volume_side - 0.5) * 256.0 + 0.5));
            if (!black)
                at[axis] = std::clamp(at[axis], 0, 256 * (volume_side - 1));
            base[axis] = at[axis] >> 8;
            f[axis] = at[axis] & 255;
        }
        for (std::size_t c = 0; c < 4; ++c) {
            double planes[2] = {}, grid = 0.0;
            for (int z = 0; z < 2; ++z) {
                const int all = z == 1 ? f[2] : 256 - f[2], right = (2 * all * f[0] + 256) / 512;
                const int left_top = ((all - right) * f[1] * 2 + 255) / 512, right_top = (right * f[1] * 2 + 256) / 512;
                const int share[] = {all - right - left_top, right - right_top, left_top, right_top};
                float texel[4];
                int top = -1000;
                for (int k = 0; k < 4; ++k) {
                    texel[k] = volume.at(base[0] + k % 2, base[1] + k / 2, base[2] + z, c, black);
                    if (share[k] != 0 && texel[k] != 0.0F)
                        top = std::max(top, std::ilogb(texel[k]));
                }
                const double step = std::ldexp(1.0, top + 1 - kept);
                for (int k = 0; k < 4; ++k)
                    if (share[k] != 0)
                        planes[z] += std::trunc(texel[k] / step) * step * share[k] / 256.0;
                grid = std::max(grid, planes[z] == 0.0 ? 0.0 : step / 256.0);
            }
            const auto result = [&](double sum) {
                const double step = sum == 0.0 ? 1.0 : std::ldexp(1.0, std::ilogb(sum) + 1 - rounded);
                return static_cast<float>(std::round(sum / step) * step); // halves away from 0
            };
            const auto on_grid = [&](double plane) { return std::floor(plane / grid) * grid; };
            const float all = result(planes[0] + planes[1]),
                        cut = grid == 0.0 ? all : result(on_grid(planes[0]) + on_grid(planes[1]));
            values.push_back(measured[values.size()] == cut ? cut : all);
        }
    }
    return values;
}

/// Places, in texels, within `low` and `high`.
Floats random_places(std::uint64_t seed, double low, double high) {
    Random random(seed, 0);
    Floats where;
    for (std::size_t i = 0; i < places * 4; ++i)
        where.push_back(static_cast<float>(low + (high - low) * random.unit()) / volume_side);
    return where;
}

/// Between a texel of 0 and one of 1 the value is the weight, in each of the forms.
void measure_weights(Rows& rows) {
    Volume step;
    for (int i = 0; i < volume_side * volume_side * volume_side * 4; ++i)
        step.texels.push_back(i / 4 % volume_side < volume_side / 2 ? 0.0F : 1.0F);
    Floats where = random_places(71, 0.5 * volume_side - 0.5, 0.5 * volume_side + 0.5);
    const Floats values = filtered(step, where, GL_CLAMP_TO_EDGE);
    std::vector<Prediction<float>> predictions;
    for (const NamedWeight& weight : weights)
        predictions.push_back({weight.name, joined(step, where, false, weight, mixes[2])});
    rows.push_back(judge("image: linear filter, weights", values, predictions));
}

void measure_form(const char* name, std::uint64_t seed, bool black, Rows& rows) {
    const Volume volume{random_floats(std::size_t{volume_side} * volume_side * volume_side * 4, seed, {-4, 4, true})};
    const Floats where =
        black ? random_places(seed + 1, -1.0, volume_side + 1.0) : random_places(seed + 1, 0.0, volume_side);
    const Floats values = filtered(volume, where, black ? GL_CLAMP_TO_BORDER : GL_CLAMP_TO_EDGE);
    std::vector<Prediction<float>> predictions;
    for (const NamedWeight& weight : weights)
        for (const NamedMix& mix : mixes)
            predictions.push_back(
                {std::string(mix.name) + ", " + weight.name, joined(volume, where, black, weight, mix)});
    rows.push_back(judge(name, values, predictions));
}

/// Of floats and of halves.
void measure_aligned(const char* name, std::uint64_t seed, bool black, Rows& rows) {
    Volume volume{random_floats(std::size_t{volume_side} * volume_side * volume_side * 4, seed, {-4, 4, true})};
    for (float& texel : volume.texels) { // a half, too
        const double step = std::ldexp(1.0, std::ilogb(texel) - 10);
        texel = static_cast<float>(std::trunc(texel / step) * step);
    }
    const Floats where =
        black ? random_places(seed + 1, -1.0, volume_side + 1.0) : random_places(seed + 1, 0.0, volume_side);
    const GLenum wrap = black ? GL_CLAMP_TO_BORDER : GL_CLAMP_TO_EDGE;
    const auto both = [](Floats floats, const Floats& halves) {
        floats.insert(floats.end(), halves.begin(), halves.end());
        return floats;
    };
    const Floats floats = filtered(volume, where, wrap, GL_RGBA32F), halves = filtered(volume, where, wrap, GL_RGBA16F);
    const Floats shares = joined(volume, where, black, weights[1], mixes[2]);
    rows.push_back(judge(name, both(floats, halves),
                         {{"cell's weights in 256ths, planes cut", both(aligned(volume, where, black, 28, 24, floats),
                                                                        aligned(volume, where, black, 15, 11, halves))},
                          {std::string(mixes[2].name) + ", " + weights[1].name, both(shares, shares)}}));
}

} // namespace

void measure_filtering(Rows& rows) {
    measure_weights(rows);
    measure_form("image: linear filter", 72, false, rows);
    measure_form("image: linear filter, border of 0", 74, true, rows);
    measure_aligned("image: linear filter, aligned", 76, false, rows);
    measure_aligned("image: linear filter, aligned, border of 0", 78, true, rows);
}

} // namespace lockstep::probing
