#include "reference/collision/layered_collision_pass.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/layered_search.hpp"
#include "reference/collision/layered_twin.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/subnormals.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

/// Where each particle is drawn, its depth a multiple of 2^-24.
template <class A> std::vector<PointFragment> place(A fp, std::span<const glm::vec3> positions,
                                                    const glm::mat4& proj_view, const FrameParams& params,
                                                    const Profile& profile) {
    std::vector<PointFragment> placed(positions.size());
    const auto count = static_cast<std::ptrdiff_t>(positions.size());
#pragma omp parallel
    {
        const FlushSubnormals guard(profile.flush_subnormals);
#pragma omp for schedule(static)
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const glm::vec4 clip = fp.transform(proj_view, positions[static_cast<std::size_t>(i)]);
            const ImagePosition at(fp, clip, params);
            const float depth = (fp.divide(clip.z, clip.w) + 1.0F) * 0.5F;
            if (at.inside && clip.w > 0.0F && depth >= 0.0F && depth <= 1.0F)
                placed[static_cast<std::size_t>(i)] = {static_cast<int>(at.x), static_cast<int>(at.y),
                                                       std::floor(depth * 0x1p24F) * 0x1p-24F};
        }
    }
    return placed;
}

/// A particle in a texel of a layer.
struct Kept {
    float depth = 1.0F;
    std::int32_t particle = -1;

    [[nodiscard]] bool comes_after(const Kept& other) const {
        return particle < 0 || other.depth < depth || (other.depth == depth && other.particle < particle);
    }
};

/// The particle in each texel of each layer, layer by layer, -1 where there is none.
std::vector<std::int32_t> layer_owners(std::span<const PointFragment> placed, const FrameParams& params) {
    const int layers = params.switches.cdt_layers;
    const auto texels = static_cast<std::size_t>(params.width) * static_cast<std::size_t>(params.height);
    std::vector<Kept> kept(texels * static_cast<std::size_t>(layers));
    for (std::size_t i = 0; i < placed.size(); ++i) {
        if (placed[i].x < 0)
            continue;
        Kept next{placed[i].depth, static_cast<std::int32_t>(i)};
        auto slot = static_cast<std::size_t>(placed[i].y * params.width + placed[i].x);
        for (int layer = 0; layer < layers && next.particle >= 0; ++layer, slot += texels)
            if (kept[slot].comes_after(next))
                std::swap(kept[slot], next);
    }
    std::vector<std::int32_t> owners(kept.size());
    std::transform(kept.begin(), kept.end(), owners.begin(), [](const Kept& k) { return k.particle; });
    return owners;
}

FrameParams seen_by(const FrameParams& params, int camera) {
    FrameParams seen = params;
    seen.collision_proj_view = collision_proj_view(params, camera);
    return seen;
}

/// The start of a plane, or of the planes from there on.
template <class Planes> auto* plane(Planes& planes, int plane, const FrameParams& params) {
    return &planes.at(0, plane * params.height);
}

} // namespace

void update_particles_layered(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                              const Profile& profile, Particles& after) {
    assert(&before != &after && cdt.width == params.width);
    assert(cdt.height == params.height * cdt_planes(params.switches).count());
    after.resize(before.size());
    const auto count = static_cast<std::ptrdiff_t>(before.size());
    with_arithmetic(profile, params.switches.arithmetic, [&]<class A>(A fp) {
#pragma omp parallel
        {
            const FlushSubnormals guard(profile.flush_subnormals);
            Values<A> values(fp);
            const LayeredTwin step(values, cdt, params);
#pragma omp for schedule(dynamic, 1024)
            for (std::ptrdiff_t i = 0; i < count; ++i) {
                const auto v = step(before[static_cast<std::size_t>(i)]);
                after.set(static_cast<std::size_t>(i),
                          {floats(v.position), floats(v.direction), static_cast<float>(v.speed),
                           static_cast<float>(v.collide_time)});
            }
        }
    });
}

void draw_layered_cdt(const Particles& particles, const Mesh& obstacles, const FrameParams& params,
                      const Profile& profile, CollisionImage& cdt) {
    const CdtPlanes planes = cdt_planes(params.switches);
    assert(cdt.width == params.width && cdt.height == params.height * planes.count());
    const CollisionCode code(params);
    std::fill(cdt.texels.begin(), cdt.texels.end(), glm::vec4(0.0F));
    const LayeredOwners owners = draw_layered_owners(particles, params, profile);
    for (int camera = 0; camera < planes.cameras; ++camera) {
        CollisionImage walls(params.width, params.height);
        DepthImage depth(params.width, params.height, 1.0F);
        obstacle_pass(obstacles, seen_by(params, camera), profile, walls, depth);
        std::copy(walls.texels.begin(), walls.texels.end(), plane(cdt, planes.obstacles(camera), params));
        with_arithmetic(profile, params.switches.arithmetic, [&](auto fp) {
            const FlushSubnormals guard(profile.flush_subnormals);
            const std::size_t texels = walls.texels.size() * static_cast<std::size_t>(planes.layers);
            const std::int32_t* owner = plane(owners.owner, planes.position(camera, 0), params);
            glm::vec4* position = plane(cdt, planes.position(camera, 0), params);
            glm::vec4* velocity = planes.velocities ? plane(cdt, planes.velocity(camera, 0), params) : nullptr;
            for (std::size_t t = 0; t < texels; ++t) {
                if (owner[t] < 0)
                    continue;
                const ParticleState p = particles[static_cast<std::size_t>(owner[t])];
                position[t] = code.encode(fp.flush(p.position));
                if (velocity != nullptr)
                    velocity[t] = {glm::vec3(code.encode(fp.scale(fp.flush(p.direction), fp.flush(p.speed)))),
                                   fp.flush(p.collide_time) < 0.0F ? 1.0F : 0.0F};
            }
        });
    }
}

LayeredOwners draw_layered_owners(const Particles& particles, const FrameParams& params, const Profile& profile) {
    const CdtPlanes planes = cdt_planes(params.switches);
    LayeredOwners owners{Image<std::int32_t>(params.width, params.height * planes.positions(), empty_owner), {}};
    for (int camera = 0; camera < planes.cameras; ++camera)
        with_arithmetic(profile, params.switches.arithmetic, [&](auto fp) {
            const auto placed = place(fp, particles.position, collision_proj_view(params, camera), params, profile);
            for (const PointFragment& point : placed)
                owners.drawn.push_back(point.x < 0 ? no_texel : point.y * params.width + point.x);
            const auto layers = layer_owners(placed, params);
            std::copy(layers.begin(), layers.end(), plane(owners.owner, planes.position(camera, 0), params));
        });
    return owners;
}

} // namespace lockstep
