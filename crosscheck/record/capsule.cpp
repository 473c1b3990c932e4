#include "crosscheck/record/capsule.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "crosscheck/judge/step_table.hpp"
#include "crosscheck/scene/profiles.hpp"
#include "reference/model/error.hpp"
#include "reference/model/layered_cdt.hpp"
#include "reference/model/same_bits.hpp"
#include "reference/step_trace.hpp"

namespace lockstep {
namespace {

Particles one(const ParticleState& state) {
    Particles particles;
    particles.resize(1);
    particles.set(0, state);
    return particles;
}

/// A frame in which the capsule's particle is the only one. Holds what JudgedFrame refers to.
struct LonelyFrame {
    explicit LonelyFrame(const Capsule& from)
        : capsule(from), params(frame_params(from.scene, from.frame)), before(one(from.before)),
          reference(one(trace_step(from.before, from.cdt, params, from.profile).after)), gpu(one(from.gpu)),
          drawn(from.scene.width, from.scene.height) {}

    [[nodiscard]] JudgedFrame judged() const {
        return {obstacles, params, capsule.profile, capsule.known, before, capsule.cdt, reference, drawn, gpu, drawn};
    }

    const Capsule& capsule;
    FrameParams params;
    Mesh obstacles;
    Particles before, reference, gpu;
    CollisionImage drawn;
};

std::string name_of(const Capsule& capsule) {
    return fmt::format("particle {} in frame {}", capsule.particle, capsule.frame);
}

/// The texels round where the reference looks, and as far again as rounding may move that, as an image of their own.
CollisionImage looked_at(const JudgedFrame& frame, std::size_t particle) {
    CollisionImage window(frame.cdt.width, frame.cdt.height);
    const StepTrace step = trace_step(frame.before[particle], frame.cdt, frame.params, frame.profile);
    if (!std::isfinite(step.image_position.x) || !std::isfinite(step.image_position.y))
        return window;
    const int reach = frame.params.constants.texel_collide_range + 2;
    const auto from = [&](float at, int size) {
        return static_cast<int>(std::clamp(std::floor(at), 0.0F, static_cast<float>(size - 1)));
    };
    const int x = from(step.image_position.x, window.width), y = from(step.image_position.y, window.height);
    for (int row = std::max(0, y - reach); row <= std::min(window.height - 1, y + reach); ++row)
        for (int column = std::max(0, x - reach); column <= std::min(window.width - 1, x + reach); ++column)
            window.at(column, row) = frame.cdt.at(column, row);
    return window;
}

} // namespace

Capsule cut_capsule(const JudgedFrame& frame, const CapsuleSource& source) {
    if (source.scene.switches.search != Search::cdt || has_remedies(source.scene.switches))
        throw Error(fmt::format("{}: only the listing's own search is judged particle by particle, so only of it "
                                "capsules can be cut",
                                source.scene.name));
    if (source.particle >= frame.before.size())
        throw Error(fmt::format("particle {}: there are {}, counted from 0", source.particle, frame.before.size()));
    Capsule capsule;
    capsule.scene = source.scene;
    capsule.scene.start = {};
    capsule.scene.obstacles = {};
    capsule.renderer = source.renderer;
    capsule.settings = source.settings;
    capsule.frame = source.frame;
    capsule.particle = source.particle;
    capsule.profile = frame.profile;
    capsule.known = frame.known;
    capsule.before = frame.before[source.particle];
    capsule.gpu = frame.gpu[source.particle];
    capsule.cdt = looked_at(frame, source.particle);
    // Of each texel at least [x,y,"code"], said before anything is judged.
    constexpr std::size_t of_a_texel = 44;
    const auto texels = static_cast<std::size_t>(std::count_if(capsule.cdt.texels.begin(), capsule.cdt.texels.end(),
                                                               [](glm::vec4 code) { return code != glm::vec4(0.0F); }));
    if (texels * of_a_texel > largest_capsule)
        throw Error(fmt::format("{}: a capsule holds at most {} drawn texels, and it looks at {}; a trace holds the "
                                "whole run",
                                name_of(capsule), largest_capsule / of_a_texel, texels));
    capsule.capture = source.capture;

    const LonelyFrame alone(capsule);
    if (why_particle(frame, source.particle, "it") != why_particle(alone.judged(), 0, "it"))
        throw Error(fmt::format("{}: its verdict rests on more than the texels round it, so no capsule of it can be "
                                "cut; a trace holds the whole run",
                                name_of(capsule)));
    return capsule;
}

std::string capsule_text(const Capsule& capsule, NumberFormat format) {
    const LonelyFrame alone(capsule);
    const JudgedFrame frame = alone.judged();
    StepTable table = step_table(frame, 0, capsule.capture);
    table.frame = capsule.frame;
    table.particle = capsule.particle;
    std::string text = fmt::format("scene     {}\nswitches  {}\nGL        {}\nprofile   {}\n\n", capsule.scene.name,
                                   capsule.settings.empty() ? "untold" : capsule.settings,
                                   capsule.renderer.empty() ? "untold" : capsule.renderer, describe(capsule.profile));
    return text + table_text(frame, table, format) + why_particle(frame, 0, name_of(capsule)) +
           first_divergent_text(table);
}

CapsuleVerdict judge(const Capsule& capsule) {
    const LonelyFrame alone(capsule);
    const JudgedFrame frame = alone.judged();
    return {!same_bits(frame.reference[0], capsule.gpu), judge_particle(frame, 0)};
}

} // namespace lockstep
