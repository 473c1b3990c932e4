#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "reference/collision/collision_code.hpp"
#include "reference/collision/collision_pass.hpp"
#include "reference/collision/layered_search.hpp"
#include "reference/collision/search_counting.hpp"
#include "reference/collision/search_study.hpp"
#include "reference/subnormals.hpp"
#include "reference/with_arithmetic.hpp"

namespace lockstep {
namespace {

struct LayeredInputs {
    const Particles& particles;
    const CollisionImage& cdt;
    const LayeredOwners& owners;
    const TrueNeighbours& truth;
    const FrameParams& params;
    const Profile& profile;
};

/// The questions of search_counting.hpp. `A`: the arithmetic (arithmetic.hpp).
template <class A> class LayeredQuestions {
  public:
    LayeredQuestions(A fp, const LayeredInputs& in)
        : fp_(fp), in_(in), planes_(cdt_planes(in.params.switches)), code_(in.params), search_(fp, in.cdt, in.params),
          drawn_now_(draw_layered_owners(in.particles, in.params, in.profile).drawn), hit_(in.particles.size()) {
        const auto count = static_cast<std::ptrdiff_t>(hit_.size());
#pragma omp parallel
        {
            const FlushSubnormals guard(in.profile.flush_subnormals);
#pragma omp for schedule(dynamic, 1024)
            for (std::ptrdiff_t i = 0; i < count; ++i)
                hit_[static_cast<std::size_t>(i)] =
                    search_.nearest(fp_.flush(in.particles.position[static_cast<std::size_t>(i)]));
        }
    }

    [[nodiscard]] bool inside(std::size_t i) const {
        for (int camera = 0; camera < planes_.cameras; ++camera)
            if (inside(i, camera))
                return true;
        return false;
    }
    [[nodiscard]] bool searches(std::size_t i) const { return in_.particles.collide_time[i] < 0.0F; }
    [[nodiscard]] static bool base_owned_by(std::size_t, std::int32_t) { return false; }

    [[nodiscard]] std::int32_t partner(std::size_t i) const {
        return searches(i) && hit_[i] ? owner(hit_[i]->at) : no_neighbour;
    }

    [[nodiscard]] std::optional<Miss> miss(std::size_t i, std::int32_t neighbour) const {
        const auto j = static_cast<std::size_t>(neighbour);
        const std::optional<Miss> first = miss(i, j, 0);
        for (int camera = 1; camera < planes_.cameras && first; ++camera)
            if (!miss(i, j, camera))
                return {};
        return first;
    }

    [[nodiscard]] Hit hit(std::size_t i) const {
        if (!searches(i) || !hit_[i])
            return Hit::none;
        if (hit_[i]->at.layer < 0)
            return Hit::obstacle;
        const std::int32_t found = owner(hit_[i]->at);
        if (found == static_cast<std::int32_t>(i))
            return Hit::wrong_self;
        const auto j = static_cast<std::size_t>(found);
        const float range = in_.params.constants.collision_range;
        const double squared = squared_distance(in_.particles.position[i], in_.particles.position[j]);
        if (squared < double{range} * double{range})
            return squared == in_.truth.nearest.particle[i].squared_distance ? Hit::nearest : Hit::neighbour;
        return left(hit_[i]->at, j) ? Hit::stale : Hit::rounded;
    }

  private:
    [[nodiscard]] std::int32_t drawn(std::size_t i, int camera) const {
        return in_.owners.drawn[static_cast<std::size_t>(camera) * hit_.size() + i];
    }
    [[nodiscard]] std::int32_t drawn_now(std::size_t i, int camera) const {
        return drawn_now_[static_cast<std::size_t>(camera) * hit_.size() + i];
    }
    [[nodiscard]] bool inside(std::size_t i, int camera) const { return drawn_now(i, camera) != no_texel; }
    [[nodiscard]] std::int32_t owner(StoredAt at) const { return in_.owners.owner.texels[search_.index(at)]; }

    /// Where particle j is stored for a camera.
    [[nodiscard]] std::optional<StoredAt> stored_at(std::size_t j, int camera) const {
        const std::int32_t texel = drawn(j, camera);
        for (int layer = 0; layer < planes_.layers && texel != no_texel; ++layer) {
            const StoredAt at{camera, layer, texel % in_.params.width, texel / in_.params.width};
            if (owner(at) == static_cast<std::int32_t>(j))
                return at;
        }
        return {};
    }

    /// Whether what is stored there is another position than particle j's.
    [[nodiscard]] bool left(StoredAt at, std::size_t j) const {
        return in_.cdt.texels[search_.index(at)] != code_.encode(fp_.flush(in_.particles.position[j]));
    }

    [[nodiscard]] std::optional<Miss> miss(std::size_t i, std::size_t j, int camera) const {
        const bool mutual = in_.params.switches.response == Response::mutual;
        if (!inside(i, camera) || (drawn(j, camera) == no_texel && !inside(j, camera)))
            return Miss::outside_image;
        const std::optional<StoredAt> at = stored_at(j, camera);
        if ((!at && drawn(j, camera) != no_texel) || (mutual && !stored_at(i, camera)))
            return Miss::occluded;
        const glm::vec3 position = fp_.flush(in_.particles.position[i]);
        const auto [columns, rows] = search_.window(position, camera);
        const auto in_window = [&, &columns = columns, &rows = rows](std::int32_t texel) {
            return texel != no_texel && columns.contains(texel % in_.params.width) &&
                   rows.contains(texel / in_.params.width);
        };
        if (!at || !in_window(drawn(j, camera)))
            return in_window(drawn_now(j, camera)) ? Miss::stale : Miss::outside_window;
        const glm::vec3 self = search_.as_stored(position);
        const glm::vec3 stored = fp_.flush(code_.decode(in_.cdt.texels[search_.index(*at)]));
        const float distance = fp_.length(fp_.flush((mutual ? self : position) - stored));
        const bool skipped = stored == self || distance == 0.0F;
        if (skipped || !(distance < in_.params.constants.collision_range)) {
            if (left(*at, j))
                return Miss::stale;
            return skipped ? Miss::coincident : Miss::rounded;
        }
        if (!searches(i) || (mutual && !searches(j)))
            return Miss::cooling_down;
        return {};
    }

    A fp_;
    const LayeredInputs& in_;
    CdtPlanes planes_;
    CollisionCode code_;
    LayeredSearch<A> search_;
    std::vector<std::int32_t> drawn_now_;                                ///< texels by this frame's cameras
    std::vector<std::optional<typename LayeredSearch<A>::Nearest>> hit_; ///< where each would end if it searched
};

} // namespace

SearchStudy study_layered_search(const Particles& particles, const CollisionImage& cdt, const LayeredOwners& owners,
                                 const TrueNeighbours& truth, const FrameParams& params, const Profile& profile) {
    const LayeredInputs in{particles, cdt, owners, truth, params, profile};
    SearchStudy result = with_arithmetic(profile, params.switches.arithmetic, [&](auto fp) {
        return count_search(LayeredQuestions(fp, in), particles.size(), truth, params, profile);
    });
    std::vector<bool> owns(particles.size());
    for (const std::int32_t owner : owners.owner.texels)
        if (owner >= 0)
            owns[static_cast<std::size_t>(owner)] = true;
    for (const bool one : owns)
        result.counts.owners += one ? 1U : 0U;
    return result;
}

} // namespace lockstep
