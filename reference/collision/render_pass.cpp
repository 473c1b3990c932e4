#include "reference/collision/render_pass.hpp"

#include "reference/collision/render/drawing.hpp"
#include "reference/subnormals.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {

RenderedFrame render_with_owners(const Particles& particles, const Mesh& obstacles, const FrameParams& params,
                                 const Profile& profile) {
    const FlushSubnormals guard(profile.flush_subnormals);
    return with_arithmetic(profile, params.switches.arithmetic, [&](auto fp) {
        RenderDrawing drawing(fp, RightSites(), params, profile);
        drawing.draw_background();
        drawing.draw_obstacles(obstacles);
        drawing.draw_particles(particles);
        return drawing.take();
    });
}

ColorImage render_pass(const Particles& particles, const Mesh& obstacles, const FrameParams& params,
                       const Profile& profile) {
    return render_with_owners(particles, obstacles, params, profile).color;
}

Billboard particle_billboard(glm::vec3 position, const FrameParams& params, const Profile& profile) {
    const FlushSubnormals guard(profile.flush_subnormals);
    return with_arithmetic(profile, params.switches.arithmetic, [&](auto fp) {
        return particle_square(fp, RightSites(), to_render_view(fp, position, params), params);
    });
}

std::optional<BillboardWindow> particle_window(glm::vec3 position, const FrameParams& params, const Profile& profile) {
    const FlushSubnormals guard(profile.flush_subnormals);
    const Billboard square = particle_billboard(position, params, profile);
    if (!is_visible(square))
        return {};
    return with_arithmetic(profile, params.switches.arithmetic, [&](auto fp) {
        return std::optional(billboard_window(fp, square, params.render_width, params.render_height));
    });
}

} // namespace lockstep
