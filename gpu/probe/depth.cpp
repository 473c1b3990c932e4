#include <cmath>

#include "gpu/probe/raster_stage.hpp"
#include "gpu/probe/rows.hpp"
#include "reference/model/random.hpp"

namespace lockstep::probing {
namespace {

constexpr int side = 64;

glm::vec4 centre(int pixel, float z, float w) {
    const float x = (static_cast<float>(2 * (pixel % side) + 1) / side - 1.0F) * w;
    const float y = (static_cast<float>(2 * (pixel / side) + 1) / side - 1.0F) * w;
    return {x, y, z, w};
}

void measure_window_depth(const IdImage& image, bool geometry, Rows& rows) {
    Random random(51, 0);
    std::vector<RasterVertex> vertices;
    Floats by_reciprocal, by_quotient, fused, once;
    for (int pixel = 0; pixel < side * side; ++pixel) {
        const auto w = static_cast<float>(1.0 + 7.0 * random.unit());
        const float z = static_cast<float>(random.symmetric()) * w * 0.9375F;
        vertices.push_back({centre(pixel, z, w), static_cast<float>(pixel)});
        by_reciprocal.push_back(z * (1.0F / w) * 0.5F + 0.5F);
        by_quotient.push_back(z / w * 0.5F + 0.5F);
        fused.push_back(std::fma(z * 0.5F, 1.0F / w, 0.5F));
        once.push_back(static_cast<float>(double{z} / double{w} * 0.5 + 0.5));
    }
    image.clear();
    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(GL_LESS);
    RasterStage(Primitive::points, geometry).draw(vertices);
    rows.push_back(judge(geometry ? "points: depth" : "points: depth, no geometry stage", image.depths(),
                         {{"(clip*(1/w))*0.5 + 0.5", by_reciprocal},
                          {"(clip/w)*0.5 + 0.5", by_quotient},
                          {"fma(clip*0.5, 1/w, 0.5)", fused},
                          {"rounded once", once}}));
}

void measure_equal_depth(const IdImage& image, const RasterStage& stage, GLenum function, const char* name,
                         Rows& rows) {
    constexpr int times = 8;
    Random random(52, 0);
    Floats depths(side * side), first, last;
    for (float& depth : depths)
        depth = static_cast<float>(random.symmetric());
    std::vector<RasterVertex> vertices;
    for (int i = 0; i < times; ++i)
        for (int pixel = 0; pixel < side * side; ++pixel)
            vertices.push_back({centre(pixel, depths[static_cast<std::size_t>(pixel)], 1.0F), static_cast<float>(i)});
    image.clear();
    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(function);
    stage.draw(vertices);
    rows.push_back(judge(name, image.ids(),
                         {{"first stays", Floats(depths.size(), 0.0F)},
                          {"last wins", Floats(depths.size(), static_cast<float>(times - 1))}}));
}

} // namespace

void measure_depth(Rows& rows) {
    const IdImage image(side, side);
    for (const bool geometry : {true, false})
        measure_window_depth(image, geometry, rows);
    const RasterStage stage(Primitive::points, true);
    measure_equal_depth(image, stage, GL_LESS, "equal depth, LESS", rows);
    measure_equal_depth(image, stage, GL_LEQUAL, "equal depth, LEQUAL", rows);
    gl::Disable(GL_DEPTH_TEST);
    gl::DepthFunc(GL_LESS);
    gl::BindFramebuffer(GL_FRAMEBUFFER, 0);
}

} // namespace lockstep::probing
