#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "reference/collision/deviation.hpp"
#include "reference/readings/mistake.hpp"

namespace lockstep {

/// What a named deviation is at the sites of the collision twin; nothing where it is not the step's mistake but its
/// host's or its arithmetic's, or shows in drawing only.
std::optional<Mistake> step_mistake(Deviation deviation);

/// A human name of a mistake that only one of the other searches can make.
struct SearchMistake {
    std::string_view pass; ///< "octree_pass", "layered_collision_pass"
    std::string_view name; ///< "last_layer_skipped"
    std::string_view meaning;
    Mistake mistake;
};
std::span<const SearchMistake> search_mistakes();

/// Whether the step of this search comes by a site at all: the octree's projects nothing.
bool has_site(std::string_view pass, std::uint32_t site);

} // namespace lockstep
