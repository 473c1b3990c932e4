#pragma once
#include <span>

#include "crosscheck/judge/system.hpp"

/// What the lists of the lights' mistakes are written with.
namespace lockstep::lights {

using Words = std::span<float>;

/// To the very bits.
inline Mistake spoiled_at(const Site& site, Formula formula) {
    return {.site = site.id, .change = Change::spoiled, .formula = formula};
}

/// As it may be written in many ways, which round otherwise.
inline Mistake formula_at(const Site& site, Formula formula) {
    return {.site = site.id, .change = Change::by_formula, .formula = formula};
}

/// `also` outlives what is returned.
inline Mistake with(Mistake mistake, const Mistake& also) {
    mistake.also = &also;
    return mistake;
}

inline float first(const CameBy& run, const Site& site) { return run.of(site)[0]; }
inline void y_is_x(Words value, const CameBy& /*run*/) { value[1] = value[0]; }

} // namespace lockstep::lights
