#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "gpu/probe/raster_stage.hpp"
#include "gpu/probe/rows.hpp"
#include "reference/model/random.hpp"

namespace lockstep::probing {
namespace {

constexpr int coord_side = 256, cell = 16; ///< each point has a cell of its own
constexpr std::array sizes{3.0F, 4.5F, 5.03F, 7.25F, 9.8765F, 11.0F};

/// Where the centre lies, and the size.
struct Disc {
    float x, y, size;
};

using Coord = float (*)(float pixel, float centre, float size);

/// With the middle on 256ths, halves to even, and the size cut to 32nds, from the lower side.
double cut(float pixel, float centre, float size) {
    return 0.5 + (pixel - std::nearbyint(double{centre} * 256.0) / 256.0) / (std::floor(double{size} * 32.0) / 32.0);
}

float snapped(float x) { return std::floor(x * 256.0F + 0.5F) / 256.0F; }

} // namespace

void measure_point_coord(Rows& rows) {
    const RasterStage stage(Primitive::points, false, true);
    const GlTexture target = make_texture(rgba32f, coord_side, coord_side, nullptr);
    Floats found, off, off_cut;
    std::array<Floats, 4> predicted;
    constexpr std::array<Coord, 4> coords{
        [](float p, float c, float s) { return 0.5F + (p - c) / s; },
        [](float p, float c, float s) { return 0.5F + (p - snapped(c)) / s; },
        [](float p, float c, float s) { return (p - (c - 0.5F * s)) / s; },
        [](float p, float c, float s) { return (0.5F - (1.0F / s) * (c - 0.5F)) + (1.0F / s) * (p - 0.5F); }};
    Random random(91, 0);
    for (const float size : sizes) {
        std::vector<RasterVertex> vertices;
        std::vector<Disc> discs;
        for (int i = 0; i < (coord_side / cell) * (coord_side / cell); ++i) {
            const auto within = [&](int k) { // exact in clip space, too
                return static_cast<float>(k * cell + 7) +
                       std::floor(static_cast<float>(8192.0 * random.unit())) / 4096.0F;
            };
            const float x = within(i % (coord_side / cell)), y = within(i / (coord_side / cell));
            discs.push_back({x, y, size});
            vertices.push_back(
                {{x * (2.0F / coord_side) - 1.0F, y * (2.0F / coord_side) - 1.0F, 0.0F, 1.0F}, static_cast<float>(i)});
        }
        const GlFramebuffer framebuffer = make_framebuffer(std::array{&target});
        gl::Viewport(0, 0, coord_side, coord_side);
        const float nothing[4] = {};
        gl::ClearBufferfv(GL_COLOR, 0, nothing);
        gl::Disable(GL_DEPTH_TEST);
        gl::Enable(GL_PROGRAM_POINT_SIZE);
        stage.set_point_size(size);
        stage.draw(vertices);
        gl::Disable(GL_PROGRAM_POINT_SIZE);
        gl::BindFramebuffer(GL_FRAMEBUFFER, 0);
        const Floats texels = read_texture<float>(target, rgba32f, std::size_t{coord_side} * coord_side * 4);
        for (std::size_t i = 0; i < texels.size(); i += 4) {
            if (texels[i + 3] == 0.0F)
                continue;
            const Disc& disc = discs[static_cast<std::size_t>(texels[i + 2])];
            const auto pixel = static_cast<int>(i / 4);
            const float x = static_cast<float>(pixel % coord_side) + 0.5F,
                        y = static_cast<float>(pixel / coord_side) + 0.5F;
            for (std::size_t k = 0; k < coords.size(); ++k) {
                predicted[k].push_back(coords[k](x, disc.x, size));
                predicted[k].push_back(1.0F - coords[k](y, disc.y, size)); // from above
            }
            found.insert(found.end(), {texels[i], texels[i + 1]});
            for (const float error :
                 {texels[i] - predicted[0][found.size() - 2], texels[i + 1] - predicted[0][found.size() - 1]})
                off.push_back(std::abs(error) * size <= 1.0F / 256.0F ? 1.0F : 0.0F);
            for (const double error : {texels[i] - cut(x, disc.x, size), texels[i + 1] - (1.0 - cut(y, disc.y, size))})
                off_cut.push_back(std::abs(error) <= 0x1p-20 ? 1.0F : 0.0F);
        }
    }
    rows.push_back(judge("image: gl_PointCoord", found,
                         {{"1/2 + (pixel - centre)/size", predicted[0]},
                          {"1/2 + (pixel - snapped centre)/size", predicted[1]},
                          {"(pixel - corner)/size", predicted[2]},
                          {"a plane through the centre", predicted[3]}}));
    rows.push_back(
        judge("image: gl_PointCoord, accuracy", off, {{"to 1/256 pixel, from above", Floats(off.size(), 1.0F)}}));
    rows.push_back(judge("image: gl_PointCoord, cut size", off_cut,
                         {{"to 2^-20, of a middle on 256ths and a size cut to 32nds", Floats(off.size(), 1.0F)}}));
}

} // namespace lockstep::probing
