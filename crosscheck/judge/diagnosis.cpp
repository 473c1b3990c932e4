#include "crosscheck/judge/diagnosis.hpp"

#include "crosscheck/judge/item_judge.hpp"
#include "crosscheck/judge/step_judge.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "reference/arithmetic.hpp"
#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/legal_texels.hpp"
#include "reference/collision/step_trace.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/same_bits.hpp"

namespace lockstep {
namespace {

std::string hex(glm::vec3 v) { return fmt::format("({:a}, {:a}, {:a})", v.x, v.y, v.z); }

bool contains(const Interval3& set, glm::vec3 v) {
    return set[0].contains(v.x) && set[1].contains(v.y) && set[2].contains(v.z);
}

/// ULP from a value to the nearest legal one.
std::int64_t distance_to(const Interval& legal, float value) {
    if (legal.contains(value))
        return 0;
    if (std::isnan(legal.low))
        return INT64_MAX;
    return std::min(ulp_distance(value, static_cast<float>(legal.low)),
                    ulp_distance(value, static_cast<float>(legal.high)));
}

std::string ulp_text(std::int64_t ulp) {
    return ulp == INT64_MAX ? "NaN on one side" : fmt::format("{} ULP from what is legal", ulp);
}

Difference difference(FieldId field, std::size_t index, int component, float reference, float gpu) {
    return {field, index, component, reference, gpu, ulp_distance(reference, gpu)};
}

/// The component of a vector that differs first.
Difference vector_difference(FieldId field, std::size_t index, glm::vec3 reference, glm::vec3 gpu) {
    int component = 0;
    while (component < 2 && same_bits(reference[component], gpu[component]))
        ++component;
    return difference(field, index, component, reference[component], gpu[component]);
}

/// A particle's reference run beside its legal outcomes and the GPU's state.
class ParticleDiagnosis {
  public:
    ParticleDiagnosis(const JudgedFrame& frame, std::size_t particle)
        : frame_(frame), particle_(particle), gpu_(frame.gpu[particle]), reference_(frame.reference[particle]),
          trace_(trace_step(frame.before[particle], frame.cdt, frame.params, frame.profile)),
          outcomes_(
              legal_outcomes(frame.before[particle], frame.cdt, frame.params, frame.profile, frame.known, &gpu_)) {}

    WrongStep operator()() {
        if (!keep([&](const LegalOutcome& o) { return o.collide_time.contains(gpu_.collide_time); }))
            return wrong_decision();
        if (!keep([&](const LegalOutcome& o) { return o.speed.contains(gpu_.speed); }))
            return wrong_speed();
        if (!keep([&](const LegalOutcome& o) { return lockstep::contains(o.direction, gpu_.direction); }))
            return wrong_direction();
        // What is undefined allows any field: then the first that differs.
        const bool undefined = outcomes_.front().undefined != Undefined::none;
        return undefined && !same_bits(gpu_.direction, reference_.direction) ? wrong_direction() : wrong_position();
    }

  private:
    /// Keeps the outcomes that a condition allows; if none would be left, all, and false.
    template <class Condition> bool keep(const Condition& condition) {
        std::vector<LegalOutcome> kept;
        std::copy_if(outcomes_.begin(), outcomes_.end(), std::back_inserter(kept), condition);
        if (kept.empty())
            return false;
        outcomes_ = kept;
        return true;
    }

    [[nodiscard]] bool hit() const { return outcomes_.front().hit; }

    /// Hit or none, by the collide time.
    WrongStep wrong_decision() {
        const Constants& constants = frame_.params.constants;
        WrongStep wrong;
        wrong.difference =
            difference(collision::collide_time, particle_, 0, reference_.collide_time, gpu_.collide_time);
        const bool gpu_hit = same_bits(gpu_.collide_time, constants.collision_time);
        if (answers_as(trace_.nearest.has_value())) // the search is right: its end alone is not
            return wrong_collide_time(std::move(wrong));
        const bool may_hit = std::any_of(outcomes_.begin(), outcomes_.end(), [](const auto& o) { return o.hit; });
        if (gpu_hit && !may_hit) {
            wrong.gpu = "a hit: its collide time was set";
            if (!(frame_.before.collide_time[particle_] < 0.0F)) {
                wrong.step = "search";
                wrong.operation = fmt::format("collide time {:a} < 0: no", frame_.before.collide_time[particle_]);
            } else if (trace_.base.x < 0) {
                wrong.step = "base texel";
                wrong.operation = fmt::format("image position ({:a}, {:a}): outside the image", trace_.image_position.x,
                                              trace_.image_position.y);
            } else {
                wrong.step = "nearest";
                wrong.operation = no_hit_text();
            }
            return wrong;
        }
        const bool counted = same_bits(gpu_.collide_time, trace_.before.collide_time - constants.tick);
        if (trace_.nearest && counted) {
            wrong.step = "nearest";
            wrong.operation = nearest_text();
            wrong.gpu = "no hit: its collide time was counted";
            return wrong;
        }
        return wrong_collide_time(std::move(wrong));
    }

    /// Whether speed and direction are what a hit, or none, leaves; and not the other as well.
    [[nodiscard]] bool answers_as(bool hit) const {
        const auto fits = [&](bool as_hit) {
            return std::any_of(outcomes_.begin(), outcomes_.end(), [&](const LegalOutcome& o) {
                return o.hit == as_hit && o.undefined == Undefined::none && o.speed.contains(gpu_.speed) &&
                       lockstep::contains(o.direction, gpu_.direction);
            });
        };
        return fits(hit) && !fits(!hit);
    }

    [[nodiscard]] WrongStep wrong_collide_time(WrongStep wrong) const {
        const Constants& constants = frame_.params.constants;
        wrong.step = "collide time";
        wrong.operation = trace_.nearest ? fmt::format("collision time {:a}", constants.collision_time)
                                         : fmt::format("{:a} - tick {:a}", trace_.before.collide_time, constants.tick);
        wrong.margin = ulp_text(distance_to(outcomes_.front().collide_time, gpu_.collide_time));
        return wrong;
    }

    [[nodiscard]] WrongStep wrong_speed() const {
        WrongStep wrong;
        wrong.step = "speed";
        wrong.operation =
            hit() ? fmt::format("speed {:a} * factor {:a}", trace_.before.speed, frame_.params.switches.speed_factor)
                  : fmt::format("length of velocity {}", hex(trace_.velocity));
        wrong.margin = ulp_text(distance_to(outcomes_.front().speed, gpu_.speed));
        wrong.difference = difference(collision::speed, particle_, 0, reference_.speed, gpu_.speed);
        return wrong;
    }

    [[nodiscard]] WrongStep wrong_direction() const {
        WrongStep wrong;
        wrong.difference = vector_difference(collision::direction, particle_, reference_.direction, gpu_.direction);
        std::int64_t margin = 0;
        for (int c = 0; c < 3; ++c)
            margin = std::max(margin,
                              distance_to(outcomes_.front().direction[static_cast<std::size_t>(c)], gpu_.direction[c]));
        wrong.margin = ulp_text(margin);
        if (!hit() || !trace_.nearest) {
            wrong.step = "direction";
            wrong.operation = fmt::format("normalize of velocity {}", hex(trace_.velocity));
            return wrong;
        }
        if (const auto other = neighbour_of(gpu_.direction)) {
            wrong.step = "nearest";
            wrong.operation = nearest_text();
            wrong.gpu = fmt::format("texel ({}, {}) at distance {:a}", other->texel.x, other->texel.y, other->distance);
            wrong.margin.clear();
            return wrong;
        }
        wrong.step = "direction";
        wrong.operation = fmt::format("normalize of {}, away from texel ({}, {})", hex(nearest().apart),
                                      nearest().texel.x, nearest().texel.y);
        return wrong;
    }

    [[nodiscard]] WrongStep wrong_position() const {
        WrongStep wrong;
        wrong.step = "position";
        const bool by_tick = !hit() || frame_.params.switches.collision_step == CollisionStep::tick;
        wrong.operation =
            fmt::format("{} + {} * {:a}{}", hex(trace_.before.position), hex(gpu_.direction), gpu_.speed,
                        by_tick ? fmt::format(" * tick {:a}", frame_.params.constants.tick) : std::string());
        std::int64_t margin = INT64_MAX;
        for (const LegalOutcome& outcome : outcomes_) {
            std::int64_t worst = 0;
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst, distance_to(outcome.position[static_cast<std::size_t>(c)], gpu_.position[c]));
            margin = std::min(margin, worst);
        }
        wrong.margin = ulp_text(margin);
        wrong.difference = vector_difference(collision::position, particle_, reference_.position, gpu_.position);
        return wrong;
    }

    [[nodiscard]] const NeighbourTrace& nearest() const { return trace_.neighbours[*trace_.nearest]; }

    [[nodiscard]] std::string nearest_text() const {
        return fmt::format("texel ({}, {}) at distance {:a} is within the range {:a} and nearest", nearest().texel.x,
                           nearest().texel.y, nearest().distance, frame_.params.constants.collision_range);
    }

    [[nodiscard]] std::string no_hit_text() const {
        const NeighbourTrace* closest = nullptr;
        for (const NeighbourTrace& neighbour : trace_.neighbours)
            if (neighbour.compared && (closest == nullptr || neighbour.distance < closest->distance))
                closest = &neighbour;
        if (closest == nullptr)
            return fmt::format("no texel round ({}, {}) holds another particle", trace_.base.x, trace_.base.y);
        return fmt::format("texel ({}, {}) is nearest, at distance {:a}; the range is {:a}", closest->texel.x,
                           closest->texel.y, closest->distance, frame_.params.constants.collision_range);
    }

    /// The other neighbour that a direction leads away from.
    [[nodiscard]] std::optional<NeighbourTrace> neighbour_of(glm::vec3 direction) const {
        const LegalArithmetic arithmetic(Strict{}, KnownOperations{});
        for (const NeighbourTrace& neighbour : trace_.neighbours)
            if (neighbour.compared && &neighbour != &nearest() &&
                lockstep::contains(arithmetic.normalize(arithmetic.read(neighbour.apart)), direction))
                return neighbour;
        return {};
    }

    const JudgedFrame& frame_;
    std::size_t particle_;
    ParticleState gpu_, reference_;
    StepTrace trace_;
    std::vector<LegalOutcome> outcomes_;
};

std::string owner_text(const TexelOwner& owner, const JudgedFrame& frame) {
    switch (owner.kind) {
    case TexelOwner::Kind::nothing:
        return "nothing is drawn here";
    case TexelOwner::Kind::obstacle:
        return fmt::format("obstacle primitive {} at depth {:a}", owner.index, owner.reference_depth);
    case TexelOwner::Kind::particle:
        break;
    }
    const glm::vec3 position = frame.params.switches.raster_position == RasterPosition::updated
                                   ? frame.gpu.position[owner.index]
                                   : frame.before.position[owner.index];
    const PointFragment point = point_fragment(position, frame.params, frame.profile);
    return fmt::format("particle {}, drawn to ({}, {}) at depth {:a}", owner.index, point.x, point.y, point.depth);
}

} // namespace

WrongStep wrong_step_of_particle(const JudgedFrame& frame, std::size_t particle) {
    if (!is_listing(frame.params.switches))
        return with_step_pass(frame, [&](const JudgedPass& pass) { return wrong_step_of_item(pass, particle); });
    return ParticleDiagnosis(frame, particle)();
}

WrongStep wrong_step_of_texel(const JudgedFrame& frame, std::size_t texel) {
    if (!is_listing(frame.params.switches))
        return wrong_drawn_texel(frame, texel);
    const std::size_t wanted[] = {texel};
    const LegalTexel legal =
        legal_texels(frame.obstacles, frame.before, frame.gpu, frame.params, frame.profile, frame.known, wanted)[0];
    const glm::vec4 gpu = frame.gpu_cdt.texels[texel];
    const auto reference =
        std::find_if(legal.owners.begin(), legal.owners.end(), [](const TexelOwner& o) { return o.is_reference; });
    const TexelOwner owner = reference == legal.owners.end() ? legal.owners.front() : *reference;
    WrongStep wrong;
    int component = 0;
    while (component < 3 && same_bits(owner.code[component], gpu[component]))
        ++component;
    wrong.difference = difference(collision::texel, texel, component, owner.code[component], gpu[component]);
    wrong.operation = owner_text(owner, frame);
    if (gpu.a == 0.0F) {
        wrong.step = "texel";
        wrong.gpu = "the texel is empty";
        return wrong;
    }
    const CollisionCode code(frame.params);
    for (std::size_t i = 0; i < frame.gpu.size(); ++i) {
        if (!same_bits(code.encode(frame.gpu.position[i]), gpu))
            continue;
        const TexelOwner stored{.kind = TexelOwner::Kind::particle, .index = i};
        wrong.gpu = owner_text(stored, frame);
        const PointFragment point =
            point_fragment(frame.params.switches.raster_position == RasterPosition::updated ? frame.gpu.position[i]
                                                                                            : frame.before.position[i],
                           frame.params, frame.profile);
        const bool drawn_here = point.x >= 0 && frame.gpu_cdt.index(point.x, point.y) == texel;
        wrong.step = drawn_here ? "depth" : "window position";
        return wrong;
    }
    wrong.step = "stored value";
    wrong.gpu = "no particle of this frame has this position";
    return wrong;
}

std::optional<FirstDivergence> first_of(DifferenceClass kind, int frame, const JudgedFrame& judged,
                                        const FrameVerdicts& verdicts) {
    const auto find = [&](const std::vector<ItemVerdict>& items) {
        return std::find_if(items.begin(), items.end(), [&](const ItemVerdict& item) { return item.kind == kind; });
    };
    if (const auto found = find(verdicts.particles); found != verdicts.particles.end())
        return FirstDivergence{
            {frame, collision::particles, found->index}, *found, wrong_step_of_particle(judged, found->index)};
    if (const auto found = find(verdicts.texels); found != verdicts.texels.end())
        return FirstDivergence{
            {frame, collision::cdt, found->index}, *found, wrong_step_of_texel(judged, found->index)};
    return {};
}

bool can_judge_leans(const KnownOperations& known, const Profile& profile) {
    const KnownRaster& raster = known.raster;
    return raster.point_grid && raster.point_edges && raster.triangle_grid && raster.triangle_sides &&
           profile.point_window_accurate != false && profile.corner_window_accurate != false;
}

std::optional<FirstDivergence> first_tie_beyond_rounding(int frame, const JudgedFrame& judged,
                                                         const FrameVerdicts& verdicts) {
    const auto found = std::find_if(verdicts.texels.begin(), verdicts.texels.end(), is_tie_beyond_rounding);
    if (found == verdicts.texels.end())
        return {};
    ItemVerdict convicted = *found;
    convicted.kind = DifferenceClass::divergent;
    convicted.tie = std::nullopt;
    return FirstDivergence{{frame, collision::cdt, found->index}, convicted, wrong_step_of_texel(judged, found->index)};
}

} // namespace lockstep
