#include "gpu/collision/written_texels.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "gpu/collision/collision_pass.hpp"
#include "gpu/collision/collision_texture.hpp"
#include "gpu/collision/obstacle_pass.hpp"
#include "gpu/mesh_buffer.hpp"
#include "reference/model/random.hpp"

namespace lockstep {
namespace {

/// By up to 2^-9 of itself and of a unit.
void displace(std::span<glm::vec3> positions) {
    Random random(1, 0);
    const auto little = [&] { return static_cast<float>(random.symmetric() * 0x1p-9); };
    for (glm::vec3& position : positions)
        for (int c = 0; c < 3; ++c)
            position[c] = position[c] * (1.0F + little()) + little();
}

template <class Draw> CollisionImage drawn_into_floats(const Scene& scene, const Draw& draw) {
    CollisionTexture target(scene.width, scene.height, CdtFormat::rgba32f);
    const FrameParams params = frame_params(scene, 0);
    target.clear(params.clip_depth.cleared());
    target.bind_target();
    draw(params, target);
    CollisionImage written;
    target.read(written);
    return written;
}

} // namespace

CollisionImage written_obstacles(const Scene& scene, const std::filesystem::path& shaders) {
    Mesh moved = scene.obstacles;
    displace(moved.positions);
    return drawn_into_floats(scene, [&](const FrameParams& params, CollisionTexture& /*target*/) {
        ObstaclePass(scene.switches, shaders).run(MeshBuffer(moved), params);
    });
}

CollisionImage written_particles(const Scene& scene, const std::filesystem::path& shaders) {
    Particles moved;
    moved.resize(std::min(scene.start.size(), std::size_t{4096}));
    for (std::size_t i = 0; i < moved.size(); ++i)
        moved.set(i, scene.start[i]);
    displace(moved.position);
    return drawn_into_floats(scene, [&](const FrameParams& params, CollisionTexture& target) {
        ParticleBuffer from(moved.size()), to(moved.size());
        from.upload(moved);
        const CollisionTexture empty(scene.width, scene.height, CdtFormat::rgba32f);
        CollisionPass(scene.switches, shaders, scene.clip_space.depth).run(params, from, to, empty, target);
    });
}

} // namespace lockstep
