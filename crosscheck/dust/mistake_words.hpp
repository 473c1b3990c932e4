#pragma once
#include <string>
#include <utility>

#include "crosscheck/judge/mistake_words.hpp"

/// What the lists of dust's mistakes are written with.
namespace lockstep::dust {

/// One that a shader with a formula of its own makes, which rounds in its own way.
inline NamedMistake free_formula(std::string name, std::string meaning, std::string pass, const Mistake& mistake) {
    return {.name = std::move(name),
            .meaning = std::move(meaning),
            .pass = std::move(pass),
            .mistake = mistake,
            .freely_written = true};
}

} // namespace lockstep::dust
