#pragma once
#include <string>
#include <utility>

#include "reference/model/error.hpp"

namespace lockstep {

/// A shader's uniforms or attributes that get no value. `names`: where each is declared, and which it is; `advice`: how
/// shaders of a folder get it.
struct NothingGiven : Error {
    NothingGiven(std::string which, const std::string& advice)
        : Error("shader " + which + advice), names(std::move(which)) {}
    std::string names;
};

} // namespace lockstep
