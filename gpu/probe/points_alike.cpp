#include "gpu/probe/points_alike.hpp"

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "gpu/probe/raster_stage.hpp"
#include "reference/model/random.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {
namespace {

using namespace probing;

constexpr int cells = 125, cell_side = 4; ///< a point in each cell
constexpr int side = cells * cell_side;   ///< no power of two: products with half of it round

/// Clip coordinate of a window coordinate.
float to_clip(double window, float w) { return static_cast<float>((window / (side / 2.0) - 1.0) * w); }

/// On a pixel's edge or half a step of a grid of 1/256 or 1/16 pixel beside it, as near as floats come: the last bits
/// of what is computed decide on the pixel.
std::vector<RasterVertex> points_near_edges() {
    constexpr std::array<double, 5> beside{0.0, 1.0 / 512.0, -1.0 / 512.0, 1.0 / 32.0, -1.0 / 32.0};
    Random random(71, 0);
    std::vector<RasterVertex> vertices;
    for (int cell = 0; cell < cells * cells; ++cell) {
        const auto w = static_cast<float>(1.0 + 7.0 * random.unit());
        const auto place = [&](int index) {
            const auto which = static_cast<std::size_t>(random.unit() * beside.size());
            return to_clip(cell_side * index + 2 + beside[which], w);
        };
        const float x = place(cell % cells), y = place(cell / cells);
        vertices.push_back({{x, y, static_cast<float>(random.symmetric()) * w, w}, static_cast<float>(cell)});
    }
    return vertices;
}

bool measured() {
    const std::vector<RasterVertex> vertices = points_near_edges();
    const IdImage image(side, side);
    std::array<Floats, 2> ids, depths;
    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(GL_LESS);
    for (const bool geometry : {false, true}) {
        image.clear();
        RasterStage(Primitive::points, geometry).draw(vertices);
        ids[geometry ? 1 : 0] = image.ids();
        depths[geometry ? 1 : 0] = image.depths();
    }
    gl::Disable(GL_DEPTH_TEST);
    gl::BindFramebuffer(GL_FRAMEBUFFER, 0);
    return ids[0] == ids[1] && depths[0] == depths[1];
}

} // namespace

bool points_alike_without_geometry() {
    static std::map<std::string, bool> known;
    std::string driver;
    for (const GLenum name : {GL_VENDOR, GL_RENDERER, GL_VERSION})
        driver += std::string(reinterpret_cast<const char*>(gl::GetString(name))) + '\n';
    const auto found = known.find(driver);
    return found != known.end() ? found->second : known.emplace(driver, measured()).first->second;
}

} // namespace lockstep
