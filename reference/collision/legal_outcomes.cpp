#include "reference/collision/legal_outcomes.hpp"

#include <algorithm>
#include <span>

#include "reference/collision/collision_twin.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/plain_arithmetic.hpp"
#include "reference/readings/worlds.hpp"

namespace lockstep {
namespace {

template <class Vector> Interval3 sets(const Vector& v) { return {v.x.legal(), v.y.legal(), v.z.legal()}; }

bool same(const Interval& a, const Interval& b) { return a.low == b.low && a.high == b.high && a.any == b.any; }
bool same(const Interval3& a, const Interval3& b) { return same(a[0], b[0]) && same(a[1], b[1]) && same(a[2], b[2]); }

LegalOutcome open_outcome() {
    LegalOutcome v;
    v.position = v.direction = {Interval::anything(), Interval::anything(), Interval::anything()};
    v.speed = v.collide_time = Interval::anything();
    return v;
}

template <class State> LegalOutcome as_outcome(const State& state) {
    LegalOutcome v;
    v.position = sets(state.position);
    v.direction = sets(state.direction);
    v.speed = state.speed.legal();
    v.collide_time = state.collide_time.legal();
    if (state.hit) {
        v.hit = true;
        v.base = {state.hit->base.x, state.hit->base.y};
        v.neighbour = {state.hit->texel.x, state.hit->texel.y};
    }
    return v;
}

/// One tie for all decisions of a kind.
std::vector<Tie> ties(std::span<const Fork> forks) {
    std::vector<Tie> found;
    for (const Fork& fork : forks)
        for (const OpenDecision& decision : fork.decisions) {
            if (decision.site == nullptr)
                continue;
            const TieKind kind{decision.site->label, decision.site->unit};
            if (!found.empty() && found.back().kind == kind)
                found.back().margin = std::min(found.back().margin, decision.margin);
            else
                found.push_back({kind, decision.margin});
        }
    return found;
}

/// One that is there already keeps the shorter way.
void add(std::vector<LegalOutcome>& outcomes, LegalOutcome outcome) {
    for (LegalOutcome& known : outcomes) {
        if (known.hit != outcome.hit || known.undefined != outcome.undefined ||
            !same(known.direction, outcome.direction) || !same(known.position, outcome.position))
            continue;
        if (outcome.ties.size() < known.ties.size())
            known = outcome;
        return;
    }
    outcomes.push_back(std::move(outcome));
}

} // namespace

std::string_view undefined_name(Undefined reason) {
    switch (reason) {
    case Undefined::none:
        return "";
    case Undefined::zero_direction:
        return "normalize of a vector of length 0";
    case Undefined::not_a_number:
        return "NaN or overflow";
    case Undefined::unbounded:
        return "division by a w that may be 0";
    case Undefined::undecided:
        return "more ways than are followed";
    }
    return "";
}

bool LegalOutcome::contains(const ParticleState& s) const {
    return position[0].contains(s.position.x) && position[1].contains(s.position.y) &&
           position[2].contains(s.position.z) && direction[0].contains(s.direction.x) &&
           direction[1].contains(s.direction.y) && direction[2].contains(s.direction.z) && speed.contains(s.speed) &&
           collide_time.contains(s.collide_time);
}

std::vector<LegalOutcome> legal_outcomes(const ParticleState& before, const CollisionImage& cdt,
                                         const FrameParams& params, const Profile& profile,
                                         const KnownOperations& known, const ParticleState* observed) {
    const KnownOperations of_stage = known_in_step(params.switches, known, profile);
    const FlushSubnormals guard = flush_in_step(params.switches, profile, of_stage.subnormals);
    std::vector<LegalOutcome> outcomes;
    with_plain_arithmetic(profile, params.switches.arithmetic, [&]<class A>(A fp) {
        Worlds<A> worlds(fp, of_stage, profile.other_orders);
        if (profile.roots != nullptr)
            worlds.take_roots_by_tables();
        if (observed != nullptr) {
            worlds.tell(site::direction.output, {&observed->direction.x, 3});
            worlds.tell(site::speed.output, {&observed->speed, 1});
        }
        const CollisionTwin twin(worlds, cdt, params);
        worlds.run([&] { return twin(before); },
                   [&](const auto* state, std::span<const Fork> forks, Undefined undefined) {
                       LegalOutcome outcome = state != nullptr ? as_outcome(*state) : open_outcome();
                       outcome.undefined = undefined;
                       outcome.ties = ties(forks);
                       add(outcomes, std::move(outcome));
                   });
    });
    return outcomes;
}

} // namespace lockstep
