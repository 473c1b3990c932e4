#include "reference/dust/handed.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include <glm/gtc/type_ptr.hpp>

namespace lockstep::dust {
namespace {

constexpr std::size_t words = 35, padded = 36; ///< of a record

std::array<float, words> record_of(const ColliderMatrices& collider) {
    std::array<float, words> all{};
    std::copy_n(glm::value_ptr(collider.local_to_world), 16, all.begin());
    std::copy_n(glm::value_ptr(collider.world_to_local), 16, all.begin() + 16);
    std::copy_n(glm::value_ptr(collider.scale), 3, all.begin() + 32);
    return all;
}

/// Records written at one stride and read at another; behind the last there is 0.
std::vector<ColliderMatrices> misread(const std::vector<ColliderMatrices>& list, std::size_t written,
                                      std::size_t read) {
    std::vector<float> all(list.size() * padded + padded);
    for (std::size_t k = 0; k < list.size(); ++k)
        std::ranges::copy(record_of(list[k]), all.begin() + static_cast<std::ptrdiff_t>(k * written));
    std::vector<ColliderMatrices> found(list.size());
    for (std::size_t k = 0; k < list.size(); ++k) {
        const float* record = &all[k * read];
        found[k] = {glm::make_mat4(record), glm::make_mat4(record + 16), glm::make_vec3(record + 32)};
    }
    return found;
}

/// Four floats a sphere, of which each is taken to begin 35 behind the last; behind all of them there is 0.
std::vector<ColliderMatrices> far_apart(const std::vector<ColliderMatrices>& list) {
    std::vector<float> all;
    for (const ColliderMatrices& one : list) {
        const glm::vec4& centre = one.local_to_world[3];
        all.insert(all.end(), {centre.x, centre.y, centre.z, one.scale.x * 0.5F});
    }
    all.resize(list.size() * words);
    std::vector<ColliderMatrices> found = list;
    for (std::size_t k = 0; k < list.size(); ++k) {
        const float* sphere = &all[k * words];
        found[k].local_to_world[3] = {sphere[0], sphere[1], sphere[2], 1.0F};
        found[k].scale = glm::vec3(sphere[3] * 2.0F);
    }
    return found;
}

} // namespace

FrameValues handed(const Host& host, FrameValues values, std::span<const Mistake> made) {
    for (const Mistake& mistake : made) {
        if (mistake.change != Change::handed_over)
            continue;
        switch (static_cast<Deviation>(mistake.part)) {
        case Deviation::pose_late: {
            const FrameValues late = host.at(values.frame == 0 ? 0 : values.frame - 1);
            values.controller_pos = late.controller_pos;
            values.controller_forward = late.controller_forward;
            values.controller_matrix = late.controller_matrix;
            break;
        }
        case Deviation::angle_for_cosine:
            values.threshold = values.angle_rad;
            break;
        case Deviation::angle_for_tangent:
            values.tangent = values.angle_rad;
            break;
        case Deviation::first_frame:
            values.frame = 0;
            break;
        case Deviation::impulses_of_frame:
            values.tool_dt = values.wind_dt = values.explosion_dt = values.dt;
            break;
        default:
            break;
        }
    }
    return values;
}

std::optional<Explosion> handed_explosion(const Explosion* explosion, const FrameValues& values,
                                          std::span<const Mistake> made) {
    std::optional<Explosion> one = explosion == nullptr ? std::nullopt : std::optional(*explosion);
    for (const Mistake& mistake : made)
        if (one && mistake.change == Change::handed_over &&
            static_cast<Deviation>(mistake.part) == Deviation::blast_at_the_tool)
            one->position = values.controller_pos;
    return one;
}

std::optional<Colliders> handed_colliders(const Host& host, std::span<const Mistake> made) {
    for (const Mistake& mistake : made) {
        if (mistake.change != Change::handed_over)
            continue;
        Colliders all = host.colliders();
        switch (static_cast<Deviation>(mistake.part)) {
        case Deviation::spheres_padded:
            all.spheres = misread(all.spheres, padded, words);
            return all;
        case Deviation::boxes_padded:
            all.boxes = misread(all.boxes, padded, words);
            return all;
        case Deviation::spheres_at_144_bytes:
            all.spheres = misread(all.spheres, words, padded);
            return all;
        case Deviation::boxes_at_144_bytes:
            all.boxes = misread(all.boxes, words, padded);
            return all;
        case Deviation::spheres_at_140_bytes: // of two it would be the last one's loss
            if (host.switches().sphere_data != SphereData::vec4 || all.spheres.size() < 3)
                break;
            all.spheres = far_apart(all.spheres);
            return all;
        case Deviation::boxes_unturned: {
            Settings settings = host.settings();
            for (Collider& one : settings.colliders)
                one.rotate = glm::vec3(0.0F);
            return colliders_of(settings);
        }
        default:
            break;
        }
    }
    return {};
}

} // namespace lockstep::dust
