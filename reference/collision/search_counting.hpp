#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "reference/collision/search_study.hpp"
#include "reference/collision/step_stage.hpp"

namespace lockstep {

/// Counting what a search finds, whatever search it is. `Search` answers of particle i: inside(i), searches(i),
/// hit(i), the particle found partner(i), the cause of a pair's miss miss(i, neighbour), and base_owned_by(i,
/// neighbour), whether another than i has the texel i searches round, and leaves out.

template <class Enum> constexpr std::size_t place_of(Enum value) { return static_cast<std::size_t>(value); }

/// Particle i's contribution to the counts.
template <class Search>
Finding count_particle(const Search& search, const TrueNeighbours& truth, std::size_t i, SearchCounts& n) {
    Finding finding;
    finding.hit = search.hit(i);
    ++n.hits[place_of(finding.hit)];
    if (finding.hit == Hit::nearest || finding.hit == Hit::neighbour)
        n.non_mutual +=
            search.partner(static_cast<std::size_t>(search.partner(i))) != static_cast<std::int32_t>(i) ? 1U : 0U;

    const Neighbourhood& nearest = truth.nearest.particle[i];
    if (nearest.nearest == no_neighbour)
        return finding;
    ++n.with_neighbour;
    n.with_neighbour_inside += search.inside(i) ? 1U : 0U;
    n.with_neighbour_search += search.searches(i) ? 1U : 0U;
    bool recalled = false;
    bool in_base = false;
    for (const std::int32_t j : truth.lists.of(i)) {
        ++n.pairs;
        const std::optional<Miss> miss = search.miss(i, j);
        if (miss)
            ++n.missed_pairs[place_of(*miss)];
        else
            ++n.found_pairs;
        recalled = recalled || !miss;
        in_base = in_base || (search.searches(i) && search.base_owned_by(i, j));
        if (j == nearest.nearest)
            finding.miss = miss.value_or(finding.miss);
    }
    n.recalled += recalled ? 1U : 0U;
    n.recalled_with_base += recalled || in_base ? 1U : 0U;
    finding.kind = recalled ? Finding::Kind::recalled : Finding::Kind::missed;
    if (!recalled)
        ++n.missed_particles[place_of(finding.miss)];
    return finding;
}

/// All counts but `owners`.
template <class Search> SearchStudy count_search(const Search& search, std::size_t particles,
                                                 const TrueNeighbours& truth, const FrameParams& params,
                                                 const Profile& profile) {
    SearchStudy result;
    result.findings.resize(particles);
    const auto count = static_cast<std::ptrdiff_t>(particles);
#pragma omp parallel
    {
        const FlushSubnormals guard = flush_in_step(params.switches, profile);
        SearchCounts counts;
#pragma omp for schedule(dynamic, 1024)
        for (std::ptrdiff_t i = 0; i < count; ++i)
            result.findings[static_cast<std::size_t>(i)] =
                count_particle(search, truth, static_cast<std::size_t>(i), counts);
#pragma omp critical
        result.counts += counts;
    }
    result.counts.particles = particles;
    result.counts.ignored = truth.nearest.ignored;
    for (const Neighbourhood& neighbourhood : truth.nearest.particle)
        if (neighbourhood.nearest != no_neighbour)
            result.counts.depth += double{params.constants.collision_range} - std::sqrt(neighbourhood.squared_distance);
    return result;
}

} // namespace lockstep
