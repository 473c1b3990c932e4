#pragma once
#include <array>
#include <span>
#include <string_view>

#include "reference/model/collision/scene.hpp"
#include "reference/readings/mistake.hpp"

namespace lockstep {

/// What a constant must have been for an item to come out as it did, where that follows from the item.
using Fit = std::array<float, 3> (*)(std::span<const float> before, std::span<const float> after, const Constants& c);

/// A mistake of the listing's step that is another formula at one of its sites, or at a few: another metric, another
/// response, another integrator, another window.
struct FormulaMistake {
    std::string_view name; ///< "chebyshev_distance"
    std::string_view meaning;
    Mistake mistake;
    std::span<const float> constants = {}; ///< those that are tried; empty: it has none
    Fit fit = nullptr;                     ///< finds its constants in an item
};
std::span<const FormulaMistake> formula_mistakes();

} // namespace lockstep
