#pragma once
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "reference/text/findings.hpp"
#include "reference/text/program.hpp"

namespace lockstep {

/// A finding with its places as FILE:LINE.
struct NamedFinding {
    text::Finding found;
    std::string where, other; ///< other: of races

    [[nodiscard]] std::string text() const; ///< one line
    [[nodiscard]] nlohmann::json json() const;
};

std::vector<NamedFinding> named(const text::Findings& findings, const text::Program& program);

} // namespace lockstep
