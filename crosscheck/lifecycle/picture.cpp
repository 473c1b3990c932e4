#include "crosscheck/lifecycle/picture.hpp"

#include <utility>

#include "crosscheck/lifecycle/mistakes.hpp"
#include "gpu/lifecycle/passes.hpp"
#include "reference/lifecycle/draw_image.hpp"
#include "reference/lifecycle/draw_pass.hpp"
#include "reference/model/lifecycle/drawing.hpp"

namespace lockstep::lifecycle {
namespace {

GlPicture::Batch batch_of(const HostEmitter& of) {
    using Blend = GlDraw::Blend;
    const Emitter::Blend blend = of.settings().blend;
    const bool is_opaque = blend == Emitter::Blend::opaque;
    return {.first = of.base,
            .count = of.slots,
            .blend = is_opaque                           ? Blend::none
                     : blend == Emitter::Blend::additive ? Blend::added
                                                         : Blend::by_alpha,
            .writes_depth = is_opaque,
            .uniforms = {{"u_FirstQuad", static_cast<unsigned>(of.base)}, {"u_Blend", static_cast<unsigned>(blend)}}};
}

} // namespace

SystemPicture picture(const HostPtr& host, const SystemState& state, int frame) {
    GlPicture how;
    how.width = host->settings().width;
    how.height = host->settings().height;
    const Drawing made = drawing(*host, static_cast<float>(how.width) / static_cast<float>(how.height), frame);
    how.background = {18, 22, 30, 255};
    how.indices = triangles_each(*host);
    for (const HostEmitter* const of : drawing_order(*host))
        how.batches.push_back(batch_of(*of));
    System system{.name = "picture",
                  .schema = drawn_schema(*host),
                  .passes = {},
                  .mistakes = {},
                  .start = quads_of(*host, state),
                  .settings = {}};
    system.passes.push_back(draw_pass(host, made));
    for (const NamedMistake& mistake : mistakes())
        if (mistake.pass == system.passes.front()->name())
            system.mistakes.push_back(mistake);
    const ColorImage background(how.width, how.height, how.background);
    const auto image = [host, background](const SystemView& corners) { return draw_image(*host, corners, background); };
    return {std::move(system), {draw_gl_pass(host, made)}, std::move(how), image, made.projection * made.view, {}};
}

} // namespace lockstep::lifecycle
