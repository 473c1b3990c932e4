#include "tests/collision/collision_scenes.hpp"

#include <bit>
#include <cstddef>

#include <glm/geometric.hpp>

#include "reference/collision/collision_code.hpp"
#include "reference/model/camera.hpp"

namespace lockstep::test {
namespace {

bool same(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (a != a && b != b);
}
bool same(glm::vec3 a, glm::vec3 b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }
bool same(glm::vec4 a, glm::vec4 b) { return same(glm::vec3(a), glm::vec3(b)) && same(a.w, b.w); }

template <class T> bool same(const std::vector<T>& a, const std::vector<T>& b) {
    if (a.size() != b.size())
        return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (!same(a[i], b[i]))
            return false;
    return true;
}

} // namespace

FrameParams flat_params() {
    FrameParams params;
    params.width = params.height = 8;
    params.constants.tick = 0.5F;
    params.constants.gravity = {0.0F, -8.0F, 0.0F};
    params.constants.collision_range = 0.5F;
    params.constants.collision_time = 0.125F;
    params.constants.texel_collide_range = 1;
    params.switches.speed_factor = 0.5F;
    return params;
}

Particles falling(glm::vec3 position) {
    Particles p;
    p.position = {position};
    p.direction = {{1.0F, 0.0F, 0.0F}};
    p.speed = {3.0F};
    p.collide_time = {-1.0F};
    return p;
}

CollisionImage empty_cdt(const FrameParams& params) { return {params.width, params.height}; }

void store(CollisionImage& cdt, const FrameParams& params, int x, int y, glm::vec3 position) {
    cdt.at(x, y) = CollisionCode(params).encode(position);
}

bool collided(const Particles& particles, std::size_t i) { return particles.collide_time[i] == 0.125F; }

bool same_bits(const Particles& a, const Particles& b) {
    return same(a.position, b.position) && same(a.direction, b.direction) && same(a.speed, b.speed) &&
           same(a.collide_time, b.collide_time);
}

bool same_bits(const CollisionImage& a, const CollisionImage& b) {
    return a.width == b.width && a.height == b.height && same(a.texels, b.texels);
}

RandomScene random_scene(std::uint32_t seed, std::size_t count, int width, int height) {
    Random random(seed);
    RandomScene scene;
    FrameParams& params = scene.params;
    const Camera camera{.eye = {0.1F, -0.2F, 3.0F}, .fov_y = 40.0F};
    params.collision_proj_view = view_projection_matrix(camera, static_cast<float>(width) / static_cast<float>(height));
    params.width = width;
    params.height = height;
    // A texel is about 2.2 / height wide in the plane z = 0.
    params.constants.collision_range = 3.0F / static_cast<float>(height);

    const auto position = [&] {
        return glm::vec3{random.between(-1.1F, 1.1F), random.between(-1.3F, 1.1F),
                         random.between(-1.0F, 1.0F) / static_cast<float>(height)};
    };
    scene.particles.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        scene.particles.position[i] = position();
        scene.particles.direction[i] = glm::normalize(position() + glm::vec3(0.0F, 0.0F, 0.3F));
        scene.particles.speed[i] = random.between(0.0F, 2.0F);
        scene.particles.collide_time[i] =
            random.chance(0.8F) ? random.between(-0.2F, 0.0F) : random.between(0.0F, 0.2F);
    }
    // What is stored lies within two texels of where a particle that searches there may be.
    scene.cdt = empty_cdt(params);
    const float texel_width = 2.2F / static_cast<float>(height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (random.chance(0.7F)) {
                const glm::vec3 centre((static_cast<float>(2 * x + 1 - width)) * 0.5F * texel_width +
                                           0.1F * texel_width,
                                       (static_cast<float>(2 * y + 1 - height)) * 0.5F * texel_width, 0.0F);
                const glm::vec3 off{random.between(-2.0F, 2.0F), random.between(-2.0F, 2.0F),
                                    random.between(-1.0F, 1.0F)};
                store(scene.cdt, params, x, y, centre + off * texel_width);
            }
    return scene;
}

} // namespace lockstep::test
