#include "gpu/collision/step_uniforms.hpp"

namespace lockstep {

void set_step_uniforms(const Program& program, const FrameParams& params) {
    const Constants& constants = params.constants;
    program.set("u_CollisionRange", constants.collision_range);
    program.set("u_CollisionTime", constants.collision_time);
    program.set("u_SpeedFactor", params.switches.speed_factor);
    program.set("u_Tick", constants.tick);
    program.set("u_Gravity", constants.gravity);
}

void set_search_uniforms(const Program& program, const FrameParams& params) {
    program.set("u_ProjView", params.collision_proj_view);
    program.set("u_ClientWidth", params.width);
    program.set("u_ClientHeight", params.height);
    program.set("u_TexelCollideRange", params.constants.texel_collide_range);
    set_collision_code(program, params);
}

void set_collision_code(const Program& program, const FrameParams& params) {
    const glm::vec3 size = params.cdt_box.max - params.cdt_box.min;
    program.set("u_CdtBoxMin", params.cdt_box.min);
    program.set("u_CdtBoxStep", size / 255.0F);
    program.set("u_CdtBoxScale", 255.0F / size);
}

} // namespace lockstep
