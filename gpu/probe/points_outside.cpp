#include <array>
#include <cstddef>
#include <vector>

#include "gpu/probe/raster_stage.hpp"
#include "gpu/probe/rows.hpp"

namespace lockstep::probing {
namespace {

constexpr int square_side = 32;                                ///< of the image, pixels
constexpr std::array outside_sizes{2.0F, 8.0F, 62.0F, 250.0F}; ///< whole and even: no edge meets a pixel's centre
constexpr std::array middles_aside{0.125F, 0.875F, 3.125F, 29.875F, 123.875F}; ///< of a middle from the image, pixels

/// A point whose middle lies outside the view volume: beside the image, or nearer or farther than it reaches.
struct Outside {
    glm::vec2 middle; ///< window coordinates, pixels
    float z;          ///< of normalised device coordinates
    float size;
};

std::vector<Outside> points_outside(float largest) {
    std::vector<Outside> all;
    for (const float size : outside_sizes) {
        if (size > largest)
            continue;
        const float within = 13.125F;
        for (const float away : middles_aside)
            if (2.0F * away < size)
                for (const glm::vec2 middle :
                     {glm::vec2(-away, within), glm::vec2(square_side + away, within), glm::vec2(within, -away),
                      glm::vec2(within, square_side + away), glm::vec2(-away, square_side + away),
                      glm::vec2(square_side + away, -away)})
                    for (const float z : {0.25F, 1.5F, -1.5F})
                        all.push_back({middle, z, size});
        for (const float z : {1.0078125F, -1.0078125F, 40.0F, -40.0F})
            all.push_back({{within, within}, z, size});
    }
    return all;
}

RasterVertex vertex_of(const Outside& point, float w) {
    const glm::vec2 place = point.middle * (2.0F / square_side) - 1.0F; // exact
    return {{place.x * w, place.y * w, point.z * w, w}, 1.0F};
}

/// Which pixels a point covers that is drawn.
void append_square(const Outside& point, Floats& covered) {
    const auto is_within = [&](int pixel, float middle) {
        const float from = static_cast<float>(pixel) + 0.5F - middle;
        return -0.5F * point.size < from && from < 0.5F * point.size;
    };
    for (int y = 0; y < square_side; ++y)
        for (int x = 0; x < square_side; ++x)
            covered.push_back(is_within(x, point.middle.x) && is_within(y, point.middle.y) ? 1.0F : 0.0F);
}

/// Points one pixel wide, one for each row and column of the image at each of its borders, their centres `beyond` it.
std::vector<RasterVertex> points_on_borders(float beyond, float w) {
    std::vector<RasterVertex> all;
    for (int k = 1; k < square_side - 1; ++k) {
        const float along = static_cast<float>(k) + 0.5F;
        for (const glm::vec2 centre : {glm::vec2(-beyond, along), glm::vec2(square_side + beyond, along),
                                       glm::vec2(along, -beyond), glm::vec2(along, square_side + beyond)}) {
            all.push_back(vertex_of({centre, 0.25F, 1.0F}, w));
            all.back().id = static_cast<float>(all.size());
        }
    }
    return all;
}

/// Nearer to the border than any sub-pixel grid resolves: what is drawn has its place on the border itself.
void measure_points_just_outside(Rows& rows) {
    constexpr float beyond = 0x1p-14F; // pixels
    const RasterStage stage(Primitive::points, false);
    const IdImage image(square_side, square_side);
    gl::Disable(GL_DEPTH_TEST);
    const auto drawn = [&](float by, float w) {
        image.clear();
        stage.draw(points_on_borders(by, w));
        return image.ids();
    };
    Floats found, on_border;
    for (const float w : {1.0F, 0.375F, 40.0F}) {
        const Floats outside = drawn(beyond, w), inside = drawn(0.0F, w);
        found.insert(found.end(), outside.begin(), outside.end());
        on_border.insert(on_border.end(), inside.begin(), inside.end());
    }
    gl::BindFramebuffer(GL_FRAMEBUFFER, 0);
    rows.push_back(
        judge("image: points just outside, dropped", found, {{"all, as GL says", Floats(found.size(), -1.0F)}}));
    rows.push_back(judge("image: points just outside, drawn", found, {{"where the grid puts them", on_border}}));
}

} // namespace

void measure_points_outside(Rows& rows) {
    const RasterStage stage(Primitive::points, false, true);
    const GlTexture target = make_texture(rgba32f, square_side, square_side, nullptr);
    const GlFramebuffer framebuffer = make_framebuffer(std::array{&target});
    float range[2] = {};
    gl::GetFloatv(GL_POINT_SIZE_RANGE, range);
    gl::Viewport(0, 0, square_side, square_side);
    gl::Disable(GL_DEPTH_TEST);
    gl::Enable(GL_PROGRAM_POINT_SIZE);
    Floats found, drawn_beside;
    for (const float w : {1.0F, 0.375F, 40.0F})
        for (const Outside& point : points_outside(range[1])) {
            const float nothing[4] = {};
            gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
            gl::ClearBufferfv(GL_COLOR, 0, nothing);
            stage.set_point_size(point.size);
            stage.draw(std::array{vertex_of(point, w)});
            const Floats texels = read_texture<float>(target, rgba32f, std::size_t{square_side} * square_side * 4);
            for (std::size_t i = 3; i < texels.size(); i += 4)
                found.push_back(texels[i]);
            if (point.z >= -1.0F && point.z <= 1.0F)
                append_square(point, drawn_beside);
            else
                drawn_beside.resize(found.size(), 0.0F);
        }
    gl::Disable(GL_PROGRAM_POINT_SIZE);
    gl::BindFramebuffer(GL_FRAMEBUFFER, 0);
    rows.push_back(judge("image: points outside, dropped", found, {{"all, as GL says", Floats(found.size(), 0.0F)}}));
    rows.push_back(judge("image: points beside the image, drawn", found,
                         {{"all whose depth is within the volume", drawn_beside}}));
    measure_points_just_outside(rows);
}

} // namespace lockstep::probing
