#include "reference/collision/search_study.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/search_counting.hpp"
#include "reference/model/error.hpp"
#include "reference/subnormals.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

double ratio(std::size_t part, std::size_t whole) {
    return whole == 0 ? std::numeric_limits<double>::quiet_NaN()
                      : static_cast<double>(part) / static_cast<double>(whole);
}

template <std::size_t N> void add(std::array<std::size_t, N>& to, const std::array<std::size_t, N>& from) {
    std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus<>());
}

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

struct StudyInputs {
    const Particles& particles;
    const CollisionImage& cdt;
    const Owners& owners;
    const TrueNeighbours& truth;
    const FrameParams& params;
    const Profile& profile;
};

/// The questions of search_counting.hpp, to a CDT of one plane. `A`: the arithmetic (arithmetic.hpp).
template <class A> class CdtQuestions {
  public:
    CdtQuestions(A fp, const StudyInputs& in)
        : fp_(fp), in_(in), code_(in.params),
          hit_(collision_texels(in.particles.position, in.cdt, in.params, in.profile)),
          drawn_now_(drawn_texels(in.particles.position, in.params, in.profile)), base_(in.particles.size()) {
        const auto count = static_cast<std::ptrdiff_t>(base_.size());
#pragma omp parallel for schedule(static)
        for (std::ptrdiff_t i = 0; i < count; ++i)
            base_[static_cast<std::size_t>(i)] =
                base_texel(in.particles.position[static_cast<std::size_t>(i)], in.params, in.profile);
    }

    [[nodiscard]] bool inside(std::size_t i) const { return base_[i].x >= 0; }
    [[nodiscard]] bool searches(std::size_t i) const { return in_.particles.collide_time[i] < 0.0F; }

    /// Where the search of particle i ends; no_texel too while it does not search.
    [[nodiscard]] std::int32_t hit_texel(std::size_t i) const { return searches(i) ? hit_[i] : no_texel; }

    /// The particle found, no_neighbour where none was.
    [[nodiscard]] std::int32_t partner(std::size_t i) const {
        const std::int32_t texel = hit_texel(i);
        return texel == no_texel ? no_neighbour : std::max(owner(texel), no_neighbour);
    }

    /// Whether another owns the texel particle i searches round, and it is `neighbour`.
    [[nodiscard]] bool base_owned_by(std::size_t i, std::int32_t neighbour) const {
        return inside(i) && owner(base(i)) == neighbour;
    }

    /// Why pair (i, neighbour) is missed, if it is.
    [[nodiscard]] std::optional<Miss> miss(std::size_t i, std::int32_t neighbour) const {
        const std::size_t j = index(neighbour);
        const std::int32_t drawn = in_.owners.drawn[j];
        if (!inside(i) || (drawn == no_texel && drawn_now_[j] == no_texel))
            return Miss::outside_image;
        if (owner(base(i)) == neighbour || measures_elsewhere(i, j))
            return Miss::own_texel;
        if (drawn != no_texel && owner(drawn) != neighbour)
            return owner(drawn) == obstacle_owner ? Miss::hidden : Miss::occluded;
        if (!in_window(i, drawn))
            return in_window(i, drawn_now_[j]) ? Miss::stale : Miss::outside_window;
        const float distance = fp_.length(from(own_position(i), drawn));
        const bool skipped = distance == 0.0F && in_.params.switches.zero_distance == ZeroDistance::skip;
        if (skipped || !(distance < in_.params.constants.collision_range)) {
            if (left(drawn, j))
                return Miss::stale;
            return skipped ? Miss::coincident : Miss::rounded;
        }
        if (!searches(i))
            return Miss::cooling_down;
        return {};
    }

    [[nodiscard]] Hit hit(std::size_t i) const {
        const std::int32_t texel = hit_texel(i);
        if (texel == no_texel)
            return Hit::none;
        const std::int32_t found = owner(texel);
        const float range = in_.params.constants.collision_range;
        const double limit = double{range} * double{range};
        const glm::vec3 position = in_.particles.position[i];
        if (in_.cdt.texels[index(texel)].a == 0.0F || found == empty_owner)
            return Hit::phantom_origin;
        if (found == static_cast<std::int32_t>(i))
            return Hit::wrong_self;
        const bool displaced =
            in_.params.switches.self_position == SelfPosition::texel && !base_owned_by(i, static_cast<std::int32_t>(i));
        if (found == obstacle_owner)
            return displaced && !(squared_distance(position, stored(texel)) < limit) ? Hit::wrong_self : Hit::obstacle;
        const double squared = squared_distance(position, in_.particles.position[index(found)]);
        if (squared < limit)
            return squared == in_.truth.nearest.particle[i].squared_distance ? Hit::nearest : Hit::neighbour;
        if (displaced)
            return Hit::wrong_self;
        return left(texel, index(found)) ? Hit::stale : Hit::rounded;
    }

  private:
    [[nodiscard]] std::int32_t owner(std::int32_t texel) const { return in_.owners.owner.texels[index(texel)]; }
    [[nodiscard]] std::int32_t base(std::size_t i) const { return base_[i].y * in_.params.width + base_[i].x; }
    [[nodiscard]] glm::vec3 stored(std::int32_t texel) const {
        return fp_.flush(code_.decode(in_.cdt.texels[index(texel)]));
    }
    [[nodiscard]] glm::vec3 from(glm::vec3 position, std::int32_t texel) const {
        return fp_.flush(position - stored(texel));
    }

    /// Where particle i's search measures from.
    [[nodiscard]] glm::vec3 own_position(std::size_t i) const {
        return in_.params.switches.self_position == SelfPosition::vertex ? fp_.flush(in_.particles.position[i])
                                                                         : stored(base(i));
    }

    /// Whether particle i takes a position for its own that is not, and from which j is out of range.
    [[nodiscard]] bool measures_elsewhere(std::size_t i, std::size_t j) const {
        if (in_.params.switches.self_position == SelfPosition::vertex || base_owned_by(i, static_cast<std::int32_t>(i)))
            return false;
        const bool empty = in_.cdt.texels[index(base(i))].a == 0.0F;
        if (empty && in_.params.switches.empty_texel == EmptyTexel::skip)
            return true;
        const float range = in_.params.constants.collision_range;
        return !(squared_distance(own_position(i), in_.particles.position[j]) < double{range} * double{range});
    }

    [[nodiscard]] bool in_window(std::size_t i, std::int32_t texel) const {
        if (texel == no_texel || texel == base(i))
            return false;
        const int x = texel % in_.params.width;
        const int y = texel / in_.params.width;
        const int range = in_.params.constants.texel_collide_range;
        return std::abs(x - base_[i].x) <= range && std::abs(y - base_[i].y) <= range;
    }

    /// Whether what `texel` stores is another position than particle j's.
    [[nodiscard]] bool left(std::int32_t texel, std::size_t j) const {
        return in_.cdt.texels[index(texel)] != code_.encode(in_.particles.position[j]);
    }

    A fp_;
    const StudyInputs& in_;
    CollisionCode code_;
    std::vector<std::int32_t> hit_;       ///< where each would end if it searched
    std::vector<std::int32_t> drawn_now_; ///< where each would be drawn by this frame's camera
    std::vector<BaseTexelIndex> base_;
};

glm::dvec3 momentum(const Particles& p, std::size_t i) {
    return glm::dvec3(p.direction[i]) * static_cast<double>(p.speed[i]);
}

bool finite(const Particles& p, std::size_t i) {
    const glm::dvec3 sum = glm::dvec3(p.position[i]) + momentum(p, i);
    return std::isfinite(sum.x + sum.y + sum.z);
}

} // namespace

SearchCounts& SearchCounts::operator+=(const SearchCounts& other) {
    particles += other.particles;
    ignored += other.ignored;
    owners += other.owners;
    with_neighbour += other.with_neighbour;
    with_neighbour_inside += other.with_neighbour_inside;
    with_neighbour_search += other.with_neighbour_search;
    recalled += other.recalled;
    recalled_with_base += other.recalled_with_base;
    depth += other.depth;
    add(missed_particles, other.missed_particles);
    pairs += other.pairs;
    found_pairs += other.found_pairs;
    add(missed_pairs, other.missed_pairs);
    add(hits, other.hits);
    non_mutual += other.non_mutual;
    return *this;
}

std::size_t SearchCounts::true_hits() const { return hits[place_of(Hit::nearest)] + hits[place_of(Hit::neighbour)]; }
std::size_t SearchCounts::false_hits() const {
    return std::accumulate(hits.begin() + place_of(Hit::phantom_origin), hits.end(), std::size_t{0});
}
double SearchCounts::recall() const { return ratio(recalled, with_neighbour); }
double SearchCounts::recall_with_base() const { return ratio(recalled_with_base, with_neighbour); }
double SearchCounts::recall_inside() const { return ratio(recalled, with_neighbour_inside); }
double SearchCounts::recall_searching() const { return ratio(recalled, with_neighbour_search); }
double SearchCounts::true_nearest() const { return ratio(hits[place_of(Hit::nearest)], with_neighbour); }
double SearchCounts::precision() const { return ratio(true_hits(), true_hits() + false_hits()); }
double SearchCounts::non_mutual_rate() const { return ratio(non_mutual, true_hits()); }
double SearchCounts::mean_depth() const {
    return with_neighbour == 0 ? std::numeric_limits<double>::quiet_NaN() : depth / static_cast<double>(with_neighbour);
}

TrueNeighbours find_truth(std::span<const glm::vec3> positions, float range) {
    TrueNeighbours truth{find_neighbourhoods(positions, range), {}};
    std::size_t listed = 0;
    for (const Neighbourhood& neighbourhood : truth.nearest.particle)
        listed += neighbourhood.count;
    if (listed > most_listed_neighbours)
        throw Error(fmt::format("{} particles have {} neighbours within {}; at most {} are listed: a smaller "
                                "collision_range or fewer particles have fewer",
                                positions.size(), listed, range, most_listed_neighbours));
    truth.lists = list_neighbours(positions, range);
    return truth;
}

SearchStudy study_search(const Particles& particles, const CollisionImage& cdt, const Owners& owners,
                         const TrueNeighbours& truth, const FrameParams& params, const Profile& profile) {
    assert(owners.drawn.size() == particles.size() && truth.nearest.particle.size() == particles.size());
    assert(cdt.width == params.width && cdt.height == params.height);
    const StudyInputs in{particles, cdt, owners, truth, params, profile};
    SearchStudy result = with_arithmetic(profile, params.switches.arithmetic, [&](auto fp) {
        return count_search(CdtQuestions(fp, in), particles.size(), truth, params, profile);
    });
    SearchCounts& n = result.counts;
    n.owners = static_cast<std::size_t>(std::count_if(owners.owner.texels.begin(), owners.owner.texels.end(),
                                                      [](std::int32_t owner) { return owner >= 0; }));
    return result;
}

Drift drift(const Particles& before, const Particles& after, const Constants& constants) {
    assert(before.size() == after.size());
    const glm::dvec3 gravity(constants.gravity);
    double kinetic = 0.0, gained = 0.0, moved = 0.0;
    glm::dvec3 change(0.0);
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (!finite(before, i) || !finite(after, i))
            continue;
        const glm::dvec3 u = momentum(before, i);
        const glm::dvec3 v = momentum(after, i);
        const glm::dvec3 path = glm::dvec3(after.position[i]) - glm::dvec3(before.position[i]);
        kinetic += 0.5 * glm::dot(u, u);
        gained += 0.5 * (glm::dot(v, v) - glm::dot(u, u)) - glm::dot(gravity, path);
        moved += glm::length(u);
        change += v - u - gravity * static_cast<double>(constants.tick);
    }
    return {gained / kinetic, glm::length(change) / moved};
}

} // namespace lockstep
