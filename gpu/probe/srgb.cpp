#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "gpu/probe/image_stage.hpp"
#include "gpu/probe/inputs.hpp"
#include "gpu/probe/rows.hpp"
#include "reference/model/random.hpp"

namespace lockstep::probing {
namespace {

constexpr int srgb_side = 256;
constexpr std::size_t srgb_texels = std::size_t{srgb_side} * srgb_side;

/// sRGB's curve (IEC 61966-2-1) of 0..1, in codes.
double code_of(float x) {
    const double v = x;
    return 255.0 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055);
}

} // namespace

void measure_srgb(Rows& rows) {
    Random random(81, 0);
    Floats x;
    for (std::size_t i = 0; i < srgb_texels * 4; ++i)
        x.push_back(i % 2 == 0 ? static_cast<float>(random.unit())
                               : static_cast<float>(std::pow(random.unit(), 4.0))); // most codes are dark
    constexpr TexelLayout srgb{GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE};
    const GlTexture source = make_texture(rgba32f, srgb_side, srgb_side, x.data()),
                    target = make_texture(srgb, srgb_side, srgb_side, nullptr);
    gl::Enable(GL_FRAMEBUFFER_SRGB);
    ImageStage("probe/store").run(srgb_side, srgb_side, std::array{&source}, std::array{&target});
    gl::Disable(GL_FRAMEBUFFER_SRGB);
    const auto stored = read_texture<std::uint8_t>(target, srgb, srgb_texels * 4);
    Floats codes, nearest, cut, next;
    for (std::size_t i = 0; i < stored.size(); ++i) {
        if (i % 4 == 3) // alpha is linear
            continue;
        const double right = code_of(x[i]);
        codes.push_back(static_cast<float>(stored[i]));
        nearest.push_back(static_cast<float>(std::nearbyint(right)));
        cut.push_back(static_cast<float>(std::floor(right)));
        next.push_back(std::abs(right - double{codes.back()}) < 1.0 ? 1.0F : 0.0F);
    }
    rows.push_back(judge("image: sRGB store", codes, {{"nearest code", nearest}, {"code below", cut}}));
    rows.push_back(
        judge("image: sRGB store, accuracy", next, {{"one of the two next codes", Floats(next.size(), 1.0F)}}));
}

} // namespace lockstep::probing
