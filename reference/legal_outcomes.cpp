#include "reference/legal_outcomes.hpp"

#include <algorithm>
#include <cmath>

#include "reference/collision_code.hpp"
#include "reference/subnormals.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

/// Where a coordinate, in texels, may fall among `size` texels.
struct TexelRange {
    int first = 0, last = -1; ///< empty: on no texel
    bool outside = false;
    double margin = 0.0; ///< to the nearest edge, 1/256 texel

    [[nodiscard]] bool one_answer() const { return outside ? last < first : first == last; }
};

TexelRange texels_of(Interval x, int size, BaseTexel rule) {
    const bool truncate = rule == BaseTexel::truncate;
    TexelRange range;
    if (std::isnan(x.low)) {
        range.outside = true;
        return range;
    }
    range.margin = std::min(std::abs(x.low - std::round(x.low)), std::abs(x.high - std::round(x.high))) * 256.0;
    range.outside = (truncate ? x.low <= -1.0 : x.low < 0.0) || x.high >= size;
    const bool inside = (truncate ? x.high > -1.0 : x.high >= 0.0) && x.low < size;
    if (inside) {
        range.first = static_cast<int>(std::max(x.low, 0.0));
        range.last = static_cast<int>(std::min(std::max(x.high, 0.0), size - 1.0));
    }
    return range;
}

/// A stored position round the base texel that may be within the collision range.
struct Neighbour {
    BaseTexelIndex texel;
    Interval3 apart;
    Interval distance;
    bool sure = false; ///< in range whatever the rounding
};

bool same(const Interval3& a, const Interval3& b) {
    for (std::size_t c = 0; c < 3; ++c)
        if (a[c].low != b[c].low || a[c].high != b[c].high || a[c].any != b[c].any)
            return false;
    return true;
}

double middle(Interval v) { return (v.low + v.high) * 0.5; }

bool any_of(const Interval3& v) { return v[0].any || v[1].any || v[2].any; }

/// The listing over sets of floats: as collision_pass.cpp reads, with every branch taken that may be.
template <class A> class LegalStep {
  public:
    LegalStep(A fp, const CollisionImage& cdt, const FrameParams& params, const KnownOperations& known,
              const OtherOrders& other_orders, const ParticleState* observed)
        : cdt_(cdt), params_(params), constants_(params.constants), switches_(params.switches), code_(params),
          arithmetic_(fp, known, other_orders), observed_(observed) {}

    std::vector<LegalOutcome> operator()(const ParticleState& before) {
        position_ = arithmetic_.read(before.position);
        direction_ = arithmetic_.read(before.direction);
        speed_ = arithmetic_.read(before.speed);
        collide_time_ = arithmetic_.read(before.collide_time);
        if (collide_time_.any)
            return {open(Undefined::not_a_number)};
        const bool may_search = collide_time_.low < 0.0;
        const bool must_search = collide_time_.high < 0.0;
        if (may_search) {
            if (!must_search)
                ties_.push_back({TieKind::search, std::abs(collide_time_.low)});
            search();
        }
        if (!must_search)
            add(integrate());
        return outcomes_;
    }

  private:
    /// Lines 2 to 4.
    void search() {
        const auto clip = arithmetic_.transform(params_.collision_proj_view, position_);
        const Interval x = on_image(clip[0], clip[3], params_.width);
        const Interval y = on_image(clip[1], clip[3], params_.height);
        if (x.any || y.any)
            return add(open(any_of(position_) ? Undefined::not_a_number : Undefined::unbounded));
        const TexelRange columns = texels_of(x, params_.width, switches_.base_texel);
        const TexelRange rows = texels_of(y, params_.height, switches_.base_texel);
        constexpr int most_texels = 4;
        if (columns.last - columns.first >= most_texels || rows.last - rows.first >= most_texels)
            return add(open(Undefined::unbounded));
        const std::size_t decided = ties_.size();
        if (!columns.one_answer() || !rows.one_answer()) {
            double margin = HUGE_VAL;
            if (!columns.one_answer())
                margin = columns.margin;
            if (!rows.one_answer())
                margin = std::min(margin, rows.margin);
            ties_.push_back({TieKind::base_texel, margin});
        }
        for (int row = rows.first; row <= rows.last; ++row)
            for (int column = columns.first; column <= columns.last; ++column)
                search_round({column, row});
        if (columns.outside || rows.outside)
            add(integrate());
        ties_.resize(decided);
    }

    [[nodiscard]] Interval on_image(Interval clip, Interval w, int size) const {
        const Interval ndc = switches_.perspective_divide == PerspectiveDivide::on ? arithmetic_.divide(clip, w) : clip;
        return arithmetic_.product(arithmetic_.product(arithmetic_.sum(ndc, 1.0F), 0.5F), static_cast<float>(size));
    }

    [[nodiscard]] bool holds_particle(glm::vec4 stored) const {
        return switches_.empty_texel == EmptyTexel::phantom || stored.a != 0.0F;
    }

    /// A stored position as the terms it is the sum of: one, or low + code * step.
    struct Decoded {
        Interval3 low, scaled;
        bool is_sum = false;
    };
    [[nodiscard]] Decoded decode(glm::vec4 stored) const {
        if (switches_.cdt_format != CdtFormat::rgba8 || arithmetic_.known().sums)
            return {arithmetic_.read(code_.decode(stored)), {}, false};
        const auto [low, scaled] = decoded_terms(arithmetic_, stored, params_);
        return {low, scaled, true};
    }

    [[nodiscard]] Interval3 apart(const Decoded& own, const Decoded& other) const {
        Interval3 v;
        for (std::size_t c = 0; c < 3; ++c)
            v[c] = !own.is_sum && !other.is_sum
                       ? arithmetic_.difference(own.low[c], other.low[c])
                       : arithmetic_.difference_of_sums({own.low[c], own.scaled[c]}, {other.low[c], other.scaled[c]});
        return v;
    }

    /// Lines 5 to 19.
    void search_round(BaseTexelIndex base) {
        Decoded own{position_, {}, false};
        if (switches_.self_position == SelfPosition::texel) {
            const glm::vec4 self = cdt_.at(base.x, base.y);
            if (!holds_particle(self))
                return add(integrate());
            own = decode(self);
        }
        std::vector<Neighbour> neighbours;
        const Interval range = Interval(std::min(constants_.collision_range, 100000.0F));
        double border = HUGE_VAL; // how near the undecided distance is to the range
        const int reach = constants_.texel_collide_range;
        for (int ty = -reach; ty <= reach; ++ty) {
            for (int tx = -reach; tx <= reach; ++tx) {
                const BaseTexelIndex texel{base.x + tx, base.y + ty};
                if ((tx == 0 && ty == 0) || !cdt_.contains(texel.x, texel.y))
                    continue;
                const glm::vec4 stored = cdt_.at(texel.x, texel.y);
                if (!holds_particle(stored))
                    continue;
                const Interval3 away = apart(own, decode(stored));
                const Interval distance = arithmetic_.length(away);
                if (distance.any) {
                    add(open(Undefined::not_a_number));
                    continue;
                }
                if (std::isnan(distance.low) || distance.low >= range.low)
                    continue;
                bool sure = distance.high < range.low;
                if (switches_.zero_distance == ZeroDistance::skip) {
                    if (distance.is_point() && distance.low == 0.0)
                        continue;
                    sure = sure && distance.low > 0.0;
                }
                if (!sure)
                    border = std::min(border, std::abs(range.low - middle(distance)));
                neighbours.push_back({texel, away, distance, sure});
            }
        }
        choose(base, neighbours, border);
    }

    /// `<` lets an earlier neighbour win over an equally near later one.
    void choose(BaseTexelIndex base, const std::vector<Neighbour>& neighbours, double border) {
        const std::size_t decided = ties_.size();
        if (border < HUGE_VAL)
            ties_.push_back({TieKind::collision_range, border});
        std::vector<const Neighbour*> nearest;
        bool sure = false;
        for (const Neighbour& candidate : neighbours) {
            sure = sure || candidate.sure;
            const bool beaten = std::any_of(neighbours.begin(), neighbours.end(), [&](const Neighbour& other) {
                if (&other == &candidate || !other.sure)
                    return false;
                return &other < &candidate ? other.distance.high <= candidate.distance.low
                                           : other.distance.high < candidate.distance.low;
            });
            if (!beaten)
                nearest.push_back(&candidate);
        }
        if (nearest.size() > 1) {
            double gap = HUGE_VAL;
            for (std::size_t i = 1; i < nearest.size(); ++i)
                gap = std::min(gap, std::abs(middle(nearest[i]->distance) - middle(nearest[0]->distance)));
            ties_.push_back({TieKind::nearest, gap});
        }
        for (const Neighbour* neighbour : nearest)
            add(collide(base, *neighbour));
        if (!sure)
            add(integrate());
        ties_.resize(decided);
    }

    /// Lines 21 to 24.
    [[nodiscard]] LegalOutcome collide(BaseTexelIndex base, const Neighbour& neighbour) const {
        LegalOutcome v;
        v.hit = true;
        v.base = base;
        v.neighbour = neighbour.texel;
        v.speed = arithmetic_.product(speed_, switches_.speed_factor);
        set_direction(v, neighbour.apart);
        v.collide_time = constants_.collision_time;
        const auto [direction, speed] = observed_motion(v);
        Interval3 step = arithmetic_.scale(direction, speed);
        if (switches_.collision_step == CollisionStep::tick)
            step = arithmetic_.scale(step, constants_.tick);
        v.position = arithmetic_.sum(position_, step);
        return v;
    }

    /// Lines 26 to 30.
    [[nodiscard]] LegalOutcome integrate() const {
        const Interval3 temp =
            arithmetic_.sum(arithmetic_.scale(direction_, speed_),
                            arithmetic_.scale(arithmetic_.read(constants_.gravity), constants_.tick));
        LegalOutcome v;
        set_direction(v, temp);
        v.speed = arithmetic_.length(temp);
        v.collide_time = arithmetic_.difference(collide_time_, constants_.tick);
        const auto [direction, speed] = observed_motion(v);
        v.position =
            arithmetic_.sum(position_, arithmetic_.scale(arithmetic_.scale(direction, speed), constants_.tick));
        return v;
    }

    void set_direction(LegalOutcome& outcome, const Interval3& v) const {
        outcome.direction = arithmetic_.normalize(v);
        if (any_of(outcome.direction))
            outcome.undefined = any_of(v) ? Undefined::not_a_number : Undefined::zero_direction;
    }

    struct Motion {
        Interval3 direction;
        Interval speed;
    };

    /// The direction and speed the position is computed from: the observed ones, if they are legal.
    [[nodiscard]] Motion observed_motion(const LegalOutcome& v) const {
        const auto lies_in = [](const Interval3& set, glm::vec3 value) {
            return set[0].contains(value.x) && set[1].contains(value.y) && set[2].contains(value.z);
        };
        if (observed_ == nullptr || !arithmetic_.known().sums || !lies_in(v.direction, observed_->direction) ||
            !v.speed.contains(observed_->speed))
            return {v.direction, v.speed};
        return {arithmetic_.read(observed_->direction), arithmetic_.read(observed_->speed)};
    }

    [[nodiscard]] LegalOutcome open(Undefined reason) const {
        LegalOutcome v;
        v.position = v.direction = {Interval::anything(), Interval::anything(), Interval::anything()};
        v.speed = v.collide_time = Interval::anything();
        v.undefined = reason;
        return v;
    }

    /// Adds an outcome with the ties on the way to it; one that is there already keeps the shorter way.
    void add(LegalOutcome outcome) {
        outcome.ties = ties_;
        for (LegalOutcome& known : outcomes_) {
            if (known.hit != outcome.hit || known.undefined != outcome.undefined ||
                !same(known.direction, outcome.direction) || !same(known.position, outcome.position))
                continue;
            if (outcome.ties.size() < known.ties.size())
                known = outcome;
            return;
        }
        outcomes_.push_back(std::move(outcome));
    }

    const CollisionImage& cdt_;
    const FrameParams& params_;
    const Constants& constants_;
    const Switches& switches_;
    CollisionCode code_;
    LegalArithmetic<A> arithmetic_;
    const ParticleState* observed_;
    Interval3 position_, direction_;
    Interval speed_, collide_time_;
    std::vector<Tie> ties_; ///< on the way taken so far
    std::vector<LegalOutcome> outcomes_;
};

} // namespace

std::string_view tie_name(TieKind kind) {
    switch (kind) {
    case TieKind::search:
        return "search";
    case TieKind::base_texel:
        return "base texel";
    case TieKind::collision_range:
        return "collision range";
    case TieKind::nearest:
        return "nearest";
    case TieKind::point_edge:
        return "point edge";
    case TieKind::depth:
        return "depth";
    }
    return "";
}

std::string_view tie_unit(TieKind kind) {
    switch (kind) {
    case TieKind::search:
        return "s";
    case TieKind::base_texel:
        return "/256 texel";
    case TieKind::collision_range:
    case TieKind::nearest:
        return "world units";
    case TieKind::point_edge:
        return "/256 pixel";
    case TieKind::depth:
        return "of depth";
    }
    return "";
}

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
    const FlushSubnormals guard(known.subnormals && profile.flush_subnormals);
    return with_arithmetic(profile, params.switches, [&](auto fp) {
        return LegalStep(fp, cdt, params, known, profile.other_orders, observed)(before);
    });
}

} // namespace lockstep
