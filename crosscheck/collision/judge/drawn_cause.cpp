#include "crosscheck/collision/judge/drawn_cause.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <tuple>

#include "crosscheck/collision/judge/step_judge.hpp"
#include "reference/collision/collision_code.hpp"
#include "reference/collision/layered_collision_pass.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {
namespace {

/// A texel of a plane, and what there is round it.
struct DrawnTexel {
    const JudgedFrame& frame;
    const CdtPlanes& planes;
    const CollisionImage& right; ///< as the reference draws it
    const CollisionImage* stale;
    std::int32_t owner; ///< the particle that is drawn there, negative where none is
    int x, y;           ///< in the plane
    int camera, layer;  ///< -1: the obstacles
    bool velocity;

    [[nodiscard]] const glm::vec4& of(const CollisionImage& image, int at_layer, bool of_velocity) const {
        const int plane = of_velocity ? planes.velocity(camera, at_layer) : planes.position(camera, at_layer);
        return image.at(x, plane * frame.params.height + y);
    }
    [[nodiscard]] const glm::vec4& rightly() const { return of(right, layer, velocity); }
    [[nodiscard]] bool is_drawn(int at_layer) const { return of(right, at_layer, false).a != 0.0F; }
};

using Leaves = glm::vec4 (*)(const DrawnTexel&);
struct DrawnMistake {
    std::string_view name, meaning;
    Leaves leaves;
};

constexpr glm::vec4 nothing{0.0F};

glm::vec4 reversed(const DrawnTexel& t) {
    int drawn = 0;
    while (drawn < t.planes.layers && t.is_drawn(drawn))
        ++drawn;
    return t.layer < 0 || t.layer >= drawn ? t.rightly() : t.of(t.right, drawn - 1 - t.layer, t.velocity);
}

glm::vec4 direction_alone(const DrawnTexel& t) {
    if (!t.velocity || t.owner < 0)
        return t.rightly();
    const glm::vec3 direction = t.frame.gpu.direction[static_cast<std::size_t>(t.owner)];
    return {glm::vec3(CollisionCode(t.frame.params).encode(direction)), t.rightly().a};
}

constexpr std::array mistakes{
    DrawnMistake{"planes_not_cleared", "what is not drawn keeps what it held two frames before",
                 [](const DrawnTexel& t) {
                     return t.stale == nullptr || t.is_drawn(t.layer) ? t.rightly()
                                                                      : t.of(*t.stale, t.layer, t.velocity);
                 }},
    DrawnMistake{"layers_all_first", "every layer holds the particle that is nearest to the camera",
                 [](const DrawnTexel& t) { return t.layer < 0 ? t.rightly() : t.of(t.right, 0, t.velocity); }},
    DrawnMistake{"first_layer_alone_drawn", "nothing is drawn into the layers behind the first",
                 [](const DrawnTexel& t) { return t.layer > 0 ? nothing : t.rightly(); }},
    DrawnMistake{"last_layer_not_drawn", "nothing is drawn into the last layer",
                 [](const DrawnTexel& t) { return t.layer == t.planes.layers - 1 ? nothing : t.rightly(); }},
    DrawnMistake{"layers_reversed", "the layers hold what they should from the last to the first", reversed},
    DrawnMistake{"second_camera_not_drawn", "nothing is drawn for the second camera",
                 [](const DrawnTexel& t) { return t.camera > 0 ? nothing : t.rightly(); }},
    DrawnMistake{"obstacles_not_drawn", "no obstacle is drawn",
                 [](const DrawnTexel& t) { return t.layer < 0 ? nothing : t.rightly(); }},
    DrawnMistake{"alpha_not_drawn", "a particle's texel has alpha 0",
                 [](const DrawnTexel& t) {
                     return t.velocity || t.layer < 0 ? t.rightly() : glm::vec4(glm::vec3(t.rightly()), 0.0F);
                 }},
    DrawnMistake{"velocities_not_drawn", "the velocity planes stay empty",
                 [](const DrawnTexel& t) { return t.velocity ? nothing : t.rightly(); }},
    DrawnMistake{"velocity_flags_reversed", "alpha of a velocity is 1 for what will not search",
                 [](const DrawnTexel& t) {
                     return t.velocity && t.owner >= 0 ? glm::vec4(glm::vec3(t.rightly()), 1.0F - t.rightly().a)
                                                       : t.rightly();
                 }},
    DrawnMistake{"velocities_without_speed", "the velocity planes hold directions", direction_alone},
};

} // namespace

DrawnCauseFinder::DrawnCauseFinder() {
    for (const DrawnMistake& mistake : mistakes)
        tried_.push_back({{std::string(mistake.name)}, std::string(mistake.meaning)});
}

void DrawnCauseFinder::add(const JudgedFrame& frame, const CollisionImage* stale,
                           const std::vector<ItemVerdict>& texels) {
    if (std::none_of(texels.begin(), texels.end(),
                     [](const ItemVerdict& texel) { return texel.kind == DifferenceClass::divergent; }))
        return;
    const CollisionImage right = redraw(frame);
    std::vector<char> diverges(frame.gpu_cdt.texels.size());
    std::uint64_t count = 0;
    for (const ItemVerdict& texel : texels)
        if (texel.kind == DifferenceClass::divergent &&
            !same_bits(right.texels[texel.index], frame.gpu_cdt.texels[texel.index])) {
            diverges[texel.index] = 1;
            ++count;
        }
    if (count == 0 || frames_++ >= trial_frames)
        return;
    divergent_ += count;
    const FrameParams& params = frame.params;
    const CdtPlanes planes = cdt_planes(params.switches);
    const LayeredOwners owners = draw_layered_owners(frame.gpu, params, frame.profile);
    for (int plane = 0; plane < planes.count(); ++plane) {
        const int half = plane % planes.positions(), layer = half % planes.a_camera() - 1;
        for (int y = 0; y < params.height; ++y)
            for (int x = 0; x < params.width; ++x) {
                const std::int32_t owner = layer < 0 ? empty_owner : owners.owner.at(x, half * params.height + y);
                const DrawnTexel texel{frame, planes,
                                       right, stale,
                                       owner, x,
                                       y,     half / planes.a_camera(),
                                       layer, plane >= planes.positions()};
                const int row = plane * params.height + y;
                const glm::vec4& gpu = frame.gpu_cdt.at(x, row);
                const bool wrong = diverges[static_cast<std::size_t>(row * params.width + x)] != 0;
                for (std::size_t m = 0; m < mistakes.size(); ++m)
                    if (same_bits(mistakes[m].leaves(texel), gpu) == wrong)
                        ++(wrong ? tried_[m].explained : tried_[m].contradicted);
            }
    }
}

bool DrawnCauseFinder::knows(std::string_view name) {
    return std::any_of(mistakes.begin(), mistakes.end(), [&](const DrawnMistake& m) { return m.name == name; });
}

CauseFindings DrawnCauseFinder::findings() const {
    CauseFindings found{divergent_, {}};
    const auto rank = [](const Cause& cause) {
        return std::pair(static_cast<std::int64_t>(cause.contradicted) - static_cast<std::int64_t>(cause.explained),
                         cause.contradicted);
    };
    const auto best = std::min_element(tried_.begin(), tried_.end(),
                                       [&](const Cause& a, const Cause& b) { return rank(a) < rank(b); });
    if (best->explained > best->contradicted)
        std::copy_if(tried_.begin(), tried_.end(), std::back_inserter(found.best),
                     [&](const Cause& cause) { return rank(cause) == rank(*best); });
    return found;
}

} // namespace lockstep
