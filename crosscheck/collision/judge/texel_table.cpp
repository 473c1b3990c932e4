#include "crosscheck/collision/judge/texel_table.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/legal_texels.hpp"
#include "reference/collision/step_pass.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {
namespace {

/// Everything drawn to a texel.
struct Contender {
    std::size_t particle = 0;
    float depth = 1.0F;
};

const std::vector<glm::vec3>& drawn_positions(const JudgedFrame& frame) {
    return frame.params.switches.raster_position == RasterPosition::updated ? frame.gpu.position
                                                                            : frame.before.position;
}

/// The particles that the reference draws to a texel, taking the GPU's state, in drawing order.
std::vector<Contender> contenders(const JudgedFrame& frame, glm::ivec2 texel) {
    std::vector<Contender> found;
    const std::vector<glm::vec3>& positions = drawn_positions(frame);
    const FlushSubnormals guard = flush_in_step(frame.params.switches, frame.profile);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const PointFragment point = point_fragment(positions[i], frame.params, frame.profile);
        if (point.x == texel.x && point.y == texel.y && point.x >= 0)
            found.push_back({i, point.depth});
    }
    return found;
}

/// Particles whose stored code a texel holds: candidates first.
std::optional<std::size_t> particle_of(glm::vec4 code, const JudgedFrame& frame,
                                       const std::vector<Contender>& candidates) {
    const CollisionCode encoding(frame.params);
    for (const Contender& candidate : candidates)
        if (same_bits(encoding.encode(frame.gpu.position[candidate.particle]), code))
            return candidate.particle;
    for (std::size_t i = 0; i < frame.gpu.size(); ++i)
        if (same_bits(encoding.encode(frame.gpu.position[i]), code))
            return i;
    return {};
}

std::string owner_text(glm::vec4 code, const std::optional<std::size_t>& particle) {
    if (code.a == 0.0F)
        return "nobody";
    return particle ? fmt::format("particle {}", *particle) : "an obstacle";
}

LegalTexel legal_texel(const JudgedFrame& frame, std::size_t texel) {
    const std::size_t wanted[] = {texel};
    return legal_texels(frame.obstacles, frame.before, frame.gpu, frame.params, frame.profile, frame.known, wanted)
        .front();
}

std::optional<Interval> depth_of(const LegalTexel& legal, std::size_t particle) {
    for (const TexelOwner& owner : legal.owners)
        if (owner.kind == TexelOwner::Kind::particle && owner.index == particle)
            return owner.depth;
    return {};
}

/// Who won a texel, and what it stores.
void add_winner(FrameRun& run, glm::ivec2 texel, const std::vector<Contender>& wanted, StepRows& rows) {
    const JudgedFrame frame = run.judged();
    const std::size_t index = frame.gpu_cdt.index(texel.x, texel.y);
    const glm::vec4 reference = run.redrawn().texels[index];
    const glm::vec4 gpu = frame.gpu_cdt.texels[index];
    const bool may = legal_texel(frame, index).owner_of(gpu) != nullptr;
    const std::string reference_owner = owner_text(reference, particle_of(reference, frame, wanted));
    const auto gpu_particle = particle_of(gpu, frame, wanted);
    std::string gpu_owner = owner_text(gpu, gpu_particle);
    if (gpu.a != 0.0F && !gpu_particle && !may)
        gpu_owner = "none that is known";
    rows.decision(fmt::format("owner of texel {}", texel_text(texel)), {}, reference_owner, gpu_owner, reference_owner,
                  may);
    for (int c = 0; c < 4; ++c)
        rows.number(fmt::format("stored.{}", "xyzw"[c]), {}, reference[c], gpu[c],
                    {{.legal = may}, fmt::format("{} stores {:.9g}", reference_owner, reference[c])});
}

std::string list_of(const std::vector<Contender>& contenders, std::size_t except) {
    constexpr std::size_t most = 4;
    std::string text;
    std::size_t count = 0;
    for (const Contender& contender : contenders) {
        if (contender.particle == except)
            continue;
        if (++count <= most)
            text += fmt::format("{}{}", text.empty() ? "" : " ", contender.particle);
    }
    if (count > most)
        text += fmt::format(" and {} more", count - most);
    return text.empty() ? "nobody" : text;
}

/// Of an image that is drawn otherwise than the listing's: what is stored, beside what the reference draws of the GPU's
/// own particles.
TexelTable drawn_texel_table(FrameRun& run, std::size_t texel) {
    const JudgedFrame frame = run.judged();
    StepRows rows;
    const glm::vec4 reference = run.redrawn().texels[texel], gpu = frame.gpu_cdt.texels[texel];
    for (int c = 0; c < 4; ++c)
        rows.number(fmt::format("stored.{}", "xyzw"[c]), {}, reference[c], gpu[c],
                    legal_value(Interval(reference[c]), gpu[c]));
    return {run.frame(), texel, rows.take(), {}};
}

} // namespace

std::string texel_text(glm::ivec2 texel) {
    return texel.x < 0 ? std::string("none") : fmt::format("({}, {})", texel.x, texel.y);
}

std::optional<Interval> legal_depth(const JudgedFrame& frame, glm::ivec2 texel, std::size_t particle) {
    return depth_of(legal_texel(frame, frame.gpu_cdt.index(texel.x, texel.y)), particle);
}

void add_contest(FrameRun& run, glm::ivec2 texel, std::size_t particle, StepRows& rows) {
    const std::vector<Contender> wanted = contenders(run.judged(), texel);
    std::string rivals = list_of(wanted, particle);
    if (run.obstacle_depth().at(texel.x, texel.y) < run.judged().params.clip_depth.cleared())
        rivals = rivals == "nobody" ? "an obstacle" : "an obstacle, " + rivals;
    rows.only_reference("also wanted by", {}, {{}, rivals});
    add_winner(run, texel, wanted, rows);
}

TexelTable texel_table(FrameRun& run, std::size_t texel) {
    if (!is_listing(run.scene().switches))
        return drawn_texel_table(run, texel);
    const JudgedFrame frame = run.judged();
    const auto width = static_cast<std::size_t>(frame.params.width);
    const glm::ivec2 at(static_cast<int>(texel % width), static_cast<int>(texel / width));
    std::vector<Contender> wanted = contenders(frame, at);
    const auto by_reference = wanted.size();
    const glm::vec4 gpu_code = frame.gpu_cdt.texels[texel];
    const auto gpu_owner = particle_of(gpu_code, frame, wanted);
    const auto reference_owner = particle_of(run.redrawn().texels[texel], frame, wanted);
    const auto has = [&](std::size_t particle) {
        return std::any_of(wanted.begin(), wanted.end(), [&](const Contender& c) { return c.particle == particle; });
    };
    if (gpu_code.a != 0.0F && gpu_owner && !has(*gpu_owner))
        wanted.push_back({*gpu_owner, frame.params.clip_depth.cleared()});

    StepRows rows;
    if (const float depth = run.obstacle_depth().at(at.x, at.y); depth < frame.params.clip_depth.cleared())
        rows.only_reference("an obstacle's depth", {}, {depth, {}});
    const LegalTexel legal = legal_texel(frame, texel);
    constexpr std::size_t most = 32;
    for (std::size_t i = 0; i < std::min(wanted.size(), most); ++i) {
        const std::size_t particle = wanted[i].particle;
        const StepCapture capture = run.capture(particle);
        const bool drawn = capture.texel == at;
        const std::optional<float> gpu = drawn ? std::optional(capture.depth) : std::nullopt;
        const std::optional<float> reference = i < by_reference ? std::optional(wanted[i].depth) : std::nullopt;
        const Interval depth = depth_of(legal, particle).value_or(Interval(wanted[i].depth));
        rows.number(fmt::format("particle {}'s depth", particle), {}, reference, gpu, legal_value(depth, gpu));
    }
    add_winner(run, at, wanted, rows);
    TexelTable table{run.frame(), texel, rows.take(), {}};
    for (const auto& owner : {reference_owner, gpu_owner})
        if (owner && std::find(table.particles.begin(), table.particles.end(), *owner) == table.particles.end())
            table.particles.push_back(*owner);
    return table;
}

} // namespace lockstep
