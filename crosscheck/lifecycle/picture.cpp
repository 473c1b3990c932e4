#include "crosscheck/lifecycle/picture.hpp"

#include <utility>

#include "gpu/lifecycle/passes.hpp"
#include "reference/lifecycle/draw_pass.hpp"
#include "reference/model/lifecycle/drawing.hpp"

namespace lockstep::lifecycle {

SystemPicture picture(const HostPtr& host, const SystemState& state, int frame) {
    GlPicture how;
    const Drawing made = drawing(*host, static_cast<float>(how.width) / static_cast<float>(how.height), frame);
    how.background = {18, 22, 30, 255};
    how.indices.assign(quad_triangles.begin(), quad_triangles.end());
    System system{.name = "picture",
                  .schema = drawn_schema(host->switches()),
                  .passes = {},
                  .mistakes = {},
                  .start = quads_of(*host, state),
                  .settings = {}};
    system.passes.push_back(draw_pass(host, made));
    const ColorImage background(how.width, how.height, how.background);
    const auto image = [background](const SystemView& corners) { return draw_image(corners, background); };
    return {std::move(system), {draw_gl_pass(host, made)}, std::move(how), image, made.projection * made.view, {}};
}

} // namespace lockstep::lifecycle
