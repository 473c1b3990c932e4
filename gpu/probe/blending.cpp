#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/gtc/packing.hpp>

#include "gpu/probe/half_grid.hpp"
#include "gpu/probe/inputs.hpp"
#include "gpu/probe/raster_stage.hpp"
#include "gpu/probe/rows.hpp"

namespace lockstep::probing {
namespace {

constexpr int blend_side = 32;
constexpr std::size_t pixels = std::size_t{blend_side} * blend_side, times = 16;

/// Every pixel, `times` after each other, in one draw, each a number of its own.
std::vector<RasterVertex> blend_points(const Floats& addends) {
    std::vector<RasterVertex> all;
    for (std::size_t i = 0; i < addends.size(); ++i) {
        const auto pixel = static_cast<int>(i % pixels);
        const auto along = [](int k) { return static_cast<float>(2 * k + 1) / blend_side - 1.0F; };
        all.push_back({{along(pixel % blend_side), along(pixel / blend_side), 0.0F, 1.0F}, addends[i]});
    }
    return all;
}

/// What is left of each pixel's addends by `next`, one after the other, or backwards.
Floats summed(const Floats& addends, bool backwards, const std::function<float(float sum, float x)>& next) {
    Floats sums(pixels, 0.0F);
    for (std::size_t i = 0; i < addends.size(); ++i)
        sums[i % pixels] =
            next(sums[i % pixels], addends[backwards ? addends.size() - pixels - i + 2 * (i % pixels) : i]);
    return sums;
}

void blend(const GlTexture& target, const Floats& addends) {
    const GlFramebuffer framebuffer = make_framebuffer(std::array{&target});
    gl::Viewport(0, 0, blend_side, blend_side);
    const float nothing[4] = {};
    gl::ClearBufferfv(GL_COLOR, 0, nothing);
    gl::Disable(GL_DEPTH_TEST);
    gl::Enable(GL_BLEND);
    gl::BlendFunc(GL_ONE, GL_ONE);
    RasterStage(Primitive::points, false).draw(blend_points(addends));
    gl::Disable(GL_BLEND);
    gl::BlendFunc(GL_ONE, GL_ZERO);
    gl::BindFramebuffer(GL_FRAMEBUFFER, 0);
}

Floats red(const std::vector<float>& texels) {
    Floats values;
    for (std::size_t i = 0; i < texels.size(); i += 4)
        values.push_back(texels[i]);
    return values;
}

void measure_float_sums(Rows& rows) {
    const Floats addends = random_floats(pixels * times, 61, {-6, 3, true});
    const GlTexture target = make_texture(rgba32f, blend_side, blend_side, nullptr);
    blend(target, addends);
    const auto sum = [](float a, float b) { return a + b; };
    rows.push_back(judge("image: blend rgba32f", red(read_texture<float>(target, rgba32f, pixels * 4)),
                         {{"each sum rounded, in order", summed(addends, false, sum)},
                          {"each sum rounded, backwards", summed(addends, true, sum)}}));
}

void measure_half_sums(Rows& rows) {
    const Floats addends = random_floats(pixels * times, 62, {-3, 3, true});
    const GlTexture target = make_texture(rgba16f, blend_side, blend_side, nullptr);
    blend(target, addends);
    std::vector<float> texels;
    for (const std::uint16_t half : read_texture<std::uint16_t>(target, rgba16f, pixels * 4))
        texels.push_back(glm::unpackHalf1x16(half));
    const auto cut = [](float x) { return x == 0.0F ? x : on_half_grid(x, toward_zero); };
    const auto even = [](float x) { return x == 0.0F ? x : on_half_grid(x, nearest_even); };
    const auto in_order = [&](const std::function<float(float, float)>& next) { return summed(addends, false, next); };
    rows.push_back(
        judge("image: blend rgba16f", red(texels),
              {{"each sum truncated", in_order([&](float a, float b) { return cut(a + b); })},
               {"each sum nearest even", in_order([&](float a, float b) { return even(a + b); })},
               {"addend and sum truncated", in_order([&](float a, float b) { return cut(a + cut(b)); })},
               {"addend and sum nearest even", in_order([&](float a, float b) { return even(a + even(b)); })}}));
}

} // namespace

void measure_blending(Rows& rows) {
    measure_float_sums(rows);
    measure_half_sums(rows);
}

} // namespace lockstep::probing
