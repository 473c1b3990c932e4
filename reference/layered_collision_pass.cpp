#include "reference/layered_collision_pass.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "reference/collision_code.hpp"
#include "reference/collision_pass.hpp"
#include "reference/obstacle_pass.hpp"
#include "reference/particle_step.hpp"
#include "reference/subnormals.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

const glm::mat4& proj_view(const FrameParams& params, int camera) {
    return camera == 0 ? params.collision_proj_view : params.second_proj_view;
}

/// Where a clip-space position lies on the image, in texels (listing, lines 2 to 4). `A`: the arithmetic
/// (arithmetic.hpp).
template <class A> struct ImagePosition {
    float x, y;
    bool inside;

    ImagePosition(glm::vec4 clip, const FrameParams& params) {
        const auto width = static_cast<float>(params.width);
        const auto height = static_cast<float>(params.height);
        x = (A::divide(clip.x, clip.w) + 1.0F) * 0.5F * width;
        y = (A::divide(clip.y, clip.w) + 1.0F) * 0.5F * height;
        inside = x >= 0.0F && y >= 0.0F && x < width && y < height;
    }
};

/// From low to high, both included; none where low > high.
struct Span {
    int low = 0;
    int high = -1;
};

/// The texels a particle looks at, seen from one camera.
struct Window {
    Span columns, rows;
};

/// One particle's step.
template <class A> class LayeredStep {
  public:
    LayeredStep(const CollisionImage& cdt, const FrameParams& params)
        : cdt_(cdt), params_(params), range_(params.constants.collision_range), planes_(cdt_planes(params.switches)),
          code_(params), answer_(params) {
        for (int camera = 0; camera < planes_.cameras; ++camera)
            reach_[static_cast<std::size_t>(camera)] = projected_reach(proj_view(params, camera), params);
    }

    [[nodiscard]] ParticleState operator()(const ParticleState& before) const {
        const ParticleState a = ParticleStep<A>::flushed(before);
        if (a.collide_time < 0.0F) {
            if (params_.switches.response == Response::mutual) {
                if (const auto velocity = velocity_after_contacts(a))
                    return rebound(a, *velocity);
            } else if (const auto away = nearest(a.position)) {
                return answer_.collide(a, *away);
            }
        }
        return answer_.integrate(a);
    }

  private:
    /// Calls look(camera, layer, texel index, stored position) for everything in the search windows; layer -1: an
    /// obstacle.
    template <class Look> void for_each_stored(glm::vec3 position, const Look& look) const {
        for (int camera = 0; camera < planes_.cameras; ++camera) {
            const Window window = search_window(position, camera);
            for (int y = window.rows.low; y <= window.rows.high; ++y)
                for (int x = window.columns.low; x <= window.columns.high; ++x) {
                    if (const glm::vec4 obstacle = texel(planes_.obstacles(camera), x, y); obstacle.a != 0.0F)
                        look(camera, -1, x, y, A::flush(code_.decode(obstacle)));
                    for (int layer = 0; layer < planes_.layers; ++layer)
                        if (const glm::vec4 stored = texel(planes_.position(camera, layer), x, y); stored.a != 0.0F)
                            look(camera, layer, x, y, A::flush(code_.decode(stored)));
                }
        }
    }

    [[nodiscard]] Window search_window(glm::vec3 position, int camera) const {
        const glm::vec4 clip = A::transform(proj_view(params_, camera), position);
        const ImagePosition<A> at(clip, params_);
        if (!at.inside)
            return {};
        const glm::vec3 reach = reach_[static_cast<std::size_t>(camera)];
        const float before = A::flush(clip.w - A::flush(reach.z));
        return {span(at.x, A::divide(reach.x, before), params_.width),
                span(at.y, A::divide(reach.y, before), params_.height)};
    }

    [[nodiscard]] Span span(float at, float reach, int size) const {
        const int base = static_cast<int>(at);
        const int range = params_.constants.texel_collide_range;
        Span s{base - range, base + range};
        const float r = reach + window_margin;
        if (params_.switches.search_window == SearchWindow::projected && reach >= 0.0F &&
            r < static_cast<float>(range)) {
            s.low = std::max(s.low, static_cast<int>(std::floor(A::flush(at - r))));
            s.high = std::min(s.high, static_cast<int>(std::floor(at + r)));
        }
        return {std::max(s.low, 0), std::min(s.high, size - 1)};
    }

    /// Own position minus the nearest stored one in range.
    [[nodiscard]] std::optional<glm::vec3> nearest(glm::vec3 position) const {
        const glm::vec3 self = as_stored(position);
        float least = 100000.0F;
        std::optional<glm::vec3> away;
        for_each_stored(position, [&](int, int, int, int, glm::vec3 stored) {
            const glm::vec3 apart = A::flush(position - stored);
            const float length = A::length(apart);
            if (stored == self || length == 0.0F || !(range_ > length) || !(length < least))
                return;
            least = length;
            away = apart;
        });
        return away;
    }

    /// The velocity after all contacts at once; none where there is no contact. Positions and velocities are taken as
    /// stored, the own ones too, so that both of a pair compute with the same numbers.
    [[nodiscard]] std::optional<glm::vec3> velocity_after_contacts(const ParticleState& a) const {
        const glm::vec3 velocity = A::scale(a.direction, a.speed);
        const glm::vec3 self = as_stored(a.position);
        const glm::vec3 self_velocity = as_stored(velocity);
        glm::vec3 change(0.0F);
        bool hit = false, seen = false;
        float least = 100000.0F;
        std::optional<glm::vec3> wall;
        for_each_stored(a.position, [&](int camera, int layer, int x, int y, glm::vec3 stored) {
            const glm::vec3 apart = A::flush(self - stored);
            const float length = A::length(apart);
            seen = seen || (layer >= 0 && stored == self);
            if (stored == self || length == 0.0F || !(range_ > length))
                return;
            if (layer < 0) {
                if (length < least) {
                    least = length;
                    wall = apart;
                }
                return;
            }
            const glm::vec4 other = texel(planes_.velocity(camera, layer), x, y);
            const glm::vec3 relative = A::flush(self_velocity - A::flush(glm::vec3(other)));
            if (other.a == 0.0F || !(A::dot(relative, apart) < 0.0F))
                return;
            change = A::flush(change + bounce(relative, apart, 0.5F));
            hit = true;
        });
        hit = hit && seen;
        glm::vec3 after = hit ? A::flush(velocity + change) : velocity;
        if (wall && A::dot(after, *wall) < 0.0F) {
            after = A::flush(after + bounce(after, *wall, 1.0F));
            hit = true;
        }
        return hit ? std::optional(after) : std::nullopt;
    }

    /// What a contact adds to the velocity: -share * (1 + restitution) * the component of `relative` along `apart`.
    [[nodiscard]] glm::vec3 bounce(glm::vec3 relative, glm::vec3 apart, float share) const {
        const float restitution = params_.switches.speed_factor;
        const float part = A::divide(A::dot(relative, apart), A::dot(apart, apart));
        const float weight = A::flush(-share * A::flush(1.0F + A::flush(restitution)));
        return A::scale(apart, A::flush(part * weight));
    }

    [[nodiscard]] ParticleState rebound(const ParticleState& a, glm::vec3 velocity) const {
        ParticleState v;
        v.speed = A::length(velocity);
        v.direction = v.speed == 0.0F ? a.direction : A::normalize(velocity);
        v.collide_time = params_.constants.collision_time;
        const bool tick = params_.switches.collision_step == CollisionStep::tick;
        v.position = A::flush(a.position + (tick ? A::scale(velocity, params_.constants.tick) : velocity));
        return v;
    }

    [[nodiscard]] glm::vec3 as_stored(glm::vec3 v) const { return A::flush(code_.decode(code_.encode(v))); }

    [[nodiscard]] glm::vec4 texel(int plane, int x, int y) const { return cdt_.at(x, plane * params_.height + y); }

    const CollisionImage& cdt_;
    const FrameParams& params_;
    float range_;
    CdtPlanes planes_;
    CollisionCode code_;
    ParticleStep<A> answer_;
    std::array<glm::vec3, 2> reach_;
};

/// Where each particle is drawn, its depth a multiple of 2^-24.
template <class A> std::vector<PointFragment> place(std::span<const glm::vec3> positions, const glm::mat4& proj_view,
                                                    const FrameParams& params, const Profile& profile) {
    std::vector<PointFragment> placed(positions.size());
    const auto count = static_cast<std::ptrdiff_t>(positions.size());
#pragma omp parallel
    {
        const FlushSubnormals guard(profile.flush_subnormals);
#pragma omp for schedule(static)
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const glm::vec4 clip = A::transform(proj_view, positions[static_cast<std::size_t>(i)]);
            const ImagePosition<A> at(clip, params);
            const float depth = (A::divide(clip.z, clip.w) + 1.0F) * 0.5F;
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
    seen.collision_proj_view = proj_view(params, camera);
    return seen;
}

glm::vec4* plane(CollisionImage& cdt, int plane, const FrameParams& params) {
    return &cdt.at(0, plane * params.height);
}

} // namespace

void update_particles_layered(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                              const Profile& profile, Particles& after) {
    assert(&before != &after && cdt.width == params.width);
    assert(cdt.height == params.height * cdt_planes(params.switches).count());
    after.resize(before.size());
    const auto count = static_cast<std::ptrdiff_t>(before.size());
    with_arithmetic(profile, params.switches, [&]<class A>(A) {
        const LayeredStep<A> step(cdt, params);
#pragma omp parallel
        {
            const FlushSubnormals guard(profile.flush_subnormals);
#pragma omp for schedule(dynamic, 1024)
            for (std::ptrdiff_t i = 0; i < count; ++i)
                after.set(static_cast<std::size_t>(i), step(before[static_cast<std::size_t>(i)]));
        }
    });
}

void draw_layered_cdt(const Particles& particles, const Mesh& obstacles, const FrameParams& params,
                      const Profile& profile, CollisionImage& cdt) {
    const CdtPlanes planes = cdt_planes(params.switches);
    assert(cdt.width == params.width && cdt.height == params.height * planes.count());
    const CollisionCode code(params);
    std::fill(cdt.texels.begin(), cdt.texels.end(), glm::vec4(0.0F));
    for (int camera = 0; camera < planes.cameras; ++camera) {
        const FrameParams seen = seen_by(params, camera);
        CollisionImage walls(params.width, params.height);
        DepthImage depth(params.width, params.height, 1.0F);
        obstacle_pass(obstacles, seen, profile, walls, depth);
        std::copy(walls.texels.begin(), walls.texels.end(), plane(cdt, planes.obstacles(camera), params));

        with_arithmetic(profile, params.switches, [&]<class A>(A) {
            const auto placed = place<A>(particles.position, seen.collision_proj_view, params, profile);
            const auto owners = layer_owners(placed, params);
            const FlushSubnormals guard(profile.flush_subnormals);
            glm::vec4* position = plane(cdt, planes.position(camera, 0), params);
            glm::vec4* velocity = planes.velocities ? plane(cdt, planes.velocity(camera, 0), params) : nullptr;
            for (std::size_t t = 0; t < owners.size(); ++t) {
                if (owners[t] < 0)
                    continue;
                const ParticleState p = ParticleStep<A>::flushed(particles[static_cast<std::size_t>(owners[t])]);
                position[t] = code.encode(p.position);
                if (velocity != nullptr)
                    velocity[t] = {glm::vec3(code.encode(A::scale(p.direction, p.speed))),
                                   p.collide_time < 0.0F ? 1.0F : 0.0F};
            }
        });
    }
}

} // namespace lockstep
