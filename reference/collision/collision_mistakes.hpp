#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "reference/collision/deviation.hpp"
#include "reference/model/collision/switches.hpp"
#include "reference/readings/mistake.hpp"

namespace lockstep {

/// What a named deviation is in the collision twin; nothing where it shows in drawing only. One of its host's is
/// Change::handed_over, its part the deviation. Where not_searching = stands, who never collides searches all the same,
/// finds nobody and falls.
std::optional<Mistake> step_mistake(Deviation deviation, const Switches& switches);

/// Those of several.
std::vector<Mistake> mistakes_of(const Deviations& deviations, const Switches& switches);

/// A human name of a mistake that only one of the other searches can make.
struct SearchMistake {
    std::string_view pass; ///< "octree_pass", "layered_collision_pass"
    std::string_view name; ///< "last_layer_skipped"
    std::string_view meaning;
    Mistake mistake;
};
std::span<const SearchMistake> search_mistakes();

/// Whether the step of this search can make a mistake of the listing's at all: the octree's projects nothing.
bool can_make(std::string_view pass, const Mistake& mistake);

} // namespace lockstep
