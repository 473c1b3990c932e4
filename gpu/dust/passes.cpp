#include "gpu/dust/passes.hpp"

#include <algorithm>
#include <utility>

#include "reference/model/dust/frame_order.hpp"
#include "reference/model/dust/schema.hpp"

namespace lockstep::dust {
namespace {

/// Matrix after matrix, column by column, and the scale: 35 floats a collider.
std::vector<float> floats_of(const std::vector<ColliderMatrices>& colliders) {
    std::vector<float> floats;
    for (const ColliderMatrices& one : colliders) {
        for (const glm::mat4* matrix : {&one.local_to_world, &one.world_to_local})
            for (int c = 0; c < 4; ++c)
                for (int row = 0; row < 4; ++row)
                    floats.push_back((*matrix)[c][row]);
        for (int axis = 0; axis < 3; ++axis)
            floats.push_back(one.scale[axis]);
    }
    return floats;
}

/// Centre and radius of each: 4 floats.
std::vector<float> spheres_as_vec4(const std::vector<ColliderMatrices>& spheres) {
    std::vector<float> floats;
    for (const ColliderMatrices& one : spheres) {
        for (int axis = 0; axis < 3; ++axis)
            floats.push_back(one.local_to_world[3][axis]);
        floats.push_back(one.scale.x * 0.5F);
    }
    return floats;
}

std::vector<float> floats_of(const std::vector<glm::vec2>& directions) {
    std::vector<float> floats;
    for (const glm::vec2& direction : directions)
        floats.insert(floats.end(), {direction.x, direction.y});
    return floats;
}

/// All that any kernel is handed; each takes what it has.
Uniforms uniforms(const Host& host, Kernel kernel, int frame) {
    const Settings& s = host.settings();
    const bool moves = kernel.name == "update"; // and may ask once more who dies in the mouth
    const FrameValues at = host.at(frame), pulling = moves ? host.at(host.pulled_in(frame)) : at;
    Uniforms all{{"dustCount", static_cast<unsigned>(s.count)},
                 {"seed", s.seed},
                 {"frame", static_cast<unsigned>(frame)},
                 {"radius", host.radius()},
                 {"spawnBoundsMin", s.spawn.min},
                 {"spawnBoundsMax", s.spawn.max},
                 {"worldBoundsMin", s.world.min},
                 {"worldBoundsMax", s.world.max},
                 {"deltaTime", at.dt},
                 {"time", at.time},
                 {"gravity", s.gravity},
                 {"airResistance", s.air_resistance},
                 {"mass", s.mass},
                 {"elasticity", s.elasticity},
                 {"dustColorA", s.colour_a},
                 {"dustColorB", s.colour_b},
                 {"controllerPos", pulling.controller_pos},
                 {"controllerForward", pulling.controller_forward},
                 {"controllerMatrix", at.controller_matrix},
                 {"cleanerSqrForce", pulling.sqr_force},
                 {"cleanerSqrDist", pulling.sqr_range},
                 {"cleanerDotThreshold", pulling.threshold},
                 {"cleanerSqrDeathRange", pulling.sqr_death_range},
                 {"cleanerForce", at.tool != nullptr ? at.tool->force : 0.0F},
                 {"isRunning", host.update_kills(frame) ? 1 : 0},
                 {"emitterForce", at.tool != nullptr ? at.tool->force : 0.0F},
                 {"emitterDist", at.tool != nullptr ? at.tool->distance : 0.0F},
                 {"emitterAngleRad", at.angle_rad},
                 {"emitterTangent", at.tangent},
                 {"blowerSqrForce", at.sqr_force},
                 {"blowerSqrDist", at.sqr_range},
                 {"blowerDotThreshold", at.threshold},
                 {"impulseDeltaTime", kernel.name == "blow_wind" ? at.wind_dt
                                      : kernel.name == "explode" ? at.explosion_dt
                                                                 : at.tool_dt},
                 {"sphereColliderCount", static_cast<int>(host.spheres().size())},
                 {"boxColliderCount", static_cast<int>(host.boxes().size())}};
    if (const Explosion* explosion = host.explosion(frame, kernel.ball)) {
        all["explosionPosition"] = explosion->position;
        all["explosionSqrRange"] = explosion->sqr_range;
        all["explosionForce"] = explosion->force;
    }
    return all;
}

} // namespace

std::vector<GlPass> passes(const HostPtr& host) {
    std::vector<GlPass> all;
    for (const Kernel& kernel : frame_order(*host)) {
        GlPass pass{.name = std::string(kernel.name), .stage = Stage::compute, .resource = grain_buffer};
        pass.uniforms = [host, kernel](int frame) { return uniforms(*host, kernel, frame); };
        pass.defines = switch_defines(host->switches());
        pass.runs = [host, kernel](int frame) { return runs(*host, kernel, frame); };
        if (kernel.name == "update") {
            pass.data["sphereColliderBuffer"] = [host](int) {
                return host->switches().sphere_data == SphereData::vec4 ? spheres_as_vec4(host->spheres())
                                                                        : floats_of(host->spheres());
            };
            pass.data["boxColliderBuffer"] = [host](int) { return floats_of(host->boxes()); };
        }
        if (kernel.name == "emit")
            pass.data["directionBuffer"] = [host](int) { return floats_of(host->directions()); };
        all.push_back(std::move(pass));
        all.push_back({.name = std::string(kernel.name) + "_count",
                       .stage = Stage::compute,
                       .resource = count_buffer,
                       .continues = true});
    }
    return all;
}

GlPass draw_gl_pass(const HostPtr& host, const Drawing& drawing) {
    GlPass pass{.name = "draw", .stage = Stage::vertex, .resource = corner_buffer};
    pass.instances_of = grain_buffer;
    pass.defines = switch_defines(host->switches());
    pass.uniforms = [scale = host->settings().scale, drawing](int) -> Uniforms {
        return {{"cameraRight", drawing.right},
                {"cameraUp", drawing.up},
                {"cameraBack", drawing.back},
                {"scale", scale},
                {"viewProjection", drawing.view_projection}};
    };
    return pass;
}

} // namespace lockstep::dust
