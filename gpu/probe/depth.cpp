#include <cmath>

#include "gpu/probe/driver_arithmetic.hpp"
#include "gpu/probe/raster_stage.hpp"
#include "gpu/probe/rows.hpp"
#include "reference/model/random.hpp"

namespace lockstep::probing {
namespace {

constexpr int depth_side = 64;

glm::vec4 centre(int pixel, float z, float w) {
    const float x = (static_cast<float>(2 * (pixel % depth_side) + 1) / depth_side - 1.0F) * w;
    const float y = (static_cast<float>(2 * (pixel / depth_side) + 1) / depth_side - 1.0F) * w;
    return {x, y, z, w};
}

void measure_window_depth(const DriverArithmetic& gl, const IdImage& image, Rows& rows) {
    Random random(51, 0);
    Floats z, w;
    std::vector<RasterVertex> vertices;
    for (int pixel = 0; pixel < depth_side * depth_side; ++pixel) {
        w.push_back(static_cast<float>(1.0 + 7.0 * random.unit()));
        z.push_back(static_cast<float>(random.symmetric()) * w.back() * 0.9375F);
        vertices.push_back({centre(pixel, z.back(), w.back()), static_cast<float>(pixel)});
    }
    const Floats r = gl.reciprocal(w);
    const auto depths = [&](auto depth) {
        Floats values(z.size());
        for (std::size_t i = 0; i < z.size(); ++i)
            values[i] = depth(z[i], w[i], r[i]);
        return values;
    };
    using F = float;
    const std::vector<Prediction<float>> predictions{
        {"(clip*(1/w))*0.5 + 0.5", depths([](F c, F v, F) { return c * (1.0F / v) * 0.5F + 0.5F; })},
        {"(clip/w)*0.5 + 0.5", depths([](F c, F v, F) { return c / v * 0.5F + 0.5F; })},
        {"fma(clip*0.5, 1/w, 0.5)", depths([](F c, F v, F) { return std::fma(c * 0.5F, 1.0F / v, 0.5F); })},
        {"(clip*r)*0.5 + 0.5, r the driver's 1/w", depths([](F c, F, F y) { return c * y * 0.5F + 0.5F; })},
        {"fma(clip*0.5, r, 0.5)", depths([](F c, F, F y) { return std::fma(c * 0.5F, y, 0.5F); })},
        {"rounded once", depths([](F c, F v, F) { return static_cast<F>(double{c} / double{v} * 0.5 + 0.5); })},
    };
    gl::Enable(GL_DEPTH_TEST);
    gl::DepthFunc(GL_LESS);
    for (const bool geometry : {true, false}) {
        image.clear();
        RasterStage(Primitive::points, geometry).draw(vertices);
        rows.push_back(
            judge(geometry ? "points: depth" : "points: depth, no geometry stage", image.depths(), predictions));
    }
}

void measure_equal_depth(const IdImage& image, const RasterStage& stage, GLenum function, const char* name,
                         Rows& rows) {
    constexpr int times = 8;
    Random random(52, 0);
    Floats depths(depth_side * depth_side), first, last;
    for (float& depth : depths)
        depth = static_cast<float>(random.symmetric());
    std::vector<RasterVertex> vertices;
    for (int i = 0; i < times; ++i)
        for (int pixel = 0; pixel < depth_side * depth_side; ++pixel)
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

void measure_depth(const DriverArithmetic& plain, Rows& rows) {
    const IdImage image(depth_side, depth_side);
    measure_window_depth(plain, image, rows);
    const RasterStage stage(Primitive::points, true);
    measure_equal_depth(image, stage, GL_LESS, "equal depth, LESS", rows);
    measure_equal_depth(image, stage, GL_LEQUAL, "equal depth, LEQUAL", rows);
    gl::Disable(GL_DEPTH_TEST);
    gl::DepthFunc(GL_LESS);
    gl::BindFramebuffer(GL_FRAMEBUFFER, 0);
}

} // namespace lockstep::probing
