#pragma once
#include <string>
#include <utility>

#include "crosscheck/judge/system.hpp"

/// What the lists of dust's mistakes are written with.
namespace lockstep::dust {

inline Mistake formula_at(const Site& site, Formula formula) {
    return {.site = site.id, .change = Change::by_formula, .formula = formula};
}

inline Mistake spoiled_at(const Site& site, Formula formula) {
    return {.site = site.id, .change = Change::spoiled, .formula = formula};
}

/// `also` outlives what is returned.
inline Mistake with(Mistake mistake, const Mistake& also) {
    mistake.also = &also;
    return mistake;
}

/// One that a shader with a formula of its own makes, which rounds in its own way.
inline NamedMistake free_formula(std::string name, std::string meaning, std::string pass, const Mistake& mistake) {
    return {.name = std::move(name),
            .meaning = std::move(meaning),
            .pass = std::move(pass),
            .mistake = mistake,
            .freely_written = true};
}

} // namespace lockstep::dust
