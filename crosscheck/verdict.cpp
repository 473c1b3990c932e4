#include "crosscheck/verdict.hpp"

#include <algorithm>
#include <unordered_map>

#include "crosscheck/compare.hpp"
#include "reference/collision_pass.hpp"
#include "reference/legal_texels.hpp"
#include "reference/model/same_bits.hpp"
#include "reference/obstacle_pass.hpp"
#include "reference/step_trace.hpp"

namespace lockstep {
namespace {

bool same_texel(const CollisionImage& cdt, BaseTexelIndex a, BaseTexelIndex b) {
    const auto code = [&](BaseTexelIndex t) { return cdt.contains(t.x, t.y) ? cdt.at(t.x, t.y) : glm::vec4(0.0F); };
    return same_bits(code(a), code(b));
}

/// Whether an outcome decides as the reference did: a hit or none, and of the same stored positions.
bool decides_alike(const LegalOutcome& outcome, const StepTrace& reference, const JudgedFrame& frame) {
    if (outcome.hit != reference.nearest.has_value())
        return false;
    if (!outcome.hit)
        return true;
    const bool own_from_texel = frame.params.switches.self_position == SelfPosition::texel;
    return same_texel(frame.cdt, outcome.neighbour, reference.neighbours[*reference.nearest].texel) &&
           (!own_from_texel || same_texel(frame.cdt, outcome.base, reference.base));
}

/// The tie that led to `outcome` instead of the reference's.
std::optional<Tie> deciding_tie(const LegalOutcome& outcome, const StepTrace& reference) {
    const auto of_kind = [&](TieKind kind) {
        return std::find_if(outcome.ties.begin(), outcome.ties.end(), [&](const Tie& t) { return t.kind == kind; });
    };
    const bool same_base = outcome.base.x == reference.base.x && outcome.base.y == reference.base.y;
    if (outcome.hit && reference.nearest && same_base)
        if (const auto nearest = of_kind(TieKind::nearest); nearest != outcome.ties.end())
            return *nearest;
    if (outcome.ties.empty())
        return {};
    return outcome.ties.front();
}

/// The classes of differing particles, by the texels they are drawn to on either side.
class ClassesByTexel {
  public:
    ClassesByTexel(const JudgedFrame& frame, const std::vector<ItemVerdict>& particles) : frame_(frame) {
        const bool updated = frame.params.switches.raster_position == RasterPosition::updated;
        for (const ItemVerdict& verdict : particles) {
            const std::size_t i = verdict.index;
            note(updated ? frame.gpu.position[i] : frame.before.position[i], verdict);
            if (updated)
                note(frame.reference.position[i], verdict);
        }
    }

    /// The worst; null where none is drawn.
    [[nodiscard]] const ItemVerdict* worst(std::size_t texel) const {
        const auto found = worst_.find(texel);
        return found == worst_.end() ? nullptr : found->second;
    }

  private:
    void note(glm::vec3 position, const ItemVerdict& verdict) {
        const PointFragment point = point_fragment(position, frame_.params, frame_.profile);
        if (point.x < 0)
            return;
        const ItemVerdict*& known = worst_[frame_.gpu_cdt.index(point.x, point.y)];
        if (known == nullptr || known->kind < verdict.kind)
            known = &verdict;
    }

    const JudgedFrame& frame_;
    std::unordered_map<std::size_t, const ItemVerdict*> worst_;
};

ItemVerdict judge_texel(std::size_t texel, const LegalTexel& legal, glm::vec4 gpu) {
    ItemVerdict verdict{.index = texel, .outcomes = legal.owners.size()};
    const TexelOwner* owner = legal.owner_of(gpu);
    if (owner == nullptr)
        return verdict;
    const std::vector<Tie> ties = legal.ties(*owner);
    verdict.kind = ties.empty() ? DifferenceClass::rounding : DifferenceClass::tie;
    if (!ties.empty())
        verdict.tie = ties.front();
    return verdict;
}

std::vector<ItemVerdict> judge_texels(const JudgedFrame& frame, const std::vector<ItemVerdict>& particles) {
    const std::vector<std::size_t> differing = differing_texels(frame.reference_cdt, frame.gpu_cdt);
    std::vector<ItemVerdict> verdicts;
    if (differing.empty())
        return verdicts;
    const CollisionImage expected = redraw(frame);
    const ClassesByTexel classes(frame, particles);
    std::vector<std::size_t> unexplained;
    for (const std::size_t texel : differing) {
        const ItemVerdict* cause = classes.worst(texel);
        if (cause == nullptr || !same_bits(expected.texels[texel], frame.gpu_cdt.texels[texel])) {
            unexplained.push_back(texel);
            continue;
        }
        ItemVerdict inherited = *cause;
        inherited.index = texel;
        inherited.outcomes = 1;
        inherited.follows_particle = true;
        verdicts.push_back(inherited);
    }
    const auto legal =
        legal_texels(frame.obstacles, frame.before, frame.gpu, frame.params, frame.profile, frame.known, unexplained);
    for (std::size_t i = 0; i < unexplained.size(); ++i)
        verdicts.push_back(judge_texel(unexplained[i], legal[i], frame.gpu_cdt.texels[unexplained[i]]));
    std::sort(verdicts.begin(), verdicts.end(),
              [](const ItemVerdict& a, const ItemVerdict& b) { return a.index < b.index; });
    return verdicts;
}

} // namespace

CollisionImage redraw(const JudgedFrame& frame) {
    CollisionImage cdt(frame.params.width, frame.params.height);
    DepthImage depth(frame.params.width, frame.params.height, 1.0F);
    obstacle_pass(frame.obstacles, frame.params, frame.profile, cdt, depth);
    rasterise_particles(frame.before, frame.gpu, frame.params, frame.profile, cdt, depth);
    return cdt;
}

ItemVerdict judge_particle(const JudgedFrame& frame, std::size_t particle) {
    const ParticleState gpu = frame.gpu[particle];
    const std::vector<LegalOutcome> outcomes =
        legal_outcomes(frame.before[particle], frame.cdt, frame.params, frame.profile, frame.known, &gpu);
    ItemVerdict verdict{.index = particle, .outcomes = outcomes.size()};
    const StepTrace reference = trace_step(frame.before[particle], frame.cdt, frame.params, frame.profile);
    for (const LegalOutcome& outcome : outcomes) {
        if (!outcome.contains(gpu))
            continue;
        DifferenceClass kind = DifferenceClass::tie;
        if (outcome.undefined != Undefined::none)
            kind = DifferenceClass::undefined;
        else if (outcomes.size() == 1 || decides_alike(outcome, reference, frame))
            kind = DifferenceClass::rounding;
        if (kind >= verdict.kind)
            continue;
        verdict.kind = kind;
        verdict.undefined = outcome.undefined;
        verdict.tie = kind == DifferenceClass::tie ? deciding_tie(outcome, reference) : std::nullopt;
    }
    return verdict;
}

FrameVerdicts judge(const JudgedFrame& frame) {
    const std::vector<std::size_t> differing = differing_particles(frame.reference, frame.gpu);
    FrameVerdicts verdicts;
    verdicts.particles.resize(differing.size());
    const auto count = static_cast<std::ptrdiff_t>(differing.size());
#pragma omp parallel for schedule(dynamic, 64) if (count > 256)
    for (std::ptrdiff_t i = 0; i < count; ++i)
        verdicts.particles[static_cast<std::size_t>(i)] = judge_particle(frame, differing[static_cast<std::size_t>(i)]);
    verdicts.texels = judge_texels(frame, verdicts.particles);
    return verdicts;
}

} // namespace lockstep
