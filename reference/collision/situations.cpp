#include "reference/collision/situations.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_twin.hpp"
#include "reference/collision/step_stage.hpp"
#include "reference/parallel_blocks.hpp"
#include "reference/plain_arithmetic.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

constexpr std::size_t place(Situation situation) { return static_cast<std::size_t>(situation); }

/// Marks the particles that lie in the image beyond any doubt, out of reach of its border: farther inside than rounding
/// can move them, in whatever order a driver sums.
void mark_well_inside(std::span<const glm::vec3> positions, const FrameParams& params, std::uint8_t* marks) {
    constexpr int widest = 1 << 14;
    // Four roundings of sums whose terms are 32 w together, 2^-17 w, are an eighth of a texel in the widest image.
    constexpr float most_cancelled = 32.0F;
    const bool is_known =
        params.switches.perspective_divide == PerspectiveDivide::on && std::max(params.width, params.height) <= widest;
    std::fill_n(marks, positions.size(), std::uint8_t{0});
    if (!is_known)
        return;
    const glm::mat4 m = params.collision_proj_view;
    const float half_width = 0.5F * static_cast<float>(params.width),
                half_height = 0.5F * static_cast<float>(params.height),
                margin = static_cast<float>(params.constants.texel_collide_range + 1);
    const std::size_t n = positions.size();
    const glm::vec3* const position = positions.data();
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) {
        const glm::vec3 p = position[i];
        std::array<float, 4> row{}, terms{};
        for (int r = 0; r < 4; ++r) {
            const float x = m[0][r] * p.x, y = m[1][r] * p.y, z = m[2][r] * p.z;
            row[r] = x + y + z + m[3][r];
            terms[r] = std::abs(x) + std::abs(y) + std::abs(z) + std::abs(m[3][r]);
        }
        const float w = row[3], left = half_width * (row[0] + w), below = half_height * (row[1] + w);
        const bool inside = (w > 0.0F) & (terms[0] + terms[1] + terms[3] < most_cancelled * w) & (left > margin * w) &
                            (left < (2.0F * half_width - margin) * w) & (below > margin * w) &
                            (below < (2.0F * half_height - margin) * w);
        marks[i] = inside ? 1 : 0;
    }
}

/// Looks at particles one by one.
template <class A> class Observer {
  public:
    Observer(A fp, const Particles& before, const CollisionImage& cdt, const FrameParams& params,
             const Particles& after)
        : fp_(fp), before_(before), cdt_(cdt), params_(params), after_(after), values_(fp), image_(values_, params),
          code_(params) {}

    /// Every `stride`th has its neighbours looked at even without a hit.
    void look(std::size_t first, std::size_t last, std::size_t stride, Situations& found) const {
        std::vector<std::uint8_t> well_inside(last - first);
        mark_well_inside(std::span(before_.position).subspan(first, last - first), params_, well_inside.data());
        for (std::size_t i = first; i < last; ++i)
            if (const bool closely = i % stride == 0; closely || well_inside[i - first] == 0 || is_hit(i))
                look(i, closely, found);
            else if (before_.collide_time[i] < 0.0F)
                note(Situation::search, i, found);
    }

  private:
    [[nodiscard]] bool is_hit(std::size_t i) const {
        return lockstep::is_hit(before_.collide_time[i], after_.collide_time[i], params_.constants.collision_time);
    }

    void look(std::size_t i, bool closely, Situations& found) const {
        const glm::vec3 position = before_.position[i];
        if (std::isnan(position.x) || std::isnan(position.y) || std::isnan(position.z))
            note(Situation::not_a_number, i, found);
        const auto clip = image_.clip({position.x, position.y, position.z});
        if (static_cast<float>(clip.w) <= 0.0F)
            note(Situation::behind_camera, i, found);
        const bool searches = before_.collide_time[i] < 0.0F, hit = is_hit(i);
        if (hit)
            note(Situation::hit, i, found);
        const auto p = image_.image_position(clip);
        const auto x = static_cast<float>(p.x), y = static_cast<float>(p.y);
        if (searches && (between(x) || between(y)))
            note(Situation::left_of_image, i, found);
        const auto base = image_.base_texel(p);
        if (!base)
            return;
        if (searches)
            note(Situation::search, i, found);
        const int reach = params_.constants.texel_collide_range;
        if (searches && (base->x < reach || base->y < reach || base->x + reach >= params_.width ||
                         base->y + reach >= params_.height))
            note(Situation::at_border, i, found);
        if (hit || closely)
            look_around(i, {base->x, base->y}, searches, hit, found);
    }

    static bool between(float x) { return x > -1.0F && x < 0.0F; }

    [[nodiscard]] bool holds_particle(const glm::vec4& texel) const {
        return params_.switches.empty_texel == EmptyTexel::phantom || texel.a != 0.0F;
    }

    void look_around(std::size_t i, const glm::ivec2& base, bool searches, bool hit, Situations& found) const {
        glm::vec3 own = before_.position[i];
        if (params_.switches.self_position == SelfPosition::texel) {
            const glm::vec4& texel = cdt_.at(base.x, base.y);
            if (!holds_particle(texel))
                return;
            own = code_.decode(texel);
        }
        const float range = params_.constants.collision_range;
        const bool zero_hits = params_.switches.zero_distance == ZeroDistance::hit;
        const int reach = params_.constants.texel_collide_range;
        int in_range = 0, nearest = 0, at_range = 0, at_zero = 0;
        float least = range;
        for (int y = std::max(base.y - reach, 0); y <= std::min(base.y + reach, params_.height - 1); ++y)
            for (int x = std::max(base.x - reach, 0); x <= std::min(base.x + reach, params_.width - 1); ++x) {
                const glm::vec4& texel = cdt_.at(x, y);
                if ((x == base.x && y == base.y) || !holds_particle(texel))
                    continue;
                const float distance = fp_.length(own - code_.decode(texel));
                at_range += distance == range ? 1 : 0;
                at_zero += distance == 0.0F ? 1 : 0;
                if (!(range > distance) || (!zero_hits && distance == 0.0F))
                    continue;
                ++in_range;
                nearest = distance < least ? 1 : nearest + (distance == least ? 1 : 0);
                least = std::min(least, distance);
            }
        if (hit && in_range > 1)
            note(Situation::two_in_range, i, found);
        if (hit && nearest > 1)
            note(Situation::equally_near, i, found);
        if (searches && at_range > 0)
            note(Situation::at_range, i, found);
        if (searches && at_zero > 0)
            note(Situation::at_no_distance, i, found);
        if (!searches && in_range > 0)
            note(before_.collide_time[i] > 0.0F ? Situation::waiting : Situation::timer_at_zero, i, found);
    }

    static void note(Situation situation, std::size_t i, Situations& found) {
        ++found.count[place(situation)];
        std::vector<std::size_t>& some = found.some[place(situation)];
        if (some.size() < Situations::kept)
            some.push_back(i);
    }

    A fp_;
    const Particles& before_;
    const CollisionImage& cdt_;
    const FrameParams& params_;
    const Particles& after_;
    Values<A> values_;
    BaseTexelTwin<Values<A>> image_;
    CollisionCode code_;
};

} // namespace

std::uint64_t count_hits(std::span<const float> before, std::span<const float> after, float collision_time) {
    const auto n = static_cast<std::ptrdiff_t>(after.size());
    const float *const time_before = before.data(), *const time_after = after.data();
    std::uint64_t hits = 0;
#pragma omp parallel for simd reduction(+ : hits) schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i)
        hits += is_hit(time_before[i], time_after[i], collision_time) ? 1U : 0U;
    return hits;
}

Situations situations_of(const Particles& before, const CollisionImage& cdt, const FrameParams& params,
                         const Profile& profile, const Particles& after, std::size_t looked_at) {
    constexpr std::size_t block = 4096;
    const std::size_t n = before.size(), stride = std::max<std::size_t>(1, n / std::max<std::size_t>(looked_at, 1));
    std::vector<Situations> parts((n + block - 1) / block);
    with_arithmetic(profile, params.switches.arithmetic, [&](auto fp) {
        parallel_blocks(static_cast<std::ptrdiff_t>(parts.size()), [&](std::ptrdiff_t b) {
            const FlushSubnormals guard = flush_in_step(params.switches, profile);
            const Observer observer(fp, before, cdt, params, after);
            const std::size_t first = static_cast<std::size_t>(b) * block;
            observer.look(first, std::min(first + block, n), stride, parts[static_cast<std::size_t>(b)]);
        });
    });
    Situations all;
    for (const Situations& part : parts)
        for (std::size_t s = 0; s < situation_count; ++s) {
            all.count[s] += part.count[s];
            all.some[s].insert(all.some[s].end(), part.some[s].begin(), part.some[s].end());
        }
    return all;
}

} // namespace lockstep
