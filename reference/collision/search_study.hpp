#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "reference/collision/layered_collision_pass.hpp"
#include "reference/collision/neighbours.hpp"
#include "reference/collision/owners.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/collision/scene.hpp"
#include "reference/model/image.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// What the search through the CDT finds, against the truth (neighbours.hpp). A pair (i, j) is two exact neighbours as
/// seen from i; the search sees it when j's stored position lies in i's window, within the collision range.

/// Why a pair is missed. In this order: a pair counts under the first that applies, and each misses it by itself.
enum class Miss {
    outside_image,  ///< one of the two has no texel
    own_texel,      ///< the texel i searches round is not its own: the search skips it, and j with it, or
                    ///< (self_position texel) measures from the position stored there, which is out of j's range
    occluded,       ///< j's texel is another particle's
    hidden,         ///< j's texel is an obstacle's
    outside_window, ///< j's texel is farther than texel_collide_range
    stale,          ///< j's texel, or the position in it, is one that j, or the camera, has left since
    coincident,     ///< j lies where i lies, and zero_distance skips it
    rounded,        ///< the stored code, or the float distance, is out of range by a rounding
    cooling_down,   ///< i sees j, but its collide time is not negative
};
inline constexpr std::array<std::string_view, 9> miss_names{"outside_image", "own_texel",      "occluded",
                                                            "hidden",        "outside_window", "stale",
                                                            "coincident",    "rounded",        "cooling_down"};

/// What a search ends at. After `obstacle` come the false hits, again by the first that applies.
enum class Hit {
    none,           ///< nothing, or no search
    nearest,        ///< the nearest exact neighbour, or one as near
    neighbour,      ///< another exact neighbour
    obstacle,       ///< a point of an obstacle
    phantom_origin, ///< an empty texel, read as a position
    wrong_self,     ///< itself, or what another than itself is near to
    stale,          ///< a position its owner has left
    rounded,        ///< a particle in range by a rounding only
};
inline constexpr std::array<std::string_view, 8> hit_names{"none",           "nearest",    "neighbour", "obstacle",
                                                           "phantom_origin", "wrong_self", "stale",     "rounded"};

/// Sums over particles; frames can be added up.
struct SearchCounts {
    std::size_t particles = 0;
    std::size_t ignored = 0;               ///< with a position that is not finite; they count nowhere below
    std::size_t owners = 0;                ///< that own a texel
    std::size_t with_neighbour = 0;        ///< that have an exact neighbour
    std::size_t with_neighbour_inside = 0; ///< of these: with a base texel inside the image
    std::size_t with_neighbour_search = 0; ///< of these: with a negative collide time
    std::size_t recalled = 0;              ///< that see and search: at least one of their neighbours can be found
    std::size_t recalled_with_base = 0;    ///< the same if the base texel were not skipped
    double depth = 0.0;                    ///< world units: range minus distance to the nearest, summed
    std::array<std::size_t, miss_names.size()> missed_particles{}; ///< not recalled, by their nearest's cause
    std::size_t pairs = 0;
    std::size_t found_pairs = 0;
    std::array<std::size_t, miss_names.size()> missed_pairs{};
    std::array<std::size_t, hit_names.size()> hits{};
    std::size_t non_mutual = 0; ///< hits on a neighbour whose own hit is another, or none

    SearchCounts& operator+=(const SearchCounts& other);

    [[nodiscard]] std::size_t true_hits() const;   ///< nearest and neighbour
    [[nodiscard]] std::size_t false_hits() const;  ///< phantom_origin and after
    [[nodiscard]] double recall() const;           ///< of the particles with a neighbour; NaN where there are none,
    [[nodiscard]] double recall_with_base() const; ///< as all of these
    [[nodiscard]] double recall_inside() const;    ///< of those inside the image
    [[nodiscard]] double recall_searching() const; ///< of those that search
    [[nodiscard]] double true_nearest() const;     ///< of the particles with a neighbour
    [[nodiscard]] double precision() const;        ///< of the hits that are not an obstacle's
    [[nodiscard]] double non_mutual_rate() const;  ///< of the true hits
    [[nodiscard]] double mean_depth() const;       ///< world units
};

/// What became of one particle's search.
struct Finding {
    enum class Kind : std::uint8_t { alone, recalled, missed };
    Kind kind = Kind::alone;
    Miss miss = Miss::outside_image; ///< where missed
    Hit hit = Hit::none;
};

struct SearchStudy {
    SearchCounts counts;
    std::vector<Finding> findings; ///< of each particle
};

/// The truth of a state, for several studies of it.
struct TrueNeighbours {
    Neighbourhoods nearest;
    NeighbourLists lists;
};

/// Throws Error where there are more neighbours to list, counted at both ends.
inline constexpr std::size_t most_listed_neighbours = 100'000'000;
TrueNeighbours find_truth(std::span<const glm::vec3> positions, float range);

/// Studies the search of `particles` (their state before the step) in `cdt`, which `owners` were drawn into.
/// `params`: of the frame that searches; `truth` within its collision range. All of one size.
SearchStudy study_search(const Particles& particles, const CollisionImage& cdt, const Owners& owners,
                         const TrueNeighbours& truth, const FrameParams& params, const Profile& profile);

/// The same of a CDT with remedies (layered_cdt.hpp). What is hidden from all cameras counts under what hides it from
/// the first. Layers leave out no base texel and no particle behind an obstacle; with response = mutual a pair is
/// missed too where i itself is in no layer (occluded), and where j does not search (cooling_down).
SearchStudy study_layered_search(const Particles& particles, const CollisionImage& cdt, const LayeredOwners& owners,
                                 const TrueNeighbours& truth, const FrameParams& params, const Profile& profile);

/// What one step did to the sums over all particles of finite state, beyond what gravity explains; mass 1 each.
struct Drift {
    double energy = 0.0;   ///< (kinetic + potential energy, after - before) / kinetic energy before
    double momentum = 0.0; ///< |momentum after - before - gravity's| / sum of |momentum| before
};
Drift drift(const Particles& before, const Particles& after, const Constants& constants);

} // namespace lockstep
