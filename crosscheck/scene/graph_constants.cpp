#include "crosscheck/scene/graph_constants.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "reference/portable.hpp"
#include "reference/readings/worlds.hpp"

namespace lockstep {
namespace {

using Made = GraphConstants::Made;

/// An operation whose operands are constant, and for which GLSL has no result.
struct UndefinedOperation {
    const char* what;
};

bool is_zero(const Interval& set) { return !set.any && set.low == 0.0 && set.high == 0.0; }

/// The reading of sets that stops at what GLSL leaves undefined wherever a node comes to it.
class Folding : public Worlds<Portable> {
    using Sets = Worlds<Portable>;

  public:
    /// Sets of operands are cut to +-reach.
    explicit Folding(double reach) : Sets(Portable{}, KnownOperations::all()), reach_(reach) {}

    Real divide(At place, Real a, Real b) {
        if (is_zero(b.set()))
            throw UndefinedOperation{"divides by 0"};
        return Sets::divide(place, a, b);
    }
    Real sqrt(At place, Real a) {
        if (!a.set().any && a.set().high < 0.0)
            throw UndefinedOperation{"takes the square root of a number below 0"};
        return Sets::sqrt(place, a);
    }
    Vec3 normalize(At place, const Vec3& v) {
        if (is_zero(v.x.set()) && is_zero(v.y.set()) && is_zero(v.z.set()))
            throw UndefinedOperation{"normalizes a vector of length 0"};
        return Sets::normalize(place, v);
    }
    /// Of a set that is no point a run ends here: as many ways as integers would lead nowhere.
    int to_int(At place, Real x) { return Sets::to_int(place, x.set().is_point() ? x : within(place, reach())); }

    Real within(At place, const Interval& set) {
        if (set.is_point())
            return uniform(place, set.as_float());
        const Interval cut =
            set.any ? Interval(-reach_, reach_) : Interval(std::max(set.low, -reach_), std::min(set.high, reach_));
        const Interval known = cut.low < cut.high ? cut : set;
        return unspecified(place, Real(0.0F), static_cast<float>(known.low), static_cast<float>(known.high));
    }
    /// Either, in a run each.
    bool truth(At place, const Made& made) {
        if (made.may_be_false != made.may_be_true)
            return made.may_be_true;
        return decide(place, within(place, {0.0, 1.0}) < Real(0.5F));
    }

    /// Any float that an input is.
    static Interval reach() {
        constexpr double most = std::numeric_limits<float>::max();
        return {-most, most};
    }

  private:
    double reach_;
};

/// What a run of a node ends with.
struct NodeState {
    GraphNumber<Folding> number;
    [[nodiscard]] auto fields() const { return std::tie(number.x[0], number.x[1], number.x[2], number.x[3]); }
};

void join(Made& all, const Made& one, bool is_first) {
    for (std::size_t c = 0; c < all.x.size(); ++c)
        all.x[c] = is_first ? one.x[c] : interval::hull(all.x[c], one.x[c]);
    all.may_be_false = all.may_be_false || one.may_be_false;
    all.may_be_true = all.may_be_true || one.may_be_true;
}

Made made_of(const NodeState* state) {
    Made made{.x = {}, .may_be_false = true, .may_be_true = true};
    if (state == nullptr) {
        made.x.fill(Interval::anything());
        return made;
    }
    for (std::size_t c = 0; c < made.x.size(); ++c)
        made.x[c] = state->number.x[c].set();
    made.may_be_true = state->number.whole != 0;
    made.may_be_false = !made.may_be_true;
    return made;
}

} // namespace

std::string GraphConstants::add(std::size_t node) {
    const GraphNode& of = graph_.nodes[node];
    Made& all = made_[node];
    if (of.kind == GraphKind::input || of.kind == GraphKind::parameter || of.kind == GraphKind::random) {
        all.x.fill(Folding::reach());
        all.may_be_false = all.may_be_true = true;
        return "";
    }
    const Site& site = sites_.of(node);
    bool is_first = true;
    // Where operands of any size overflow, a run ends before it comes to what is undefined of others.
    for (const double reach : {HUGE_VAL, 0x1p60}) {
        Folding reading(reach);
        const auto given = [&](std::size_t from) {
            GraphNumber<Folding> number;
            for (std::size_t c = 0; c < graph_components(graph_.nodes[from].makes); ++c)
                number.x[c] = reading.within(site, made_[from].x[c]);
            if (graph_components(graph_.nodes[from].makes) == 0)
                number.whole = reading.truth(site, made_[from]) ? 1 : 0;
            return number;
        };
        try {
            reading.run(
                [&] { return NodeState{GraphRun<Folding>(reading, graph_, sites_, {}).evaluated(node, given)}; },
                [&](const NodeState* state, std::span<const Fork>, Undefined) {
                    if (reach == HUGE_VAL)
                        join(all, made_of(state), std::exchange(is_first, false));
                });
        } catch (const UndefinedOperation& undefined) {
            return undefined.what;
        }
    }
    return "";
}

Interval GraphConstants::at(const GraphSource& source, std::size_t component) const {
    if (!source.node)
        return Interval(source.numbers[component]);
    const bool is_one = source.part < 0 && graph_.nodes[*source.node].makes == GraphType::real;
    return made_[*source.node].x[is_one ? 0 : source.part < 0 ? component : static_cast<std::size_t>(source.part)];
}

} // namespace lockstep
