#pragma once
#include <array>

#include "crosscheck/judge/system.hpp"

/// What the lists of systems' mistakes are written with.
namespace lockstep {

/// By a formula that leaves the very bits.
inline Mistake spoiled_at(const Site& site, Formula formula, const std::array<float, 3>& constants = {}) {
    return {.site = site.id, .change = Change::spoiled, .formula = formula, .constants = constants};
}

/// By one that shaders write in other orders, which round otherwise.
inline Mistake formula_at(const Site& site, Formula formula, const std::array<float, 3>& constants = {}) {
    return {.site = site.id, .change = Change::by_formula, .formula = formula, .constants = constants};
}

/// `also` outlives what is returned, and has the same constants.
inline Mistake with(Mistake mistake, const Mistake& also) {
    mistake.also = &also;
    return mistake;
}

inline float first(const CameBy& run, const Site& site) { return run.of(site)[0]; }

} // namespace lockstep
