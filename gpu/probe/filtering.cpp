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

using Size = std::array<int, 3>;
constexpr Size cube_size{8, 8, 8};
constexpr Size plane_size{33, 17, 1}; ///< by whose sides a quotient is rounded

/// Texels of four floats, x fastest: a 3D texture, or where it is one texel deep a 2D one.
struct Volume {
    Floats texels;
    Size size = cube_size;

    [[nodiscard]] bool is_plane() const { return size[2] == 1; }
    [[nodiscard]] float at(int x, int y, int z, std::size_t c, bool black) const {
        const int beside_x = std::clamp(x, 0, size[0] - 1), beside_y = std::clamp(y, 0, size[1] - 1),
                  beside_z = std::clamp(z, 0, size[2] - 1);
        if (black && (beside_x != x || beside_y != y || beside_z != z))
            return 0.0F;
        return texels[static_cast<std::size_t>((beside_z * size[1] + beside_y) * size[0] + beside_x) * 4 + c];
    }
};

/// Of texels as random_floats has them.
Volume random_volume(const Size& size, std::uint64_t seed) {
    const auto count = static_cast<std::size_t>(size[0] * size[1] * size[2]);
    return {random_floats(count * 4, seed, {-4, 4, true}), size};
}

/// What texture() makes of places, x, y, z and a spare a place, 0 to 1.
Floats filtered(const Volume& volume, const Floats& where, GLenum wrap, GLint stored = GL_RGBA32F) {
    const GlTexture texture;
    const GLenum target_of = volume.is_plane() ? GL_TEXTURE_2D : GL_TEXTURE_3D;
    const auto [width, height, depth] = volume.size;
    gl::ActiveTexture(GL_TEXTURE1);
    gl::BindTexture(target_of, texture.id());
    if (volume.is_plane())
        gl::TexImage2D(target_of, 0, stored, width, height, 0, GL_RGBA, GL_FLOAT, volume.texels.data());
    else
        gl::TexImage3D(target_of, 0, stored, width, height, depth, 0, GL_RGBA, GL_FLOAT, volume.texels.data());
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        gl::TexParameteri(target_of, filter, GL_LINEAR);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        gl::TexParameteri(target_of, axis, static_cast<GLint>(wrap));
    const ImageStage stage(volume.is_plane() ? "probe/filter_plane" : "probe/filter");
    if (volume.is_plane())
        stage.program().set_unit("u_Plane", 1);
    else
        stage.program().set_unit("u_Volume", 1, GL_SAMPLER_3D);
    gl::ActiveTexture(GL_TEXTURE0);
    const GlTexture source = make_texture(rgba32f, places_side, places_side, where.data()),
                    target = make_texture(rgba32f, places_side, places_side, nullptr);
    stage.run(places_side, places_side, std::array{&source}, std::array{&target});
    gl::ActiveTexture(GL_TEXTURE1);
    gl::BindTexture(target_of, 0);
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
            const float t = where[i + axis] * static_cast<float>(volume.size[axis]) - 0.5F;
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

/// In fixed point, places cut to 2^-21 and rounded to 256ths of a texel, of texels that have few enough exponents for a
/// double to hold every sum: `kept` bits of a plane's texels below the greatest, `rounded` of the result. How many bits
/// of one plane are kept below the other's is not known: either way is taken that gives what was measured.
Floats aligned(const Volume& volume, const Floats& where, bool black, int kept, int rounded, const Floats& measured) {
    Floats values;
    for (std::size_t i = 0; i < where.size(); i += 4) {
        int at[3], base[3], f[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double cut = std::floor(double{where[i + axis]} * 0x1p21) * 0x1p-21;
            at[axis] = static_cast<int>(std::floor((cut * volume.size[axis] - 0.5) * 256.0 + 0.5));
            if (!black)
                at[axis] = std::clamp(at[axis], 0, 256 * (volume.size[axis] - 1));
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

/// Places, in texels, from `beside` before the first texel to as many behind the last.
Floats random_places(std::uint64_t seed, const Size& size, double beside) {
    Random random(seed, 0);
    Floats where;
    for (std::size_t i = 0; i < places * 4; ++i) {
        const double side = size[std::min<std::size_t>(i % 4, 2)];
        where.push_back(static_cast<float>(-beside + (side + 2.0 * beside) * random.unit()) / static_cast<float>(side));
    }
    return where;
}
/// The same, but that of each four one is the middle of a texel and one lies just beside a place between two 256ths.
Floats places_of_pixels(std::uint64_t seed, const Size& size) {
    Floats where = random_places(seed, size, 1.0);
    for (std::size_t i = 0; i < places; i += 2)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto side = static_cast<float>(size[axis]);
            const float parts = i % 4 == 0 ? 1.0F : 256.0F;
            float& place = where[4 * i + axis];
            place = (std::floor(place * side * parts) + 0.5F) / (side * parts);
            if (i % 4 != 0)
                place *= 1.0F + static_cast<float>(static_cast<int>(i / 4 % 17) - 8) * 0x1p-22F;
        }
    return where;
}

/// Between a texel of 0 and one of 1 the value is the weight, in each of the forms.
void measure_weights(Rows& rows) {
    const int side = cube_size[0];
    Volume step;
    for (int i = 0; i < side * side * side * 4; ++i)
        step.texels.push_back(i / 4 % side < side / 2 ? 0.0F : 1.0F);
    const Floats where = random_places(71, cube_size, 0.5 - 0.5 * side);
    const Floats values = filtered(step, where, GL_CLAMP_TO_EDGE);
    std::vector<Prediction<float>> predictions;
    for (const NamedWeight& weight : weights)
        predictions.push_back({weight.name, joined(step, where, false, weight, mixes[2])});
    rows.push_back(judge("image: linear filter, weights", values, predictions));
}

void measure_form(const char* name, std::uint64_t seed, bool black, Rows& rows) {
    const Volume volume = random_volume(cube_size, seed);
    const Floats where = random_places(seed + 1, cube_size, black ? 1.0 : 0.0);
    const Floats values = filtered(volume, where, black ? GL_CLAMP_TO_BORDER : GL_CLAMP_TO_EDGE);
    std::vector<Prediction<float>> predictions;
    for (const NamedWeight& weight : weights)
        for (const NamedMix& mix : mixes)
            predictions.push_back(
                {std::string(mix.name) + ", " + weight.name, joined(volume, where, black, weight, mix)});
    rows.push_back(judge(name, values, predictions));
}

Floats both(Floats first, const Floats& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

/// Of floats and of halves.
void measure_aligned(const char* name, std::uint64_t seed, bool black, Rows& rows) {
    Volume volume = random_volume(cube_size, seed);
    for (float& texel : volume.texels) { // a half, too
        const double step = std::ldexp(1.0, std::ilogb(texel) - 10);
        texel = static_cast<float>(std::trunc(texel / step) * step);
    }
    const Floats where = random_places(seed + 1, cube_size, black ? 1.0 : 0.0);
    const GLenum wrap = black ? GL_CLAMP_TO_BORDER : GL_CLAMP_TO_EDGE;
    const Floats floats = filtered(volume, where, wrap, GL_RGBA32F), halves = filtered(volume, where, wrap, GL_RGBA16F);
    const Floats shares = joined(volume, where, black, weights[1], mixes[2]);
    rows.push_back(judge(name, both(floats, halves),
                         {{"cell's weights in 256ths, planes cut", both(aligned(volume, where, black, 28, 24, floats),
                                                                        aligned(volume, where, black, 15, 11, halves))},
                          {std::string(mixes[2].name) + ", " + weights[1].name, both(shares, shares)}}));
}

/// The one number of each texel that r32f keeps.
Floats reds(const Floats& texels) {
    Floats kept;
    for (std::size_t i = 0; i < texels.size(); i += 4)
        kept.push_back(texels[i]);
    return kept;
}

/// 2D textures of four floats and of one a texel: with weights of all bits, and in fixed point.
void measure_planes(Rows& rows) {
    const Volume volume = random_volume(plane_size, 80);
    const Floats where = places_of_pixels(81, plane_size);
    const Floats four = filtered(volume, where, GL_CLAMP_TO_EDGE, GL_RGBA32F),
                 one = reds(filtered(volume, where, GL_CLAMP_TO_EDGE, GL_R32F));
    const Floats values = both(four, one);
    const auto predicted = [](const Floats& all) { return both(all, reds(all)); };
    std::vector<Prediction<float>> forms;
    for (const NamedWeight& weight : weights)
        for (const NamedMix& mix : mixes)
            forms.push_back(
                {std::string(mix.name) + ", " + weight.name, predicted(joined(volume, where, false, weight, mix))});
    rows.push_back(judge("image: linear filter of a plane", values, forms));
    rows.push_back(judge("image: linear filter of a plane, aligned", values,
                         {{"cell's weights in 256ths, cut", predicted(aligned(volume, where, false, 28, 24, four))}}));
}

} // namespace

void measure_filtering(Rows& rows) {
    measure_weights(rows);
    measure_form("image: linear filter", 72, false, rows);
    measure_form("image: linear filter, border of 0", 74, true, rows);
    measure_aligned("image: linear filter, aligned", 76, false, rows);
    measure_aligned("image: linear filter, aligned, border of 0", 78, true, rows);
    measure_planes(rows);
}

} // namespace lockstep::probing
