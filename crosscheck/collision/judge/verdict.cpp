#include "crosscheck/collision/judge/verdict.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>

#include "crosscheck/collision/judge/step_judge.hpp"
#include "crosscheck/judge/compare.hpp"
#include "crosscheck/judge/item_judge.hpp"
#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass_fast.hpp"
#include "reference/collision/layered_collision_pass.hpp"
#include "reference/collision/legal_texels.hpp"
#include "reference/collision/obstacle_pass.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/collision/layered_cdt.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {
namespace {

/// The legal sets of a texel that stores a particle's position, from the particle's own. Empty: those are not known.
std::vector<Interval> sets_of_texel(const JudgedFrame& frame, const ItemVerdict& particle) {
    if (particle.sets.empty())
        return {};
    const std::vector<Component> parts = components(collision_schema().resources[collision::particles]);
    std::array<Interval, 3> position;
    glm::vec3 low, high;
    for (std::size_t c = 0; c < parts.size(); ++c)
        if (parts[c].field == collision::position.field) {
            const int at = parts[c].component;
            position[static_cast<std::size_t>(at)] = particle.sets[c];
            low[at] = static_cast<float>(particle.sets[c].low);
            high[at] = static_cast<float>(particle.sets[c].high);
        }
    const CollisionCode code(frame.params);
    const auto [from, to] =
        frame.known.converts.particles ? code.driver_codes(low, high) : std::pair(code.encode(low), code.encode(high));
    std::vector<Interval> sets;
    for (int c = 0; c < 4; ++c)
        sets.push_back(c < 3 && position[static_cast<std::size_t>(c)].any
                           ? Interval::anything()
                           : Interval(static_cast<double>(from[c]), static_cast<double>(to[c])));
    return sets;
}

/// The differing particles, by the texels they are drawn to on either side.
class ParticlesByTexel {
  public:
    struct Drawn {
        const ItemVerdict* worst = nullptr;  ///< by its class
        const ItemVerdict* stored = nullptr; ///< its position is what the GPU has in the texel; null: another's is
    };

    ParticlesByTexel(const JudgedFrame& frame, const std::vector<ItemVerdict>& particles) : frame_(frame) {
        const bool updated = frame.params.switches.raster_position == RasterPosition::updated;
        const CollisionCode code(frame.params);
        for (const ItemVerdict& verdict : particles) {
            const std::size_t i = verdict.index;
            Drawn* const at = note(updated ? frame.gpu.position[i] : frame.before.position[i], verdict);
            if (at != nullptr && same_bits(code.encode(frame.gpu.position[i]), frame.gpu_cdt.texels[texel_]))
                at->stored = &verdict;
            if (updated)
                note(frame.reference.position[i], verdict);
        }
    }

    /// Null where none is drawn.
    [[nodiscard]] const Drawn* at(std::size_t texel) const {
        const auto found = drawn_.find(texel);
        return found == drawn_.end() ? nullptr : &found->second;
    }

  private:
    Drawn* note(glm::vec3 position, const ItemVerdict& verdict) {
        const PointFragment point = point_fragment(position, frame_.params, frame_.profile);
        if (point.x < 0)
            return nullptr;
        texel_ = frame_.gpu_cdt.index(point.x, point.y);
        Drawn& drawn = drawn_[texel_];
        if (drawn.worst == nullptr || drawn.worst->kind < verdict.kind)
            drawn.worst = &verdict;
        return &drawn;
    }

    const JudgedFrame& frame_;
    std::size_t texel_ = 0;
    std::unordered_map<std::size_t, Drawn> drawn_;
};

/// The verdict on a texel that holds what the GPU's own particles leave there: its class is the worst of theirs. What
/// is of a particle's components stays with it.
ItemVerdict followed(const JudgedFrame& frame, std::size_t texel, const ParticlesByTexel::Drawn& drawn) {
    ItemVerdict verdict{.index = texel,
                        .kind = drawn.worst->kind,
                        .tie = drawn.worst->tie,
                        .undefined = drawn.worst->undefined,
                        .follows_particle = true};
    if (verdict.kind < DifferenceClass::undefined && drawn.stored != nullptr)
        verdict.sets = sets_of_texel(frame, *drawn.stored);
    return verdict;
}

/// A point that may land on several texels of the image.
struct Wanderer {
    std::vector<std::size_t> reach;   ///< the texels
    std::vector<std::size_t> differs; ///< of those judged, where it may have been drawn
};

std::map<std::size_t, Wanderer> wanderers(const std::vector<LegalTexel>& legal, const CollisionImage& cdt) {
    std::map<std::size_t, Wanderer> found;
    for (std::size_t i = 0; i < legal.size(); ++i)
        for (const TexelOwner& owner : legal[i].owners) {
            const PixelRect& reach = owner.reach;
            const bool on_image = reach.x0 >= 0 && reach.y0 >= 0 && reach.x1 <= cdt.width && reach.y1 <= cdt.height;
            const bool several = reach.x1 - reach.x0 > 1 || reach.y1 - reach.y0 > 1;
            if (owner.kind != TexelOwner::Kind::particle || owner.may_be_clipped || !on_image || !several)
                continue;
            Wanderer& wanderer = found[owner.index];
            wanderer.differs.push_back(i);
            if (wanderer.reach.empty())
                for (int y = reach.y0; y < reach.y1; ++y)
                    for (int x = reach.x0; x < reach.x1; ++x)
                        wanderer.reach.push_back(cdt.index(x, y));
        }
    return found;
}

/// Whether a point is on one of the texels that it may land on, or may be hidden there; and on no second one.
bool is_conserved(std::size_t particle, const Wanderer& wanderer, const std::map<std::size_t, LegalTexel>& legal,
                  const CollisionImage& gpu) {
    int drawn = 0;
    bool may_be_hidden = false;
    bool may_be_another = false;
    for (const std::size_t texel : wanderer.reach) {
        const LegalTexel& of_texel = legal.at(texel);
        const auto is_point = [&](const TexelOwner& owner) {
            return owner.kind == TexelOwner::Kind::particle && owner.index == particle;
        };
        const auto own = std::find_if(of_texel.owners.begin(), of_texel.owners.end(), is_point);
        const TexelOwner* owner = of_texel.owner_of(gpu.texels[texel]);
        if (own == of_texel.owners.end() || owner == nullptr) {
            may_be_hidden = true;
        } else if (own->stores(gpu.texels[texel])) {
            ++drawn;
            may_be_another = may_be_another ||
                             std::any_of(of_texel.owners.begin(), of_texel.owners.end(), [&](const TexelOwner& other) {
                                 return !is_point(other) && other.stores(gpu.texels[texel]);
                             });
        } else if (owner->kind != TexelOwner::Kind::nothing && owner->depth.low <= own->depth.high) {
            may_be_hidden = true;
        }
    }
    return drawn == 1 || (drawn == 0 && may_be_hidden) || (drawn > 1 && may_be_another);
}

/// Each texel by itself may be legal where a point was dropped at the edge of a pixel, or drawn on both sides.
void convict_lost_points(const JudgedFrame& frame, const DrawnFrame& drawn, const std::vector<LegalTexel>& legal,
                         std::vector<ItemVerdict>& verdicts) {
    const std::map<std::size_t, Wanderer> points = wanderers(legal, frame.gpu_cdt);
    std::set<std::size_t> wanted;
    for (const auto& [particle, wanderer] : points)
        wanted.insert(wanderer.reach.begin(), wanderer.reach.end());
    if (wanted.empty())
        return;
    const std::vector<std::size_t> texels(wanted.begin(), wanted.end());
    const auto around = legal_texels(drawn, frame.known, texels);
    std::map<std::size_t, LegalTexel> by_texel;
    for (std::size_t i = 0; i < texels.size(); ++i)
        by_texel.emplace(texels[i], around[i]);
    for (const auto& [particle, wanderer] : points)
        if (!is_conserved(particle, wanderer, by_texel, frame.gpu_cdt))
            for (const std::size_t i : wanderer.differs) {
                verdicts[i].kind = DifferenceClass::divergent;
                verdicts[i].tie = std::nullopt;
                verdicts[i].sets.clear();
            }
}

/// The signs of a shift. A side says nothing of a shift along it, and one that is oblique not along which axis it was.
glm::ivec2 signs(glm::dvec2 shift, bool is_side) {
    const auto sign = [](double x) { return x < 0.0 ? -1 : x > 0.0 ? 1 : 0; };
    const glm::dvec2 size = glm::abs(shift);
    if (!is_side)
        return {sign(shift.x), sign(shift.y)};
    return {size.x >= 2.0 * size.y ? sign(shift.x) : 0, size.y >= 2.0 * size.x ? sign(shift.y) : 0};
}

/// What a shift would have to be, to leave `gpu` in a texel by the widest of GL's rules.
std::optional<Lean> lean_of(const LegalTexel& widest, glm::vec4 gpu) {
    const TexelOwner* owner = widest.owner_of(gpu);
    if (owner == nullptr || owner->is_reference || owner->outside)
        return {};
    const auto reference = std::find_if(widest.owners.begin(), widest.owners.end(),
                                        [](const TexelOwner& other) { return other.is_reference; });
    const TexelOwner* cause = owner;
    const bool moved_here = owner->shift != glm::dvec2(0.0) && !owner->drawn_by_reference;
    if (!moved_here) // then what the reference has here went elsewhere; of a point, that is told where it went
        cause =
            reference != widest.owners.end() && reference->kind == TexelOwner::Kind::obstacle ? &*reference : nullptr;
    if (cause == nullptr || cause->shift == glm::dvec2(0.0))
        return {};
    Lean lean;
    lean.direction = signs(cause->shift, cause->is_side);
    lean.place = cause->place;
    return lean;
}

/// Tells of ties and divergent texels which way things are shifted, if they are.
void add_leans(const JudgedFrame& frame, const DrawnFrame& drawn, std::vector<ItemVerdict>& verdicts) {
    std::vector<std::size_t> texels;
    for (const ItemVerdict& verdict : verdicts)
        if (verdict.kind == DifferenceClass::divergent || verdict.kind == DifferenceClass::tie)
            texels.push_back(verdict.index);
    if (texels.empty())
        return;
    const auto legal_if = [&](const KnownRaster& raster) {
        KnownOperations known = frame.known;
        known.points = false;
        known.raster = raster;
        return legal_texels(drawn, known, texels);
    };
    const std::vector<LegalTexel> widest = legal_if({});
    KnownRaster accurate = KnownRaster::all();
    accurate.point_window = accurate.triangle_window = false;
    accurate.point_window_accurate = accurate.corner_window_accurate = true;
    const std::vector<LegalTexel> rounded = legal_if(accurate);
    const CollisionImage& cdt = frame.gpu_cdt;
    auto next = verdicts.begin();
    for (std::size_t i = 0; i < texels.size(); ++i) {
        next = std::find_if(next, verdicts.end(), [&](const ItemVerdict& v) { return v.index == texels[i]; });
        next->lean = lean_of(widest[i], cdt.texels[texels[i]]);
        if (!next->lean)
            continue;
        next->lean->beyond_rounding = rounded[i].owner_of(cdt.texels[texels[i]]) == nullptr;
        next->lean->right_half =
            2 * (texels[i] % static_cast<std::size_t>(cdt.width)) >= static_cast<std::size_t>(cdt.width);
        next->lean->upper_half =
            2 * (texels[i] / static_cast<std::size_t>(cdt.width)) >= static_cast<std::size_t>(cdt.height);
    }
}

std::vector<ItemVerdict> judge_texels(const JudgedFrame& frame, const std::vector<ItemVerdict>& particles) {
    const std::vector<std::size_t> differing = differing_items(frame.reference_cdt, frame.gpu_cdt);
    std::vector<ItemVerdict> verdicts;
    if (differing.empty())
        return verdicts;
    std::optional<CollisionImage> expected; // where no particle differs there is nothing to inherit
    const ParticlesByTexel drawn_particles(frame, particles);
    std::vector<std::size_t> unexplained;
    for (const std::size_t texel : differing) {
        const ParticlesByTexel::Drawn* const particle = drawn_particles.at(texel);
        if (particle != nullptr && !expected)
            expected = redraw(frame);
        if (particle == nullptr || !same_bits(expected->texels[texel], frame.gpu_cdt.texels[texel])) {
            unexplained.push_back(texel);
            continue;
        }
        verdicts.push_back(followed(frame, texel, *particle));
    }
    const DrawnFrame drawn(frame.obstacles, frame.before, frame.gpu, frame.params, frame.profile,
                           frame.texels_of_points);
    const auto legal = legal_texels(drawn, frame.known, unexplained);
    std::vector<ItemVerdict> judged;
    for (std::size_t i = 0; i < unexplained.size(); ++i)
        judged.push_back(judge_texel(unexplained[i], legal[i], frame.gpu_cdt.texels[unexplained[i]]));
    convict_lost_points(frame, drawn, legal, judged);
    add_leans(frame, drawn, judged);
    verdicts.insert(verdicts.end(), judged.begin(), judged.end());
    std::sort(verdicts.begin(), verdicts.end(),
              [](const ItemVerdict& a, const ItemVerdict& b) { return a.index < b.index; });
    return verdicts;
}

} // namespace

CollisionImage redraw(const JudgedFrame& frame) {
    if (has_remedies(frame.params.switches)) {
        CollisionImage planes = frame.gpu_cdt; // of its size
        draw_layered_cdt(frame.gpu, frame.obstacles, frame.params, frame.profile, planes);
        return planes;
    }
    CollisionImage cdt(frame.params.width, frame.params.height);
    if (frame.params.switches.search == Search::octree)
        return cdt;
    DepthImage depth(frame.params.width, frame.params.height, frame.params.clip_depth.cleared());
    obstacle_pass(frame.obstacles, frame.params, frame.profile, cdt, depth);
    if (frame.params.switches.search == Search::cdt)
        rasterise_particles_fast(frame.before, frame.gpu, frame.params, frame.profile, cdt, depth);
    return cdt;
}

ItemVerdict judge_particle(const JudgedFrame& frame, std::size_t particle) {
    return with_step_pass(frame, [&](const JudgedPass& pass) { return judge_item(pass, particle); });
}

FrameVerdicts judge(const JudgedFrame& frame) {
    if (!is_listing(frame.params.switches))
        return judge_by_twin(frame);
    FrameVerdicts verdicts;
    if (frame.particles_differ)
        verdicts.particles = with_step_pass(frame, judge_items);
    verdicts.texels = judge_texels(frame, verdicts.particles);
    return verdicts;
}

} // namespace lockstep
