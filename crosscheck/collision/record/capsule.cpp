#include "crosscheck/collision/record/capsule.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "crosscheck/collision/judge/step_table.hpp"
#include "crosscheck/record/capsule_parts.hpp"
#include "crosscheck/scene/profile_text.hpp"
#include "crosscheck/scene/scene_frames.hpp"
#include "reference/collision/octree/octree_leaves.hpp"
#include "reference/collision/step_pass.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/error.hpp"
#include "reference/model/same_bits.hpp"

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
        : capsule(from), params(frame_params(from.scene, from.frame)), obstacles{from.entries, {}},
          before(one(from.before)), reference(before), gpu(one(from.gpu)), drawn(from.cdt.width, from.cdt.height) {
        if (params.switches.search == Search::octree)
            params.switches.obstacles_in_cdt = ObstaclesInCdt::vertices; // they are the entries
        const StepInputs inputs{before, from.cdt, obstacles, params};
        const SystemView start = step_state(inputs);
        run_pass(*step_pass(inputs), {start, 0}, from.profile, view(reference));
    }

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

/// The texels round where a particle is, in one plane of the CDT or more, and as far again as rounding may move that;
/// copied from `cdt` to `window`.
void copy_window(glm::vec3 position, const glm::mat4& proj_view, const FrameParams& params, int first_plane, int planes,
                 const CollisionImage& cdt, CollisionImage& window) {
    const glm::dvec4 clip = glm::dmat4(proj_view) * glm::dvec4(position, 1.0);
    const glm::dvec2 size(params.width, params.height);
    const glm::dvec2 at = params.switches.perspective_divide == PerspectiveDivide::on
                              ? (glm::dvec2(clip) / clip.w + 1.0) * 0.5 * size
                              : (glm::dvec2(clip) + 1.0) * 0.5 * size;
    if (!std::isfinite(at.x) || !std::isfinite(at.y))
        return;
    const int reach = params.constants.texel_collide_range + 2;
    const auto from = [](double x, int texels) {
        return static_cast<int>(std::clamp(std::floor(x), 0.0, texels - 1.0));
    };
    const int x = from(at.x, params.width), y = from(at.y, params.height);
    for (int plane = first_plane; plane < first_plane + planes; ++plane)
        for (int row = std::max(0, y - reach); row <= std::min(params.height - 1, y + reach); ++row)
            for (int column = std::max(0, x - reach); column <= std::min(params.width - 1, x + reach); ++column)
                window.at(column, plane * params.height + row) = cdt.at(column, plane * params.height + row);
}

/// What a particle's step may look at, as an image of its own.
CollisionImage looked_at(const JudgedFrame& frame, std::size_t particle) {
    const FrameParams& params = frame.params;
    CollisionImage window(frame.cdt.width, frame.cdt.height);
    const glm::vec3 position = frame.before[particle].position;
    if (!has_remedies(params.switches)) {
        const bool drawn_before = params.switches.search == Search::depth;
        copy_window(position, drawn_before ? params.earlier_proj_view : params.collision_proj_view, params, 0, 1,
                    frame.cdt, window);
        return window;
    }
    const CdtPlanes planes = cdt_planes(params.switches);
    for (int camera = 0; camera < planes.cameras; ++camera)
        for (int half = 0; half < (planes.velocities ? 2 : 1); ++half)
            copy_window(position, camera == 0 ? params.collision_proj_view : params.second_proj_view, params,
                        half * planes.positions() + planes.obstacles(camera), planes.a_camera(), frame.cdt, window);
    return window;
}

/// What a particle's leaf holds twice as near as the collision range reaches, or nearer.
std::vector<glm::vec3> entries_near(const JudgedFrame& frame, std::size_t particle) {
    std::vector<glm::vec3> entries;
    const glm::vec3 position = frame.before[particle].position;
    const double reach = 2.0 * double{frame.params.constants.collision_range} + 1e-6;
    const OctreeLeaves leaves = fill_leaves(frame.before.position, frame.obstacles, frame.params);
    const LeafEntries leaf = leaf_of(position, leaves, frame.params);
    for (std::size_t e = 0; e < leaf.number.size(); ++e) {
        const double apart = glm::length(glm::dvec3(leaf.position[e]) - glm::dvec3(position));
        if (static_cast<std::size_t>(leaf.number[e]) != particle && !(apart > reach))
            entries.push_back(leaf.position[e]);
    }
    return entries;
}

} // namespace

Capsule cut_capsule(const JudgedFrame& frame, const CapsuleSource& source) {
    if (source.particle >= frame.before.size())
        throw Error(fmt::format("particle {}: there are {}, counted from 0", source.particle, frame.before.size()));
    Capsule capsule;
    capsule.scene = source.scene;
    capsule.scene.frames = settings_near(source.scene.frames, source.frame);
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
    if (frame.params.switches.search == Search::octree)
        capsule.entries = entries_near(frame, source.particle);
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
    if (why_particle(frame, source.particle, "it", NumberFormat::hexadecimal) !=
        why_particle(alone.judged(), 0, "it", NumberFormat::hexadecimal))
        throw Error(fmt::format("{}: its verdict rests on more than the texels around it, so no capsule of it can be "
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
    return text + table_text(frame, table, format) + why_particle(frame, 0, name_of(capsule), format) +
           first_divergent_text(table);
}

CapsuleVerdict judge(const Capsule& capsule) {
    const LonelyFrame alone(capsule);
    const JudgedFrame frame = alone.judged();
    return {!same_bits(frame.reference[0], capsule.gpu), judge_particle(frame, 0)};
}

} // namespace lockstep
